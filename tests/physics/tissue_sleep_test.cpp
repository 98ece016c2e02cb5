// Tissue that lies still sleeps; what its step would read wakes it, and nobody sees the difference.
#include <gtest/gtest.h>

#include <functional>

#include "physics/soft_grip.h"
#include "tests/physics/cut_scene.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_scene.h"
#include "tests/physics/tissue_block.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

// On its fixed lower side, with a body above it and one far away.
struct Lying {
  explicit Lying(bool sleeping) : world(options(sleeping)), tissue(definition()) {
    world.add(tool);
    world.add(far);
    add(world, tissue);
  }
  ~Lying() { remove(world, tissue); }
  static WorldOptions options(bool sleeping) {
    WorldOptions made;
    made.gravity = {0, 0, -kG};
    made.sleeping = sleeping;
    return made;
  }
  static TissueDefinition definition() {
    TissueDefinition made = tissue_of(block({0.02, 0.02, 0.02}), 0.01, 1e4);
    for (std::uint32_t i = 0; i < made.grid.corners.size(); ++i)
      if (made.grid.corners[i].z < 1e-9) made.fixed.push_back(i);
    return made;
  }
  void step(int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }
  std::vector<Vec3> nodes() const {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < tissue.node_count(); ++i) all.push_back(tissue.position(i));
    return all;
  }

  World world;
  Body tool{parameters(0.0, {sphere(0.005)}, {0.01, 0.01, 0.06})}, far{parameters(0.0, {sphere(0.005)}, {1, 0, 0})};
  Tissue tissue;
};

double furthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, math::norm(a[i] - b[i]));
  return largest;
}

TEST(TissueSleep, IsNotSeenByAnybody) {
  Lying asleep(true), awake(false);
  for (Lying* each : {&asleep, &awake}) {
    each->step(1500);
    each->far.move_to({{1, 0.01, 0}, {}});  // out of reach
    each->step(1);
  }
  EXPECT_TRUE(asleep.tissue.asleep());
  EXPECT_FALSE(awake.tissue.asleep());
  EXPECT_LT(furthest(asleep.nodes(), awake.nodes()), 1e-6);
  const std::vector<Vec3> before = asleep.nodes();
  asleep.step(100);
  EXPECT_EQ(asleep.nodes(), before);
  for (Lying* each : {&asleep, &awake})
    for (int i = 0; i < 200; ++i) {
      each->tissue.apply_force(each->tissue.node_count() - 1, {0.01, 0, 0.02});
      each->step(1);
    }
  EXPECT_GT(furthest(asleep.nodes(), before), 1e-4);
  EXPECT_LT(furthest(asleep.nodes(), awake.nodes()), 1e-6);
}

TEST(TissueSleep, EndsWithWhateverActsOnIt) {
  Body hand(mass_only(0.0, {}, {{0.01, 0.01, 0.1}, {}}));
  SoftGrip grip;
  const std::vector<std::pair<const char*, std::function<void(Lying&)>>> causes = {
      {"a force",
       [](Lying& lies) {
         lies.tissue.apply_force(lies.tissue.node_count() - 1, {0, 0, 0.01});
       }},
      {"a wrench",
       [](Lying& lies) {
         lies.tissue.apply_wrench({{0, 0, 0.01}, {}});
       }},
      {"gravity",
       [](Lying& lies) {
         lies.world.set_gravity({0, 0, -1.0});
       }},
      {"what it touches",
       [](Lying& lies) {
         lies.tool.set_pose({{0.01, 0.01, 0.0249}, {}});
       }},
      {"its fixed corners",
       [](Lying& lies) {
         lies.tissue.carry_fixed({{0, 0, 0.001}, {}}, 1.0);
       }},
      {"a grip", [&](Lying& lies) { EXPECT_TRUE(grip.hold(hand, lies.tissue, 3)); }},
      {"a reset", [](Lying& lies) { lies.tissue.reset(); }},
  };
  Lying lies(true);
  lies.world.add(hand);
  for (const auto& [what, cause] : causes) {
    SCOPED_TRACE(what);
    lies.step(1500);
    ASSERT_TRUE(lies.tissue.asleep());
    const std::vector<Vec3> before = lies.nodes();
    cause(lies);
    lies.step(3);
    EXPECT_FALSE(lies.tissue.asleep());
    if (what != std::string("a grip")) {
      EXPECT_GT(furthest(lies.nodes(), before), 1e-8);
    }
    grip.release();
  }
  lies.world.remove(hand);
}

