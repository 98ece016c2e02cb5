#include "render/window/detail/window_place.h"

#include <gtest/gtest.h>

namespace ambf::render {
namespace {

constexpr Area kMonitor{100, 50, 1920, 1080};

TEST(WindowPlace, AloneItFillsFourFifthsOfTheMonitorOneWayAtSixteenToTen) {
  EXPECT_EQ(place_window(0, 1, kMonitor), (Area{100 + 269, 50 + 108, 1382, 863}));
  const Area small = place_window(0, 1, {0, 0, 900, 600}), upright = place_window(0, 1, {0, 0, 1080, 1920});
  EXPECT_EQ(small, (Area{90, 75, 720, 450}));
  EXPECT_EQ(upright.width, 864);
  EXPECT_EQ(upright.height, 540);
}

TEST(WindowPlace, TwoStandSideBySideOnAWideMonitorAndOverEachOtherOnAnUprightOne) {
  const Area left = place_window(0, 2, kMonitor), right = place_window(1, 2, kMonitor);
  EXPECT_EQ(left.width, 960);
  EXPECT_EQ(right.left, left.left + left.width);
  EXPECT_EQ(right.top, left.top);
  EXPECT_LT(left.width, 2 * left.height);
  const Area upright{0, 0, 1080, 1920};
  const Area upper = place_window(0, 2, upright), lower = place_window(1, 2, upright);
  EXPECT_GT(upper.top, 0) << "room for its title bar";
  EXPECT_GT(lower.top, upper.top + upper.height);
  EXPECT_LE(lower.top + lower.height, 1920);
}

TEST(WindowPlace, ManyAllHavePlacesOfTheirOwnOnTheMonitor) {
  for (unsigned i = 0; i < 7; ++i) {
    const Area mine = place_window(i, 7, kMonitor);
    EXPECT_GE(mine.left, 100);
    EXPECT_LE(mine.left + mine.width, 100 + 1920);
    for (unsigned k = 0; k < i; ++k) EXPECT_FALSE(mine == place_window(k, 7, kMonitor)) << i << " on " << k;
  }
}

TEST(WindowPlace, TilesFillAScreenWithoutGaps) {
  int right = 100;
  for (unsigned i = 0; i < 3; ++i) {
    const Area mine = tile(i, 3, kMonitor);
    EXPECT_EQ(mine.left, right);
    EXPECT_EQ(mine.height, 1080);
    right = mine.left + mine.width;
  }
  EXPECT_EQ(right, 100 + 1920);
}

}  // namespace
}  // namespace ambf::render
