// Saving and restoring: both worlds continue alike, bit for bit.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

// Towers, a motorised arm that hits them, a closed loop, a sleeper far away, a carried table.
struct Scene {
  explicit Scene(SolverKind solver, unsigned allocation_noise = 0) {
    // Other addresses than the other scene's.
    for (unsigned i = 0; i < allocation_noise; ++i) noise.push_back(std::make_unique<double[]>(17 + 13 * i));
    WorldOptions options;
    options.solver = solver;
    world = std::make_unique<World>(options);
    put(parameters(0.0, {ground()}, {}));
    for (int i = 0; i < 9; ++i)
      put(parameters(0.2, {box(0.1, 0.1, 0.1)}, {0.4 + 0.15 * (i / 3), 0.01 * i, 0.051 + 0.101 * (i % 3)}));
    put(parameters(0.5, {box(0.1, 0.1, 0.1)}, {5, 0, 0.05}));
    arm_base = bodies.size();
    put(parameters(0.0, {sphere(0.02)}, {0, 0, 0.2}));
    put(parameters(1.0, {box(0.3, 0.03, 0.03)}, {0.15, -0.4, 0.2}));
    scene::Joint hinge;
    hinge.child_pivot = {-0.15, 0, 0};
    hinge.parent_pivot = {0, -0.4, 0};
    hinge.limits = std::array<double, 2>{-1.0, 2.5};
    join(hinge, arm_base, arm_base + 1);
    table = bodies.size();
    put(parameters(0.0, {box(0.4, 0.4, 0.02)}, {-2, 0, 0.3}));
    put(parameters(0.2, {box(0.05, 0.05, 0.05)}, {-2, 0, 0.34}));
    // Four bars in the xz plane.
    const std::size_t first = bodies.size();
    put(parameters(0.0, {sphere(0.01)}, {0, 3, 1}));
    for (int i = 0; i < 3; ++i) put(parameters(0.3, {box(0.2, 0.02, 0.02)}, {0.1 + 0.2 * (i % 2), 3, 1.0 - 0.05 * i}));
    for (int i = 0; i < 4; ++i) {
      scene::Joint bar;
      bar.parent_axis = bar.child_axis = {0, 1, 0};
      bar.parent_pivot = i == 0 ? math::Vec3{} : math::Vec3{0.1, 0, 0};
      bar.child_pivot = i == 3 ? math::Vec3{0.1, 0, 0} : math::Vec3{-0.1, 0, 0};
      if (i < 3)
        join(bar, first + static_cast<std::size_t>(i), first + static_cast<std::size_t>(i) + 1);
      else
        join(bar, first, first + 3);
    }
  }

  void put(const BodyDefinition& p) {
    bodies.push_back(std::make_unique<Body>(p));
    world->add(*bodies.back());
  }
  void join(const scene::Joint& description, std::size_t parent, std::size_t child) {
    joints.push_back(std::make_unique<Joint>(description, *bodies[parent], *bodies[child]));
    world->add(*joints.back());
  }

  void step() {
    const auto n = static_cast<double>(world->steps());
    joints[0]->set_motor_velocity(std::sin(n * 2e-3) * 2.0, 0.05);
    joints[1]->set_effort(0.3 * std::cos(n * 1e-3));
    bodies[table]->move_to({{-2 + 0.05 * std::sin(n * 1e-3), 0, 0.3}, {}});
    world->step();
  }

  // Everything a frame would show, as bits.
  std::vector<double> observe() const {
    std::vector<double> out;
    for (const auto& body : bodies) {
      const math::Pose p = body->pose();
      const math::Twist t = body->twist();
      for (const double v : {p.position.x, p.position.y, p.position.z, p.orientation.x, p.orientation.y,
                             p.orientation.z, p.orientation.w, t.linear.x, t.linear.y, t.linear.z, t.angular.x,
                             t.angular.y, t.angular.z, body->asleep() ? 1.0 : 0.0})
        out.push_back(v);
    }
    for (const auto& joint : joints)
      for (const double v : {joint->position(), joint->velocity(), joint->effort(), joint->reaction_on_child().force.x})
        out.push_back(v);
    return out;
  }

  std::vector<std::unique_ptr<double[]>> noise;
  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<std::unique_ptr<Joint>> joints;
  std::unique_ptr<World> world;
  std::size_t table = 0, arm_base = 0;
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class Snapshot : public ::testing::TestWithParam<SolverKind> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Snapshot, ::testing::Values(SolverKind::direct, SolverKind::si),
                         [](const auto& parameter) { return testing::name_of(parameter.param); });

TEST_P(Snapshot, TwoFreshWorldsAreBitIdentical) {
  Scene one(GetParam()), other(GetParam(), 50);
  for (int i = 0; i < 3000; ++i) {
    one.step();
    other.step();
    ASSERT_TRUE(same_bits(one.observe(), other.observe())) << i;
  }
}

TEST_P(Snapshot, ContinuesBitIdenticallyInTheSameAndInAFreshWorld) {
  Scene live(GetParam());
  for (int i = 0; i < 2500; ++i) live.step();
  std::vector<std::byte> state;
  const auto before = live.observe();
  live.world->save_state(state);
  EXPECT_TRUE(same_bits(before, live.observe()));  // saving moves nothing

  std::vector<std::vector<double>> continued;
  for (int i = 0; i < 2000; ++i) {
    live.step();
    continued.push_back(live.observe());
  }

  Scene fresh(GetParam(), 31);
  for (int i = 0; i < 77; ++i) fresh.step();  // a world with a history of its own
  for (Scene* scene : {&live, &fresh}) {
    ASSERT_TRUE(scene->world->restore_state(state));
    EXPECT_TRUE(same_bits(before, scene->observe()));
    EXPECT_EQ(scene->world->steps(), 2500u);
    for (int i = 0; i < 2000; ++i) {
      scene->step();
      ASSERT_TRUE(same_bits(continued[static_cast<std::size_t>(i)], scene->observe())) << i;
    }
  }
}

TEST_P(Snapshot, KeepsSleepersAsleep) {
  Scene live(GetParam());
  for (int i = 0; i < 3000; ++i) live.step();
  ASSERT_TRUE(live.bodies[10]->asleep());
  std::vector<std::byte> state;
  live.world->save_state(state);
  EXPECT_TRUE(live.bodies[10]->asleep());
  live.step();
  EXPECT_TRUE(live.bodies[10]->asleep());
  live.bodies[10]->apply_impulse({0.05, 0, 0}, {5, 0, 0.05});
  live.step();
  ASSERT_TRUE(live.world->restore_state(state));
  EXPECT_TRUE(live.bodies[10]->asleep());
  EXPECT_EQ(live.bodies[10]->twist().linear, (math::Vec3{}));
}

TEST(SnapshotFile, RefusesWhatIsNotOfThisWorld) {
  Scene live(SolverKind::direct);
  std::vector<std::byte> state;
  live.world->save_state(state);
  const auto before = live.observe();
  std::vector<std::byte> cut(state.begin(), state.end() - 8);
  EXPECT_FALSE(live.world->restore_state(cut));
  EXPECT_FALSE(live.world->restore_state({}));
  std::vector<std::byte> spoilt = state;
  spoilt[0] = std::byte{0};
  EXPECT_FALSE(live.world->restore_state(spoilt));
  live.world->remove(*live.bodies[10]);
  EXPECT_FALSE(live.world->restore_state(state));
  EXPECT_TRUE(same_bits(before, live.observe()));
}

}  // namespace
}  // namespace ambf::physics
