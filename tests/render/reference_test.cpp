// The comparison with reference pictures notices what a user would notice.
#include <gtest/gtest.h>

#include "reference_picture.h"

namespace ambf::render::testing {
namespace {

// Grey with a red square whose left edge is at `x_px`.
Image square_at(int x_px) {
  Image image{64, 48, std::vector<std::uint8_t>(std::size_t{4} * 64 * 48, 128)};
  for (int y = 16; y < 32; ++y) {
    for (int x = x_px; x < x_px + 16; ++x) {
      std::uint8_t* pixel = &image.rgba[4 * static_cast<std::size_t>(y * 64 + x)];
      pixel[0] = 220;
      pixel[1] = pixel[2] = 20;
    }
  }
  return image;
}

TEST(ReferencePictures, AnEqualOneDoesNotDiffer) {
  const Difference same = difference_of(square_at(20), square_at(20), 40);
  EXPECT_EQ(same.mean, 0.0);
  EXPECT_EQ(same.share, 0.0);
}

TEST(ReferencePictures, AnEdgeThatIsRoundedDifferentlyIsNotWrongButAThingElsewhereIs) {
  EXPECT_EQ(difference_of(square_at(21), square_at(20), 40).share, 0.0);
  EXPECT_GT(difference_of(square_at(26), square_at(20), 40).share, Tolerance().share);
}

TEST(ReferencePictures, AThinLineThatVanishedIsAPatch) {
  Image with_line = square_at(20);
  for (int x = 40; x < 60; ++x) with_line.rgba[4 * static_cast<std::size_t>(40 * 64 + x)] = 255;
  const Difference difference = difference_of(square_at(20), with_line, 40);
  EXPECT_LT(difference.mean, Tolerance().mean);
  EXPECT_EQ(difference.patch, 20);
  EXPECT_FALSE(within(difference, Tolerance()));
}

TEST(ReferencePictures, SinglePixelsHereAndThereAreNoPatch) {
  Image grained = square_at(20);
  for (const int at : {5 * 64 + 3, 8 * 64 + 50, 40 * 64 + 10, 44 * 64 + 30}) {
    grained.rgba[4 * static_cast<std::size_t>(at)] = 255;
  }
  const Difference difference = difference_of(grained, square_at(20), 40);
  EXPECT_EQ(difference.patch, 1);
  EXPECT_TRUE(within(difference, Tolerance()));
}

TEST(ReferencePictures, ADifferentBrightnessEverywhereShowsInTheMean) {
  Image darker = square_at(20);
  for (std::uint8_t& value : darker.rgba) value = static_cast<std::uint8_t>(value - value / 16);
  EXPECT_GT(difference_of(darker, square_at(20), 40).mean, Tolerance().mean);
}

TEST(ReferencePictures, AnotherSizeIsAnotherPicture) {
  Image other = square_at(20);
  std::swap(other.width, other.height);
  EXPECT_EQ(difference_of(other, square_at(20), 40).share, 1.0);
}

}  // namespace
}  // namespace ambf::render::testing
