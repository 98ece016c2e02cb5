// The steady state of the physics thread allocates nothing of ours. Bullet's own allocations go through its aligned
// allocator, past operator new, and are not counted here.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <new>
#include <vector>

#include "physics/blade.h"
#include "physics/needle.h"
#include "physics/soft_grip.h"
#include "physics/thread.h"
#include "rig.h"
#include "scene/actuator.h"
#include "scene/sensor.h"
#include "state/sensors.h"
#include "tests/physics/meshes.h"
#include "tests/physics/tissue_block.h"

namespace {

thread_local bool t_counting = false;
thread_local std::size_t t_count = 0;

void* allocate(std::size_t size) {
  if (t_counting) ++t_count;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

void give_back(void* memory) {
  if (t_counting && memory != nullptr) ++t_count;
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete[](void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give_back(memory); }

namespace ambf::model::test {
namespace {

TEST(SteadyState, AllocatesAndFreesNothingOfOurs) {
  Rig rig({0, 0, -9.8});
  scene::Model arm = chain(6);
  arm.joints[1].controller.output = scene::ControllerOutput::force;
  arm.joints[2].enable_feedback = true;
  arm.joints[4].limits = {{-1.0, 1.0}};
  scene::Body ground = box("ground", 0.0, {0, 0, -1.05}, 1.0);
  arm.bodies.push_back(ground);
  for (int i = 0; i < 5; ++i) arm.bodies.push_back(box("cube" + std::to_string(i), 0.2, {0.15 * i - 0.3, 0.3, -0.5}));
  rig.load(arm);
  const auto ros = rig.port("link0");
  const auto cube = rig.port("cube1");
  const auto device = rig.port("cube1", state::Source::device_0);
  const auto effector =
      rig.live->effector_table().hold(*rig.live->structure(), rig.id("link2"), state::Source::device_0);
  state::SetPoint set_point;
  set_point.gains = {{50, 50, 50}, {1, 1, 1}, {0.1, 0.1, 0.1}, {0.01, 0.01, 0.01}};
  set_point.pulls = set_point.moves_jaw = true;
  set_point.period_s = 3 * kStep_s;
  set_point.T_world_ref.position = {0.4, 0, 0};
  const auto post = [&](int i) {
    set_point.engaged = i % 50 < 40;
    set_point.jaw = 0.001 * (i % 1000);
    if (i % 3 == 0) effector->post(set_point);
    if (i % 400 == 399) effector->let_go();
    ros->post(joints({to_position(0.001 * i), to_position(0.2), kLeaveAlone, to_velocity(0.1), to_effort(0.1)}));
    if (i % 3 == 0) cube->post(pose({{0, 0.3, -0.4}, {}}));
    if (i % 5 == 0) device->post(force({0.1, 0, 0}));
    if (i % 700 == 699) device->release();
  };
  const auto turn = [&] {
    rig.live->take_effectors(rig.watchdog_s, 1);
    rig.live->take_commands(rig.watchdog_s);
    rig.live->step(kStep_s);
    rig.live->fill(*rig.frame);
    rig.live->diverged_body();
    rig.watchdog_s += kStep_s;
  };
  for (int i = 0; i < 500; ++i) post(i), turn();
  t_count = 0;
  for (int i = 500; i < 2500; ++i) {
    if (i < 1500) post(i);  // later the watchdogs expire
    t_counting = true;
    turn();
    t_counting = false;
  }
  EXPECT_EQ(t_count, 0u);
  EXPECT_GT(rig.frame->contacts_total, 0u);
  EXPECT_FALSE(rig.body("cube1").active);
  // The counter counts.
  t_counting = true;
  ::operator delete(::operator new(1));  // no new-expression: that may be optimised away
  t_counting = false;
  EXPECT_EQ(t_count, 2u);
}

TEST(SteadyState, SensorsAllocateNothing) {
  Rig rig({0, 0, -9.8});
  scene::Model scene = model("sensors.yaml", {box("ground", 0.0, {0, 0, -1.05}, 1.0), box("cube", 0.2, {0, 0, -0.49})});
  for (int i = 0; i < 5; ++i)
    scene.bodies.push_back(box("other" + std::to_string(i), 0.2, {0.2 * i - 0.4, 0.3, -0.45 + 0.02 * i}));
  for (const auto type : {state::SensorType::proximity, state::SensorType::resistance}) {
    auto sensor = std::make_shared<scene::Sensor>();
    sensor->type = type;
    sensor->parent = "BODY cube";
    sensor->parametric = {6, 3.0, 3.0, 0.0};
    sensor->range_m = 0.5;
    sensor->friction = {100.0, 0.1, 0.5, scene::FrictionScale::normal_force};
    sensor->contact_stiffness = 0.01;
    sensor->matching_key = "key";
    sensor->success_when = state::SuccessWhen::present;
    scene::Identity identity;
    identity.name = state::name_of(type);
    identity.identifier = "SENSOR " + identity.name;
    identity.name_space = "/test/";
    scene.blocks.push_back({&scene::kind::kSensor, identity, sensor});
  }
  ASSERT_TRUE(rig.load(scene).success);
  const auto port = rig.port("cube");
  t_count = 0;
  for (int i = 0; i < 1000; ++i) {
    port->post(force({0.5 * std::sin(0.01 * i), 0.5 * std::cos(0.01 * i), 0}));
    t_counting = i >= 300;
    rig.live->take_commands(rig.watchdog_s);
    rig.live->step(kStep_s);
    rig.live->fill(*rig.frame);
    t_counting = false;
    rig.watchdog_s += kStep_s;
  }
  EXPECT_EQ(t_count, 0U);
  EXPECT_GT(state::elements_of(*rig.frame, 0).size(), 0U);
}

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Twenty bodies that an actuator grasps in turn.
class GraspingRig {
 public:
  static constexpr int kBodies = 20;

  GraspingRig() : rig_({0, 0, -9.8}) {
    scene::Model hands = chain(3);
    scene::KindBlock block{&scene::kind::kActuator, {}, {}};
    block.identity.identifier = "ACTUATOR grip";
    block.identity.name = "grip";
    block.identity.name_space = "/test/";
    auto actuator = std::make_shared<scene::Actuator>();
    actuator->parent = "BODY link2";
    block.description = actuator;
    hands.blocks.push_back(block);
    hands.bodies.push_back(box("ground", 0.0, {0, 0, -1.05}, 1.0));
    for (int i = 0; i < kBodies; ++i) {
      scene::Body cube = box("cube" + std::to_string(i), 0.01, {0.3 * i - 3.0, 3.0, 0.0});
      cube.gravity = math::Vec3{};
      hands.bodies.push_back(cube);
    }
    EXPECT_TRUE(rig_.load(hands).success);
    port_ = rig_.port("grip", state::Source::ros, state::actuator_kind().kind);
  }

  // Each body is grasped and released once. Returns the seconds of this thread that it took.
  double round() {
    const double start = thread_cpu_s();
    for (int i = 0; i < kBodies; ++i) {
      state::ActuatorCommand command;
      command.body = rig_.id("cube" + std::to_string(i));
      for (const bool hold : {true, false}) {
        command.actuate = hold;
        port_->post(state::KindCommand{command});
        t_counting = true;
        rig_.step();
        t_counting = false;
        EXPECT_EQ(state::rows(*rig_.frame, state::actuator_kind().column)[0].actuated(), hold);
      }
    }
    return thread_cpu_s() - start;
  }

 private:
  Rig rig_;
  std::unique_ptr<state::CommandPort> port_;
};

// The structures of all pairs are known after the first rounds; 10^4 grasps later nothing has grown. A world of that
// age is compared with a new one in turns, so that what the machine does beside them meets both.
TEST(SteadyState, GraspsAllocateNothingAfterTheFirstRoundAndStayAsFast) {
  constexpr int kWarmUp = 3, kRounds = 500, kTurns = 101;
  GraspingRig aged, fresh;
  for (int i = 0; i < kWarmUp; ++i) aged.round(), fresh.round();
  t_count = 0;
  for (int i = 0; i < kRounds; ++i) aged.round();
  std::vector<double> of_aged(kTurns), of_fresh(kTurns);
  for (int i = 0; i < kTurns; ++i) {
    of_aged[i] = aged.round();
    of_fresh[i] = fresh.round();
  }
  EXPECT_EQ(t_count, 0u);
  const auto typical_us = [](std::vector<double>& times) {
    std::nth_element(times.begin(), times.begin() + kTurns / 2, times.end());
    return 1e6 * times[kTurns / 2] / (2 * GraspingRig::kBodies);
  };
  const double fresh_us = typical_us(of_fresh), aged_us = typical_us(of_aged);
  std::printf("a step with a grasp or a release: %.1f us at first, %.1f us in the end\n", fresh_us, aged_us);
  EXPECT_LT(aged_us, 1.3 * fresh_us);
}

TEST(SteadyState, MeshesInContactAllocateNothing) {
  physics::World world;
  const auto body = [&](double mass, const physics::SharedShape& shape, const math::Vec3& at) {
    physics::BodyDefinition p;
    p.mass = mass;
    p.shape = shape;
    p.T_world_body.position = at;
    auto made = std::make_unique<physics::Body>(p);
    world.add(*made);
    return made;
  };
  scene::PlacedGeometry ground, ball;
  ground.geometry = {scene::Shape::box, {2, 2, 0.2}};
  ball.geometry.shape = scene::Shape::sphere;
  ball.geometry.radius = 0.02;
  using namespace physics::testing;
  const auto floor = body(0.0, physics::make_shape({ground}, {}), {0, 0, -0.1});
  const auto block = body(0.3, box_mesh({0.1, 0.1, 0.04}, 6).shape(), {0, 0, 0.021});
  const auto ring = body(0.1, ring_mesh(0.02, 0.006, 24, 12).shape(), {0, 0, 0.05});
  const auto sphere = body(0.1, physics::make_shape({ball}, {}), {0.03, 0.03, 0.062});
  const auto wiggle = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      block->apply_force({1.5 * std::sin(0.02 * i), 0.5, 0}, block->com_pose().position);
      world.step();
    }
  };
  wiggle(1500);
  t_count = 0;
  t_counting = true;
  wiggle(500);
  t_counting = false;
  EXPECT_EQ(t_count, 0u);
  EXPECT_GT(world.contacts({}), 8u);
}

// A thread that is drawn over a peg and through the hand that holds it, and a needle that goes into a block and back.
TEST(SteadyState, ThreadsAndNeedlesAllocateNothing) {
  physics::World world;
  scene::PlacedGeometry peg;
  peg.geometry.shape = scene::Shape::sphere;
  peg.geometry.radius = 0.01;
  physics::BodyDefinition p;
  p.mass = 0.0;
  p.shape = physics::make_shape({peg}, {});
  p.T_world_body.position = {0, -0.05, 0};
  physics::Body post(p);
  p.shape = physics::make_shape({}, {});
  p.T_world_body.position = {0.06, -0.05, 0.01};
  physics::Body hand(p), holder(p);
  physics::ThreadDefinition made;
  for (int i = 0; i <= 40; ++i) made.nodes.push_back({0.003 * i - 0.06, -0.05, 0.0103});
  physics::Thread thread(made);
  physics::ThreadDefinition over;  // falls on the other, where that lies on the post
  for (int i = 0; i <= 20; ++i) over.nodes.push_back({0, -0.08 + 0.003 * i, 0.012});
  physics::Thread across(over);
  physics::TissueDefinition block =
      physics::testing::tissue_of(physics::testing::block({0.02, 0.02, 0.01}), 0.005, 1e5);
  for (std::uint32_t i = 0; i < block.grid.corners.size(); ++i)
    if (block.grid.corners[i].z < 1e-9) block.fixed.push_back(i);
  physics::Tissue tissue(block);
  physics::Needle needle({{{}, {0, 0, 0.02}}, 0.05, 2.0});
  physics::SoftGrip grip;
  for (physics::Body* body : {&post, &hand, &holder}) world.add(*body);
  physics::add(world, thread);
  physics::add(world, across);
  physics::add(world, tissue);
  physics::add(world, needle);
  const auto turn = [&](int i) {
    hand.move_to({{0.0101, 0.0101, 0.012 - 0.008 * std::sin(0.02 * i)}, {}});
    thread.apply_force(0, {0, 0, -0.2 + 0.1 * std::sin(0.03 * i)});
    world.step();
  };
  for (int i = 0; i < 20; ++i) {
    if (i == 10) needle.use(&hand);
    turn(i);
  }
  ASSERT_TRUE(grip.hold(holder, thread, 40));
  std::size_t most = 0, touched = 0, crossed = 0;
  t_count = 0;
  for (int i = 20; i < 480; ++i) {
    t_counting = true;
    turn(i);
    t_counting = false;
    most = std::max(most, needle.punctures());
    touched += thread.contacts() > 0;
    crossed += across.crossings() > 0;
  }
  EXPECT_EQ(t_count, 0U);
  EXPECT_GT(crossed, 100U);
  EXPECT_GT(most, 1U) << "it went in";
  EXPECT_EQ(needle.punctures(), 0U) << "and out";
  EXPECT_GT(touched, 300U);
  grip.release();
  physics::remove(world, needle);
  physics::remove(world, tissue);
  physics::remove(world, across);
  physics::remove(world, thread);
  for (physics::Body* body : {&post, &hand, &holder}) world.remove(*body);
}

// A sheet that falls over a ball, is drawn across it by a hand, and cut while it is.
TEST(SteadyState, SheetsAllocateNothing) {
  physics::World world;
  scene::PlacedGeometry peg;
  peg.geometry.shape = scene::Shape::sphere;
  peg.geometry.radius = 0.01;
  physics::BodyDefinition p;
  p.mass = 0.0;
  p.shape = physics::make_shape({peg}, {});
  physics::Body post(p);
  p.shape = physics::make_shape({}, {});
  physics::Body hand(p), knife(p);
  physics::TissueSurface surface;
  for (std::uint32_t i = 0; i < 81; ++i)
    surface.vertices.push_back({0.005 * (i % 9) - 0.02, 0.005 * (i / 9) - 0.02, 0.012});
  for (std::uint32_t i = 0; i < 71; ++i) {
    if (i % 9 == 8) continue;
    surface.triangles.push_back({i, i + 1, i + 9});
    surface.triangles.push_back({i + 1, i + 10, i + 9});
  }
  physics::TissueDefinition made;
  made.grid = physics::make_sheet_grid(surface, 0.0005, 0.0, true);
  made.max_corners = 300;
  made.material.young = 1e5;
  made.material.share = 0.5;
  physics::Tissue sheet(made);
  physics::SoftGrip grip;
  physics::Blade blade({{{0, 0, -0.01}, {0, 0, 0.03}}, 1.0});
  for (physics::Body* body : {&post, &hand, &knife}) world.add(*body);
  physics::add(world, sheet);
  physics::add(world, blade);
  blade.use(&knife);
  for (int i = 0; i < 20; ++i) world.step();
  ASSERT_TRUE(grip.hold(hand, sheet, 0));
  hand.move_to({{0.0001, 0, 0}, {}});
  knife.move_to({{-0.011, -0.06, 0}, {}});
  for (int i = 0; i < 50; ++i) world.step();
  std::size_t touched = 0;
  t_count = 0;
  for (int i = 0; i < 300; ++i) {
    t_counting = true;
    hand.move_to({{-0.0001 * i, 0, 0}, {}});
    knife.move_to({{-0.011, 0.0004 * i - 0.06, 0}, {}});
    world.step();
    t_counting = false;
    touched += sheet.contacts() > 0;
  }
  EXPECT_EQ(t_count, 0U);
  EXPECT_GT(touched, 200U);
  EXPECT_GT(sheet.open_seams(), 3U);
  grip.release();
  physics::remove(world, blade);
  physics::remove(world, sheet);
  for (physics::Body* body : {&post, &hand, &knife}) world.remove(*body);
}

}  // namespace
}  // namespace ambf::model::test
