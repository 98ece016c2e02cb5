// Needles and threads in sheets: the force that a puncture takes, where it is, friction, what drawing back undoes, and
// that thread through them closes a wound, is tied, tears out, repeats and is saved.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/suture_rig.h"
#include "tests/physics/tissue_rectangle.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr double kWidth = 0.012, kThickness = 0.002;

// Two lips as the rig has them, of skin.
TissueDefinition lips() {
  TissueSurface halves[2];
  for (const double side : {0.0, 1.0}) {
    TissueSurface& half = halves[side > 0.0 ? 1 : 0];
    half = rectangle(0.012, kWidth, 6, 6, Mesh::crossed);
    for (Vec3& vertex : half.vertices) vertex += Vec3{0.006 + 0.015 * side, 0.5 * kWidth, SutureRig::kTop};
  }
  TissueDefinition made = sheet_of(SutureRig::both(halves[0], halves[1]), kThickness, 2e5, 0.45);
  made.fixed = those(made, [](const Vec3& at) { return at.x < 0.0021 || at.x > 0.0249; });  // clamped
  return made;
}

struct Rig : SutureRig {
  explicit Rig(double strength = 5.0, double friction = 2.0)
      : SutureRig(lips(), kWidth, rubbing(options(strength, 0.02), friction)) {}
  static NeedleOptions rubbing(NeedleOptions options, double friction) {
    options.friction = friction;
    return options;
  }
};

const SutureRig::Saved& sewn() {
  static const SutureRig::Saved saved = [] {
    Rig rig;
    rig.bite();
    return rig.saved();
  }();
  return saved;
}
struct Sewn : Rig {
  explicit Sewn(double strength = 5.0, double friction = 2.0) : Rig(strength, friction) { restore(sewn()); }
};

// A sheet that is held at two ends, and a straight needle above it.
struct Pressed {
  explicit Pressed(const NeedleOptions& options)
      : world(SutureRig::without_gravity()), hand(mass_only(0.0, {}, {{0, 0, 0.1}, {}})), needle(options) {
    sheet = layer(0.0);
    add(world, *sheet);
    world.add(hand);
    add(world, needle);
    needle.use(&hand);
  }
  ~Pressed() {
    remove(world, needle);
    world.remove(hand);
    remove(world, *sheet);
  }
  static std::unique_ptr<Tissue> layer(double z) {
    TissueSurface surface = rectangle(0.03, 0.02, 12, 8, Mesh::crossed);
    for (Vec3& vertex : surface.vertices) vertex.z += z;
    TissueDefinition made = sheet_of(surface, 0.001, 2e5);
    made.fixed = those(made, [](const Vec3& at) { return std::abs(at.x) > 0.0149; });
    return std::make_unique<Tissue>(made);
  }
  void go(double from, double to, int steps) {
    for (int i = 1; i <= steps; ++i) {
      hand.move_to({{0.0013, 0.0007, from + (to - from) * i / steps}, {}});
      world.step();
      most = std::max(most, -needle.force_world().z);
    }
  }
  World world;
  Body hand;
  Needle needle;
  std::unique_ptr<Tissue> sheet;
  double most = 0.0;
};

NeedleOptions straight(double puncture, double friction = 2.0) {
  return {{{0, 0, 0}, {0, 0, 0.03}}, puncture, friction, 5.0};
}

TEST(SheetNeedle, GoesThroughAboveItsForce) {
  for (const double puncture : {0.05, 0.1}) {
    SCOPED_TRACE(puncture);
    Pressed scene(straight(puncture));
    scene.hand.set_pose({{0.0013, 0.0007, 0.002}, {}});
    scene.go(0.002, 0.001, 20);
    EXPECT_EQ(scene.needle.punctures(), 0U);
    scene.go(0.001, -0.01, 400);
    EXPECT_EQ(scene.needle.punctures(), 1U);
    EXPECT_FALSE(scene.needle.tip_inside()) << "nothing is in a sheet";
    EXPECT_NEAR(scene.most / puncture, 1.0, 0.1);
    ASSERT_EQ(scene.needle.on_surfaces().size(), 1U);
    const SurfacePuncture& hole = scene.needle.on_surfaces()[0];
    EXPECT_LT(std::hypot(hole.rest.x - 0.0013, hole.rest.y - 0.0007), 0.0005);
    EXPECT_NEAR(hole.rest.z, 0.0, 1e-9);
    EXPECT_LT(-scene.needle.force_world().z, 0.5 * puncture) << "friction of its thickness is all that is left";
    EXPECT_NEAR(scene.sheet->force_on(scene.hand).z, -scene.needle.force_world().z, 1e-9);
    // Across it is held; drawn back the puncture is undone, and it may sew again.
    scene.go(-0.01, -0.01, 50);
    scene.hand.move_to({{0.0018, 0.0007, -0.01}, {}});
    scene.world.step();
    EXPECT_GT(scene.needle.force_world().x, 0.0);
    scene.go(-0.01, 0.003, 250);
    EXPECT_EQ(scene.needle.punctures(), 0U);
    scene.go(0.003, -0.01, 400);
    EXPECT_EQ(scene.needle.punctures(), 1U);
    EXPECT_FALSE(scene.sheet->divergence());
  }
}

