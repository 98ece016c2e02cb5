#include "progress.h"

#include <gtest/gtest.h>

namespace ambf::simulator {
namespace {

TEST(Progress, SaysHowFarItIsAndHowLongItWillTake) {
  EXPECT_EQ(progress_text(45, 150, 18.0), "[######--------------]  30 %, 0:42 left");
  EXPECT_EQ(progress_text(1, 4, 40.0), "[#####---------------]  25 %, 2:00 left");
  EXPECT_EQ(progress_text(7, 7, 3.0), "[####################] 100 %, 0:00 left");
}

}  // namespace
}  // namespace ambf::simulator
