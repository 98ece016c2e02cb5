// Soft bodies of links that lie still sleep, in our step and in Bullet's; what their step would read wakes them.
#include <gtest/gtest.h>

#include <functional>

#include "physics/soft_grip.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_sheet.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr int kToSleep = 5000;  // steps: it falls, lies down, trembles by a micrometre, and is known not to creep

WorldOptions options(bool sleeping) {
  WorldOptions made;
  made.gravity = {0, 0, -9.81};
  made.sleeping = sleeping;
  return made;
}

// With one corner fixed. `flags` 0x11: its step is Bullet's (link_step_test.cpp).
SoftDefinition cloth(int flags = 1) {
  SoftDefinition made = sheet(9, 0.1);
  made.T_world_body = {{-0.05, -0.05, 0.053}, {}};  // on the table
  made.margin = 0.003;
  made.mass = 0.02;
  made.fixed = {0};
  made.config.kLST = 0.5;
  made.config.kDP = 0.03;
  made.config.kDF = 0.8;
  made.config.piterations = 4;
  made.config.flags = flags;
  return made;
}

// On a table, with a body above it and one far away.
struct Lying {
  explicit Lying(bool sleeping, const SoftDefinition& of = cloth()) : world(options(sleeping)), soft(of) {
    for (Body* body : {&table, &tool, &far}) world.add(*body);
    add(world, soft);
  }
  ~Lying() { remove(world, soft); }
  void step(int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }
  std::vector<Vec3> nodes() const {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < soft.node_count(); ++i) all.push_back(soft.position(i));
    return all;
  }

  World world;
  Body table{parameters(0.0, {box(0.5, 0.5, 0.1)}, {0, 0, 0})}, tool{parameters(0.0, {sphere(0.005)}, {0, 0, 0.2})},
      far{parameters(0.0, {sphere(0.005)}, {1, 0, 0})};
  SoftBody soft;
};

double furthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, math::norm(a[i] - b[i]));
  return largest;
}

TEST(SoftBodySleep, IsNotSeenByAnybody) {
  for (const int flags : {1, 0x11}) {
    SCOPED_TRACE(flags);
    Lying asleep(true, cloth(flags)), awake(false, cloth(flags));
    for (Lying* each : {&asleep, &awake}) {
      each->step(kToSleep);
      each->far.move_to({{1, 0.01, 0}, {}});  // out of reach
      each->step(1);
    }
    EXPECT_TRUE(asleep.soft.asleep());
    EXPECT_FALSE(awake.soft.asleep());
    EXPECT_LT(furthest(asleep.nodes(), awake.nodes()), 5e-6);
    const std::vector<Vec3> before = asleep.nodes();
    for (Lying* each : {&asleep, &awake}) each->step(2000);
    EXPECT_EQ(asleep.nodes(), before);
    EXPECT_LT(furthest(asleep.nodes(), awake.nodes()), 5e-6) << "nor was it about to go anywhere";
    for (Lying* each : {&asleep, &awake})
      for (int i = 0; i < 50; ++i) {
        each->soft.apply_wrench({{0, 0, 0.3}, {}});
        each->step(1);
      }
    EXPECT_GT(furthest(asleep.nodes(), before), 0.002);
    EXPECT_LT(furthest(asleep.nodes(), awake.nodes()), 5e-5);
  }
}

TEST(SoftBodySleep, EndsWithWhateverActsOnIt) {
  Body hand(mass_only(0.0, {}, {{0, 0, 0.3}, {}}));
  SoftGrip grip;
  const std::vector<std::pair<const char*, std::function<void(Lying&)>>> causes = {
      {"a force",
       [](Lying& lies) {
         lies.soft.apply_force(80, {0, 0, 0.1});
       }},
      {"a wrench",
       [](Lying& lies) {
         lies.soft.apply_wrench({{0, 0, 0.5}, {}});
       }},
      {"gravity",
       [](Lying& lies) {
         lies.world.set_gravity({0, 1, -9.0});
       }},
      {"what it touches",
       [](Lying& lies) {
         lies.tool.set_pose({{0, 0, 0.054}, {}});
       }},
      {"what it lies on",
       [](Lying& lies) {
         lies.table.move_to({{0.0001, 0, 0}, {}});
       }},
      {"its fixed nodes",
       [](Lying& lies) {
         lies.soft.carry_fixed({{-0.05, -0.05, 0.054}, {}}, 1.0);
       }},
      {"a grip",
       [&](Lying& lies) {
         EXPECT_TRUE(grip.hold_at(hand, lies.soft, 44, {0, 0, -0.24}));
       }},
      {"a reset", [](Lying& lies) { lies.soft.reset(); }},
      {"a removal", [](Lying& lies) { lies.world.remove(lies.table); }},
  };
  Lying lies(true);
  lies.world.add(hand);
  for (const auto& [what, cause] : causes) {
    SCOPED_TRACE(what);
    lies.step(kToSleep);
    ASSERT_TRUE(lies.soft.asleep());
    const std::vector<Vec3> before = lies.nodes();
    cause(lies);
    lies.step(3);
    EXPECT_FALSE(lies.soft.asleep());
    EXPECT_GT(furthest(lies.nodes(), before), 1e-7);
    grip.release();
    lies.tool.set_pose({{0, 0, 0.2}, {}});
    lies.soft.reset();
  }
}