// Layers that are sewn lie on each other, nearer than an element is wide.
TEST(SheetNeedle, GoesThroughTwoLayers) {
  Pressed scene(straight(0.05));
  const std::unique_ptr<Tissue> lower = Pressed::layer(-0.001);
  add(scene.world, *lower);
  scene.hand.set_pose({{0.0013, 0.0007, 0.002}, {}});
  scene.go(0.002, -0.01, 300);
  EXPECT_EQ(scene.needle.punctures(), 2U);
  scene.go(-0.01, 0.003, 200);
  EXPECT_EQ(scene.needle.punctures(), 0U);
  remove(scene.world, *lower);
}

TEST(SheetNeedle, BelowItsForceItOnlyPushes) {
  Pressed scene(straight(1.0));
  scene.hand.set_pose({{0.0013, 0.0007, 0.002}, {}});
  scene.go(0.002, -0.003, 250);
  EXPECT_EQ(scene.needle.punctures(), 0U);
  EXPECT_GT(scene.most, 0.01);
}

TEST(SheetStitch, ABiteIsWhereTheTipWent) {
  Sewn rig;
  EXPECT_EQ(rig.needle.punctures(), 0U);
  EXPECT_EQ(rig.needle.stitches(), 2U);
  EXPECT_EQ(rig.needle.bites(), 2U) << "once through each lip";
  const auto found = rig.needle.on_surfaces();
  ASSERT_EQ(found.size(), 2U);
  for (const SurfacePuncture& each : found) EXPECT_LT(SutureRig::off_path(each.rest), 0.0005);
  EXPECT_GT(found[0].needle.x, 0.018) << "the oldest";
  EXPECT_LT(found[1].needle.x, 0.010);
  EXPECT_GT(found[0].thread, found[1].thread);
  for (const SurfacePuncture& each : found)
    EXPECT_LT(math::norm(rig.thread->position_at(each.thread) - each.needle), 0.0015);
}

TEST(SheetStitch, ThePullClosesTheGapTiedItHolds) {
  Sewn rig;
  rig.pull_end(1.0);
  rig.wait(200);
  EXPECT_LT(rig.gap(), 0.0005);
  EXPECT_NEAR(rig.thread->length() / rig.thread->rest_length(), 1.0, 0.005);
  const double closed = rig.gap();
  rig.end.release();
  rig.wait(200);
  EXPECT_GT(rig.gap(), 0.0025) << "let go, it opens";
  rig.pull_end(1.0);
  rig.wait(200);
  ASSERT_TRUE(rig.needle.tie());
  EXPECT_EQ(rig.needle.tied(), 2U);
  rig.end.release();
  rig.wait(300);
  EXPECT_LT(rig.gap(), std::max(closed, 0.0) + 0.0005);
  EXPECT_FALSE(rig.tissue->divergence());
}

// Each hole holds by its friction, N/m, times the thickness: 0.4 N here, or nothing.
TEST(SheetStitch, ThreadSlidesAboveTheFrictionOfTheThickness) {
  double slid[2];
  for (const double friction : {0.0, 200.0}) {
    Sewn rig(5.0, friction);
    const double before = rig.needle.on_surfaces()[0].thread;
    rig.pull_end(0.2);
    rig.wait(100);
    slid[friction > 0.0 ? 1 : 0] = std::abs(rig.needle.on_surfaces()[0].thread - before);
  }
  EXPECT_GT(slid[0], 5e-4);
  EXPECT_LT(slid[1], 0.1 * slid[0]);
}

TEST(SheetStitch, TearsOutAboveItsStrength) {
  for (const double strength : {0.2, 5.0}) {
    Sewn rig(strength);
    rig.pull_end(1.0);
    rig.wait(100);
    EXPECT_EQ(rig.needle.stitches() < 2, strength < 1.0);
    EXPECT_FALSE(rig.tissue->divergence());
  }
}

TEST(SheetStitch, RepeatsAndIsSaved) {
  Sewn first, again;
  Rig other;
  other.restore(first.saved());
  for (SutureRig* each : {static_cast<SutureRig*>(&first), static_cast<SutureRig*>(&again)})
    each->restore(each->saved());
  for (SutureRig* each :
       {static_cast<SutureRig*>(&first), static_cast<SutureRig*>(&again), static_cast<SutureRig*>(&other)}) {
    each->pull_end(0.5);
    each->wait(60);
    each->needle.tie();
    each->end.release();
    each->wait(60);
  }
  const auto all = [](const SutureRig& rig) {
    const SutureRig::Saved saved = rig.saved();
    std::vector<double> sum = saved.tissue;
    sum.insert(sum.end(), saved.thread.begin(), saved.thread.end());
    sum.insert(sum.end(), saved.needle.begin(), saved.needle.end());
    return sum;
  };
  EXPECT_EQ(all(first), all(again));
  EXPECT_EQ(all(first), all(other));
  // A kind of puncture that no sheet has, and a tip within.
  std::vector<double> forged = first.saved().needle;
  for (const double kind : {10.0, 11.0, 12.0}) {
    forged[6 + 7] = kind;
    other.needle.set_state(other.world, forged);
    EXPECT_EQ(other.needle.stitches(), 1U) << kind;
  }
}

}  // namespace
}  // namespace ambf::physics
