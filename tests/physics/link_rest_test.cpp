// Soft bodies of links that lie on tissue: sleep, states, and what either does without the other.
#include <gtest/gtest.h>

#include "tests/physics/link_bed.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

TEST(LinkTouch, SleepsOnASheet) {
  SoftDefinition of = cloth(0.004);
  of.mass = 0.001;
  Bed lies(of, drum(0.001));
  lies.step(9000);
  EXPECT_TRUE(lies.soft.asleep() && lies.tissue.asleep());
}

TEST(LinkTouch, SleepsTogetherAndWakesTogether) {
  Bed lies(cloth(kTop + 0.004));
  lies.step(8000);
  EXPECT_TRUE(lies.soft.asleep());
  EXPECT_TRUE(lies.tissue.asleep());
  const Vec3 before = lies.middle();
  lies.soft.apply_force(0, {0, 0, 1e-3});
  lies.step(1);
  EXPECT_FALSE(lies.soft.asleep());
  EXPECT_FALSE(lies.tissue.asleep());
  lies.step(8000);
  ASSERT_TRUE(lies.soft.asleep() && lies.tissue.asleep());
  lies.tissue.apply_force(lies.tissue.node_count() - 1, {0, 0, 1e-3});
  lies.step(1);
  EXPECT_FALSE(lies.tissue.asleep());
  lies.step(1);
  EXPECT_FALSE(lies.soft.asleep());
  lies.step(8000);
  ASSERT_TRUE(lies.soft.asleep() && lies.tissue.asleep());
  EXPECT_LT(math::norm(lies.middle() - before), 1e-4);
  remove(lies.world, lies.soft);
  lies.step(1);
  EXPECT_FALSE(lies.tissue.asleep());
  add(lies.world, lies.soft);
}

TEST(LinkTouch, ContinuesFromItsStateBitForBit) {
  for (const int flags : {1, 0x11, 2}) {
    SCOPED_TRACE(flags);
    const bool sheet = flags == 2;
    Bed lies(sheet ? cloth(0.004) : cloth(kTop + 0.004, flags), sheet ? drum() : bed());
    lies.step(150);
    std::vector<double> of_links, of_tissue, later, again;
    std::vector<std::byte> saved;
    lies.world.save_state(saved);
    lies.soft.get_state(of_links);
    lies.tissue.get_state(of_tissue);
    const auto goes_on = [&](std::vector<double>& into) {
      lies.step(300);
      std::vector<double> more;
      lies.soft.get_state(into);
      lies.tissue.get_state(more);
      into.insert(into.end(), more.begin(), more.end());
    };
    goes_on(later);
    ASSERT_TRUE(lies.world.restore_state(saved));
    EXPECT_TRUE(lies.soft.set_state(of_links));
    EXPECT_TRUE(lies.tissue.set_state(of_tissue));
    goes_on(again);
    EXPECT_EQ(later, again);
    Bed anew(sheet ? cloth(0.004) : cloth(kTop + 0.004, flags), sheet ? drum() : bed());
    anew.step(150);
    std::vector<double> repeated;
    anew.soft.get_state(repeated);
    EXPECT_EQ(repeated, of_links);
  }
}

TEST(LinkTouch, EndsWithTheTissue) {
  Bed lies(cloth(kTop + 0.004));
  lies.step(500);
  const double height = lies.middle().z;
  remove(lies.world, lies.tissue);
  lies.step(100);
  EXPECT_LT(lies.middle().z, height - 0.01);
  add(lies.world, lies.tissue);
}

TEST(LinkTouch, TissueRisesAsItIsTakenAway) {
  SoftDefinition of = cloth(kTop + 0.004);
  of.mass = 0.1;
  Bed lies(of);
  lies.step(500);
  const auto top = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < lies.tissue.node_count(); ++i) sum += lies.tissue.position(i).z;
    return sum / static_cast<double>(lies.tissue.node_count());
  };
  const double before = top();
  remove(lies.world, lies.soft);
  lies.step(300);
  EXPECT_GT(top(), before + 5e-5);
  add(lies.world, lies.soft);
}

}  // namespace
}  // namespace ambf::physics