TEST(SoftBodySleep, HangsFromFixedNodesAndFromWhatStands) {
  World world(options(true));
  Body rail(parameters(0.0, {sphere(0.002)}, {0, 0, 0.5}));
  world.add(rail);
  SoftDefinition fixed_at = cloth(), hung = cloth();
  for (SoftDefinition* each : {&fixed_at, &hung}) each->config.bending_distance = 2, each->config.piterations = 8;
  fixed_at.T_world_body.position.z = hung.T_world_body.position.z = 0.5;
  fixed_at.T_world_body.position.x = 1.0;
  fixed_at.fixed = {0, 8};
  hung.fixed = {};
  SoftBody one(fixed_at), two(hung);
  SoftGripOptions part_of_the_scene;
  part_of_the_scene.first = true;
  SoftGrip grip(part_of_the_scene);
  for (SoftBody* each : {&one, &two}) add(world, *each);
  for (const std::size_t node : {0, 8}) EXPECT_TRUE(grip.hold(rail, two, node));
  for (int i = 0; i < 12000; ++i) world.step();
  EXPECT_LT(one.position(80).z, 0.42);
  EXPECT_LT(two.position(80).z, 0.42);
  EXPECT_TRUE(one.asleep());
  EXPECT_TRUE(two.asleep());
  rail.move_to({{0, 0, 0.501}, {}});
  world.step();
  EXPECT_TRUE(one.asleep());
  EXPECT_FALSE(two.asleep());
  grip.release();
  for (SoftBody* each : {&one, &two}) remove(world, *each);
}

// It bears them by forces of each step.
TEST(SoftBodySleep, DoesNotBeginUnderABodyThatMoves) {
  SoftDefinition carries = sheet(9, 0.2);
  carries.T_world_body = {{-0.1, -0.1, 0.2}, {}};
  carries.config.kDP = 0.05;
  carries.config.piterations = 8;
  carries.config.bending_distance = 2;
  carries.fixed = {0, 8, 72, 80};
  Lying lies(true, carries);
  Body weight(parameters(0.05, {sphere(0.03)}, {0, 0, 0.235}));
  lies.world.add(weight);
  lies.tool.set_pose({{0, 0.3, 0.2}, {}});
  lies.step(8000);
  const double height = weight.pose().position.z;
  EXPECT_GT(height, 0.1);
  EXPECT_FALSE(lies.soft.asleep());
  lies.step(2000);
  EXPECT_NEAR(weight.pose().position.z, height, 1e-4);
  lies.world.remove(weight);
  lies.step(8000);
  EXPECT_TRUE(lies.soft.asleep()) << "it is gone";
}

TEST(SoftBodySleep, EndsWhenAnotherComesNear) {
  SoftDefinition below = cloth(0x11), above = cloth(0x11);
  above.T_world_body.position.z = 0.5;
  above.fixed = {0, 8, 72, 80};
  Lying lies(true, below);
  SoftBody other(above);
  add(lies.world, other);
  lies.step(kToSleep);
  ASSERT_TRUE(lies.soft.asleep());
  for (int i = 0; i < 1000 && lies.soft.asleep(); ++i) {
    other.carry_fixed({{-0.05, -0.05, 0.5 - 0.0005 * i}, {}}, 10.0);
    lies.step(1);
  }
  EXPECT_FALSE(lies.soft.asleep());
  double lowest = 1.0;
  for (std::size_t i = 0; i < other.node_count(); ++i) lowest = std::min(lowest, other.position(i).z);
  EXPECT_GT(lowest, 0.05) << "not yet on the table";
  remove(lies.world, other);
}

TEST(SoftBodySleep, ContinuesFromItsStateBitForBit) {
  Lying lies(true);
  lies.step(kToSleep);
  ASSERT_TRUE(lies.soft.asleep());
  std::vector<double> state;
  std::vector<std::byte> saved;
  lies.world.save_state(saved);
  lies.soft.get_state(state);
  lies.step(3000);
  EXPECT_TRUE(lies.soft.asleep()) << "again";
  const std::vector<Vec3> later = lies.nodes();
  lies.soft.apply_force(40, {0, 0, 0.1});
  lies.step(50);
  EXPECT_TRUE(lies.world.restore_state(saved));
  EXPECT_TRUE(lies.soft.set_state(state));
  lies.step(3000);
  EXPECT_TRUE(lies.soft.asleep());
  EXPECT_EQ(lies.nodes(), later);
}

}  // namespace
}  // namespace ambf::physics
