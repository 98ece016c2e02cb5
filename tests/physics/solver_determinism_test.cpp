// Equal inputs give equal bits: from run to run, wherever memory lies, and after reset() as from a new solver.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/physics/link_bed.h"
#include "tests/physics/mechanisms.h"

namespace {

// Counts allocations made through operator new while switched on.
bool counting = false;
std::uint64_t allocations = 0;

void* counted_allocation(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* memory = alignment > alignof(std::max_align_t) ? std::aligned_alloc(alignment, rounded) : std::malloc(size);
  if (memory == nullptr) std::abort();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return counted_allocation(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted_allocation(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace ambf::physics::testing {
namespace {

// Loops, motors that saturate, limits, contacts of loose bodies and of jointed ones.
struct Mixture {
  explicit Mixture(BulletScene& scene) : gripper(add_gripper(scene)), manipulator(add_manipulator(scene, {2, 0, 1})) {
    add_coupled_chain(scene, 4, 2.0);
    for (int i = 0; i < 6; ++i) scene.add_box({0.05, 0.05, 0.05}, 0.5, btVector3(-1, 0.02 * i, 0.05 + 0.11 * i));
    close_gripper(gripper, 5.0);
  }
  void act(BulletScene& scene, int step) {
    if (step == 150) gripper.lift->setTargetLinMotorVelocity(0.1);
    drive(*static_cast<btHingeConstraint*>(manipulator[1]), 0.001 * (step % 700), 40.0);
    scene.step();
  }
  Gripper gripper;
  std::vector<btTypedConstraint*> manipulator;
};

std::vector<double> run(int steps) {
  BulletScene scene;
  Mixture mixture(scene);
  for (int i = 0; i < steps; ++i) mixture.act(scene, i);
  return scene.state();
}

TEST(Determinism, ThreeRunsAreBitIdenticalWhereverMemoryLies) {
  const std::vector<double> first = run(800);
  std::vector<std::unique_ptr<char[]>> clutter;
  for (std::size_t i = 0; i < 300; ++i) clutter.push_back(std::make_unique<char[]>(100 + 37 * i));
  for (std::size_t i = 0; i < 300; i += 2) clutter[i].reset();
  EXPECT_EQ(first, run(800));
  clutter.clear();
  EXPECT_EQ(first, run(800));
}

// The canonical restart of a snapshot: everything out, pairs and solver forgotten, everything in again in the order of
// loading.
void restart(BulletScene& scene) {
  auto& world = scene.world();
  const std::vector<double> state = scene.state();
  struct Filter {
    int group, mask;
  };
  std::vector<Filter> filters;
  for (const auto& body : scene.bodies()) {
    filters.push_back(
        {body->getBroadphaseHandle()->m_collisionFilterGroup, body->getBroadphaseHandle()->m_collisionFilterMask});
  }
  for (const auto& joint : scene.joints()) world.removeConstraint(joint.get());
  for (const auto& body : scene.bodies()) world.removeRigidBody(body.get());
  world.getBroadphase()->resetPool(world.getDispatcher());
  scene.solver().reset();
  for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
    world.addRigidBody(scene.bodies()[i].get(), filters[i].group, filters[i].mask);
  }
  for (const auto& joint : scene.joints()) world.addConstraint(joint.get(), true);
  scene.restore(state);
}

TEST(Determinism, AfterResetTheSolverIsAsNew) {
  BulletScene lived;
  Mixture lived_mixture(lived);
  for (int i = 0; i < 400; ++i) lived_mixture.act(lived, i);
  restart(lived);
  BulletScene fresh;
  Mixture fresh_mixture(fresh);
  fresh_mixture.gripper.lift->setTargetLinMotorVelocity(0.1);
  fresh.restore(lived.state());
  restart(fresh);
  for (int i = 400; i < 800; ++i) {
    lived_mixture.act(lived, i);
    fresh_mixture.act(fresh, i);
    ASSERT_EQ(lived.state(), fresh.state()) << "at step " << i;
  }
}

TEST(Determinism, OrderInWhichIslandsArriveDoesNotMatterToAMechanism) {
  // The same mechanism alone, and beside another that is loaded after it.
  BulletScene alone;
  add_coupled_chain(alone, 3, 1.0);
  BulletScene beside;
  add_coupled_chain(beside, 3, 1.0);
  const std::size_t size = alone.state().size();
  add_manipulator(beside, btVector3(0, 5, 1));
  alone.step(500);
  beside.step(500);
  std::vector<double> same = beside.state();
  same.resize(size);
  EXPECT_EQ(alone.state(), same);
}

TEST(SteadyState, AllocatesNothing) {
  BulletScene scene;
  Mixture mixture(scene);
  for (int i = 0; i < 600; ++i) mixture.act(scene, i);
  counting = true;
  allocations = 0;
  for (int i = 600; i < 1000; ++i) mixture.act(scene, i);
  counting = false;
  EXPECT_EQ(allocations, 0U);
}

// A cloth falls on a block, and on a sheet.
TEST(SteadyState, SoftBodiesOnTissueAllocateNothing) {
  for (const bool sheet : {false, true}) {
    SCOPED_TRACE(sheet);
    testing::Bed lies(testing::cloth((sheet ? 0.0 : testing::kTop) + 0.02), sheet ? testing::drum() : testing::bed());
    lies.step(10);
    counting = true;
    allocations = 0;
    lies.step(400);
    counting = false;
    EXPECT_EQ(allocations, 0U);
    EXPECT_GT(lies.middle().z, -0.005) << "it lies on it";
  }
}

TEST(SteadyState, AnalysesAStructureOnce) {
  BulletScene scene;
  Mixture mixture(scene);
  for (int i = 0; i < 1000; ++i) mixture.act(scene, i);
  EXPECT_LE(scene.solver().statistics().symbolic_analyses, 4U);
}

TEST(SteadyState, BatchesOfIslandsGiveTheSameMotionUpToRounding) {
  SceneOptions batched;
  batched.batch_size = 128;
  BulletScene one;
  BulletScene other(batched);
  for (BulletScene* scene : {&one, &other}) {
    add_coupled_chain(*scene, 3, 1.0);
    add_manipulator(*scene, btVector3(0, 5, 1));
    scene->step(500);
  }
  const auto a = one.state();
  const auto b = other.state();
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-6);
}

}  // namespace
}  // namespace ambf::physics::testing
