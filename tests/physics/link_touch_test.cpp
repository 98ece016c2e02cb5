// Soft bodies of links on tissue, solids and sheets: what one bears is what the other weighs, friction holds, nothing
// passes.
#include <gtest/gtest.h>

#include "physics/soft_grip.h"
#include "tests/physics/link_bed.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

TEST(LinkTouch, LiesOnTissueAtItsMargin) {
  for (const int flags : {1, 0x10, 0x11}) {
    SCOPED_TRACE(flags);
    Bed lies(cloth(kTop + 0.004, flags));
    lies.step(2000);
    for (std::size_t i = 0; i < lies.soft.node_count(); ++i) {
      EXPECT_NEAR(lies.soft.position(i).z, kTop + kMargin, 1.5e-4) << i;
      EXPECT_LT(math::norm(lies.soft.velocity(i)), 1e-3) << i;
    }
  }
}

TEST(LinkTouch, DoesNotSinkInHoweverHeavyItIs) {
  for (const double mass : {0.001, 0.03, 0.1}) {
    SCOPED_TRACE(mass);
    SoftDefinition of = cloth(kTop + 0.004);
    of.mass = mass;
    Bed lies(of);
    lies.step(2000);
    for (const double gap : lies.gaps()) EXPECT_NEAR(gap, kMargin, 1e-4);
  }
}

// From above and, with gravity upwards, from beneath.
TEST(LinkTouch, LiesOnASheetOnTheSideThatItCameFrom) {
  for (const double side : {1.0, -1.0})
    for (const double mass : {0.001, kClothMass}) {
      SCOPED_TRACE(::testing::Message() << side << " " << mass);
      const TissueDefinition on = drum();
      SoftDefinition of = cloth(side * 0.01);
      of.mass = mass;
      Bed lies(of, on);
      lies.world.set_gravity({0, 0, -side * kG});
      lies.step(2000);
      for (const double gap : lies.gaps()) EXPECT_NEAR(side * gap, kMargin + 0.5 * on.grid.thickness, 4e-4);
      for (std::size_t i = 0; i < lies.soft.node_count(); ++i) EXPECT_LT(math::norm(lies.soft.velocity(i)), 0.01);
      EXPECT_LT(side * lies.middle().z, kMargin) << "it hangs through";
    }
}

// A frame of eight nodes, 60 mm wide, which are all beside the block.
TEST(LinkTouch, FacesBetweenNodesRestOnTissue) {
  SoftDefinition of;
  const TissueSurface box = block({0.06, 0.06, 0.02}, {-0.01, -0.01, kTop + 0.004});
  of.nodes = box.vertices;
  of.triangles = box.triangles;
  of.margin = kMargin;
  of.mass = 0.01;
  of.config.kDP = 0.02;
  of.config.kDF = 1.0;
  of.config.piterations = 8;
  of.config.flags = 1;
  Bed lies(of);
  lies.step(1500);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(lies.soft.position(i).z, kTop + kMargin, 3e-4);
    EXPECT_LT(math::norm(lies.soft.velocity(i)), 1e-3);
  }
  // It sticks to it, too.
  lies.world.set_gravity({0.3 * kG, 0, -kG});
  lies.step(500);
  const double before = lies.middle().x;
  lies.step(300);
  EXPECT_LT(std::abs(lies.middle().x - before), 5e-5);
}

TEST(LinkTouch, DoesNotTouchWhatItIsNotToMeet) {
  TissueDefinition touches_nothing = bed(), of_another_group = bed();
  touches_nothing.touches_others = false;
  of_another_group.collision_groups = {2};
  SoftDefinition grouped = cloth(kTop + 0.004);
  grouped.collision_groups = {1};
  const auto falls = [](const SoftDefinition& of, const TissueDefinition& on) {
    Bed lies(of, on);
    lies.step(200);
    return lies.middle().z < 0.0;
  };
  EXPECT_TRUE(falls(cloth(kTop + 0.004), touches_nothing));
  EXPECT_TRUE(falls(grouped, of_another_group));
  EXPECT_TRUE(falls(cloth(kTop + 0.004, 0), bed()));
  EXPECT_FALSE(falls(cloth(kTop + 0.004), bed()));
}

// A block, or a sheet, is on a table and weighs what it and the cloth on it weigh.
TEST(LinkTouch, IsBorneByWhatTheTissueStandsOn) {
  struct Case {
    bool sheet;
    double mass;
  };
  for (const Case& each : {Case{false, 0.002}, {false, kClothMass}, {false, 0.06}, {true, 0.001}, {true, kClothMass}}) {
    SCOPED_TRACE(::testing::Message() << each.sheet << " " << each.mass);
    TissueDefinition standing = each.sheet ? drum() : bed();
    standing.fixed.clear();
    const double mass = each.mass;
    SoftDefinition of = cloth((each.sheet ? 0.0 : kTop) + 0.004);
    of.mass = mass;
    Bed lies(of, standing);
    Body table(parameters(0.0, {box(0.2, 0.2, 0.1)}, {0.02, 0.02, -0.0515}));
    lies.world.add(table);
    lies.step(3000);
    double weight = 0.0;
    for (int i = 0; i < 500; ++i) {
      lies.step(1);
      weight -= lies.tissue.force_on(table).z / 500.0;
    }
    EXPECT_NEAR(weight, (lies.tissue.mass() + mass) * kG, 0.01 * mass * kG);
    lies.world.remove(table);
  }
}

