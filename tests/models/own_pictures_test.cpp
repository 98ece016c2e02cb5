// Each scene of launch.yaml, in its own world, as its main camera shows it: the picture holds the scene, large and in
// its middle. The pictures of docs/gallery.md are taken from there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "adf/adf.h"
#include "tests/render/still_picture.h"

namespace ambf {
namespace {

constexpr int kWidth = 320, kHeight = 180;
const std::string kLaunch = std::string(AMBF_MODELS_DIR) + "/descriptions/launch.yaml";

class OwnPictures : public testing::TestWithParam<std::size_t> {};

TEST_P(OwnPictures, TheMainCameraFramesTheScene) {
  const adf::LaunchResult launch = adf::load_launch(kLaunch);
  ASSERT_TRUE(launch.launch);
  const std::size_t place = GetParam();
  const std::string world = launch.launch->world_files.at(place), model = launch.launch->model_files.at(place);
  const render::Image with = render::testing::still_picture(launch, world, {model}, kWidth, kHeight);
  const render::Image without = render::testing::still_picture(launch, world, {}, kWidth, kHeight);
  ASSERT_EQ(with.rgba.size(), static_cast<std::size_t>(4 * kWidth * kHeight));
  ASSERT_EQ(without.rgba.size(), with.rgba.size());
  // Where the model changes the picture: itself and its shadow. A few stray pixels are shadows of the room that got
  // finer or coarser.
  int changed = 0;
  std::vector<int> in_column(kWidth), in_row(kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto i = static_cast<std::size_t>(4 * (y * kWidth + x));
      int difference = 0;
      for (std::size_t c = 0; c < 3; ++c) difference += std::abs(with.rgba[i + c] - without.rgba[i + c]);
      if (difference < 60) continue;
      ++changed;
      ++in_column[static_cast<std::size_t>(x)];
      ++in_row[static_cast<std::size_t>(y)];
    }
  }
  const auto counts = [](int pixels) { return pixels >= 4; };
  const auto length = [&](const std::vector<int>& pixels) {
    return std::count_if(pixels.begin(), pixels.end(), counts);
  };
  std::printf("%s: %.0f %% of the picture, %td columns, %td rows\n", model.c_str(),
              100.0 * changed / (kWidth * kHeight), length(in_column), length(in_row));
  EXPECT_GT(changed, kWidth * kHeight * 5 / 100);
  EXPECT_FALSE(counts(in_column.front()) || counts(in_column.back()))
      << "cut off at a side: " << in_column.front() << " and " << in_column.back() << " pixels";
  EXPECT_TRUE(counts(in_column[kWidth / 2]) && counts(in_row[kHeight / 2])) << "not in the middle";
  EXPECT_TRUE(length(in_column) > kWidth * 4 / 10 || length(in_row) > kHeight * 6 / 10) << "too small";
}

// Of all scenes.
std::vector<std::string> names() {
  std::vector<std::string> found;
  const adf::LaunchResult launch = adf::load_launch(kLaunch);
  if (!launch.launch) return found;
  for (const std::string& file : launch.launch->model_files)
    found.push_back(std::filesystem::path(file).stem().string());
  return found;
}

INSTANTIATE_TEST_SUITE_P(Places, OwnPictures, testing::Range(std::size_t{0}, names().size()),
                         [](const auto& parameter) { return names().at(parameter.param); });

}  // namespace
}  // namespace ambf
