#include "render/window/detail/window_place.h"

#include <gtest/gtest.h>

namespace ambf::render {
namespace {

constexpr Area kMonitor{100, 50, 1920, 1080};

TEST(WindowPlace, AloneItHasTheReferencesSizeInTheMiddle) {
  EXPECT_EQ(place_window(0, 1, kMonitor), (Area{100 + 192, 50 + 270, 1536, 540}));
}

TEST(WindowPlace, TwoDoNotOverlapAndFitWithTheirTitleBars) {
  const Area upper = place_window(0, 2, kMonitor), lower = place_window(1, 2, kMonitor);
  EXPECT_EQ(upper.width, 1536);
  EXPECT_GT(upper.top, 50);  // room for its title bar
  EXPECT_GT(lower.top, upper.top + upper.height);
  EXPECT_LE(lower.top + lower.height, 50 + 1080);
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