// What rests on it moves a little for ever; both stay awake.
TEST(TissueSleep, DoesNotBeginUnderABodyThatIsAwake) {
  Lying lies(true);
  Body weight(parameters(0.01, {box(0.012, 0.012, 0.012)}, {0.01, 0.01, 0.0275}));
  lies.world.add(weight);
  lies.step(1500);
  EXPECT_GT(lies.tissue.contacts(), 0U);
  EXPECT_TRUE(weight.asleep() || !lies.tissue.asleep());
  EXPECT_GT(weight.pose().position.z, 0.02);
  lies.world.remove(weight);
  lies.step(1500);
  EXPECT_TRUE(lies.tissue.asleep()) << "it is gone";
}

TEST(TissueSleep, BeginsWhileABladeLiesElsewhere) {
  CutScene scene(tissue_of(block({0.02, 0.02, 0.02}), 0.01, 1e4, 0.45, 1000), {{{0, -0.01, 0}, {0, 0.01, 0}}, 100.0});
  ASSERT_TRUE(scene.tissue.can_be_cut());
  scene.hand.set_pose({{0, 0, 0.06}, {}});
  for (int i = 0; i < 700; ++i) scene.world.step();
  EXPECT_TRUE(scene.tissue.asleep());
  scene.hand.move_to({{0, 0, 0.0599}, {}});
  scene.world.step();
  EXPECT_FALSE(scene.tissue.asleep()) << "it moves";
}

TEST(TissueSleep, KnowsWhatOthersPressWhenABodyIsRemoved) {
  Lying lies(true);
  lies.tool.set_pose({{0.01, 0.01, 0.0245}, {}});
  lies.step(1500);
  const Vec3 pressed = lies.tissue.force_on(lies.tool);
  EXPECT_GT(pressed.z, 1e-4);
  lies.world.remove(lies.far);
  lies.step(1);
  EXPECT_TRUE(lies.tissue.asleep());
  EXPECT_EQ(lies.tissue.force_on(lies.tool), pressed);
}

// Its ends hang on clamps where its margin reaches into the floor, which pushes what is beside them: contacts that let
// go of what leaves within a step flung a rim up and down by 30 um there, for ever.
TEST(TissueSleep, BeginsBetweenClampsThatHoldItOnAFloor) {
  World world(Lying::options(true));
  BodyDefinition below = parameters(0.0, {box(0.12, 0.1, 0.01)}, {0.025, 0.015, -0.005});
  below.surface.friction = 0.6;
  Body floor(below), clamp(mass_only(0.0, {}));
  world.add(floor);
  world.add(clamp);
  TissueDefinition given = tissue_of(block({0.05, 0.03, 0.015}), 0.005, 1.5e4, 0.45, 1000);
  given.attached.emplace_back();
  for (std::uint32_t i = 0; i < given.grid.corners.size(); ++i)
    if (const double x = given.grid.corners[i].x; x < 0.001 || x > 0.049) given.attached[0].push_back(i);
  given.margin = 0.0005;
  given.material.density = 1060;
  given.material.friction = 0.5;
  Tissue tissue(given);
  tissue.attach(0, &clamp);
  add(world, tissue);
  for (int i = 0; i < 1500; ++i) world.step();
  EXPECT_GT(tissue.contacts(), 0U);
  EXPECT_TRUE(tissue.asleep());
  EXPECT_EQ(math::norm(tissue.momentum()), 0.0);
  remove(world, tissue);
}

// It may begin to move in any step.
TEST(TissueSleep, DoesNotBeginOnTissueThatIsHeld) {
  Lying lies(true);
  Tissue upper(tissue_of(block({0.02, 0.02, 0.02}, {0, 0, 0.021}), 0.01, 1e4));
  add(lies.world, upper);
  Body hand(mass_only(0.0, {}, {{0.01, 0.01, 0.1}, {}}));
  lies.world.add(hand);
  lies.step(2500);
  ASSERT_TRUE(upper.asleep());
  SoftGrip grip;
  ASSERT_TRUE(grip.hold(hand, lies.tissue, 3));
  lies.step(1500);
  EXPECT_FALSE(upper.asleep());
  grip.release();
  lies.step(1500);
  EXPECT_TRUE(upper.asleep());
  lies.world.remove(hand);
  remove(lies.world, upper);
}

}  // namespace
}  // namespace ambf::physics