TEST(LinkTouch, SticksBelowItsFrictionAndSlidesAbove) {
  for (const double friction : {0.2, 0.5}) {
    for (const double share : {0.95, 1.1}) {
      SCOPED_TRACE(::testing::Message() << friction << " " << share);
      Bed lies(cloth(kTop + 0.0021), bed(friction));
      lies.step(500);
      const double angle = std::atan(friction * share);
      lies.world.set_gravity({kG * std::sin(angle), 0, -kG * std::cos(angle)});
      lies.step(share < 1.0 ? 500 : 100);  // the tissue leans
      const double before = lies.middle().x;
      lies.step(150);
      const double way = lies.middle().x - before;
      if (share < 1.0)
        EXPECT_LT(way, 5e-5);
      else
        EXPECT_GT(way, 1e-3);
    }
  }
}

TEST(LinkTouch, NothingPassesAFallingClothOfAnyMass) {
  for (const double mass : {0.001, 0.1}) {
    SCOPED_TRACE(mass);
    SoftDefinition of = cloth(kTop + 0.05);
    of.mass = mass;
    Bed lies(of);
    double lowest = 1.0;
    for (int i = 0; i < 1500; ++i) {
      lies.step(1);
      for (std::size_t k = 0; k < lies.soft.node_count(); ++k) lowest = std::min(lowest, lies.soft.position(k).z);
    }
    EXPECT_GT(lowest, 0.005);
    EXPECT_GT(lies.middle().z, kTop - 0.002);
    EXPECT_LT(lies.middle().z, kTop + 2 * kMargin);
    EXPECT_FALSE(lies.soft.frozen());
  }
}

// A hand presses a swab on it: it gives way, and the hand feels it.
TEST(LinkTouch, IsPressedByWhatAHandHolds) {
  Bed lies(cloth(kTop + 0.003));
  Body hand(mass_only(0.0, {}, {{0.02, 0.02, kTop + 0.003}, {}}));
  lies.world.add(hand);
  SoftGrip grip({1e3, 1.0});
  for (std::size_t i = 0; i < 40; ++i) ASSERT_TRUE(grip.hold(hand, lies.soft, i + 12));
  for (int i = 1; i <= 400; ++i) {
    hand.move_to({{0.02, 0.02, kTop + 0.003 - 1e-5 * i}, {}});
    lies.step(1);
  }
  lies.step(300);
  double pressed = 0.0, lowest = 1.0;
  for (const HeldNode& each : grip.held()) pressed -= each.force_world.z;
  for (std::size_t i = 0; i < lies.tissue.node_count(); ++i)
    if (lies.tissue.position(i).z > 0.5 * kTop) lowest = std::min(lowest, lies.tissue.position(i).z);
  EXPECT_GT(pressed, 0.2);
  EXPECT_LT(lowest, kTop - 0.001);
  grip.release();
  lies.world.remove(hand);
}

// Deeper than what tissue meets that it did not know before.
TEST(LinkTouch, StaysOutsideHoweverDeepItIsPressed) {
  Bed lies(cloth(kTop + 0.003));
  Body hand(mass_only(0.0, {}, {{0.02, 0.02, kTop + 0.003}, {}}));
  lies.world.add(hand);
  SoftGrip grip({1e3, 1.0});
  for (std::size_t i = 0; i < 40; ++i) ASSERT_TRUE(grip.hold(hand, lies.soft, i + 12));
  for (int i = 1; i <= 750; ++i) {
    hand.move_to({{0.02, 0.02, kTop + 0.003 - 2e-5 * i}, {}});
    lies.step(1);
  }
  ASSERT_LT(lies.soft.position(28).z, kTop - 0.01);
  double pressed = 0.0;
  for (const HeldNode& each : grip.held()) pressed -= each.force_world.z;
  EXPECT_GT(pressed, 5.0);
  grip.release();
  lies.step(50);
  for (std::size_t i = 0; i < lies.soft.node_count(); ++i) EXPECT_GT(lies.soft.position(i).z, kTop) << i;
  lies.world.remove(hand);
}

TEST(LinkTouch, ComesToRestOnWhatIsThinHoweverFastItComes) {
  TissueDefinition thin = tissue_of(block({0.04, 0.04, 0.008}), 0.004, 2e4);
  for (std::uint32_t i = 0; i < thin.grid.corners.size(); ++i)
    if (thin.grid.corners[i].z < 1e-9) thin.fixed.push_back(i);
  Bed lies(cloth(0.02), thin);
  lies.soft.apply_wrench({{0, 0, -kClothMass * 3.0 / 0.001}, {}});  // 3 m/s
  lies.step(1000);
  for (std::size_t i = 0; i < lies.soft.node_count(); ++i)
    EXPECT_NEAR(lies.soft.position(i).z, 0.008 + kMargin, 1e-3) << i;
}

// It lies over the seam of two blocks.
TEST(LinkTouch, SticksToTwoTissuesAtOnce) {
  SoftDefinition of = cloth(kTop + 0.003);
  of.T_world_body.position.x -= 0.02;
  TissueDefinition beside = bed();
  beside.T_world_body.position.x = -0.0401;
  Bed lies(of);
  Tissue second(beside);
  add(lies.world, second);
  lies.step(500);
  lies.world.set_gravity({0.45 * kG, 0, -kG});
  lies.step(500);
  const double before = lies.middle().x;
  lies.step(300);
  EXPECT_LT(std::abs(lies.middle().x - before), 5e-5);
  EXPECT_GT(lies.middle().z, kTop);
  remove(lies.world, second);
  lies.step(200);
  EXPECT_LT(lies.soft.position(0).z, kTop) << "nothing is there any more";
}

}  // namespace
}  // namespace ambf::physics
