#include "render/images/texture_loader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace ambf::render {
namespace {

class Textures : public ::testing::Test {
 protected:
  Textures() { std::filesystem::create_directories(folder_); }
  ~Textures() override { std::filesystem::remove_all(folder_); }
  // Grey levels, rows from top to bottom.
  std::string file(int width, int height, const std::vector<int>& greys, int alpha = 255) const {
    Image image{width, height, {}};
    for (const int grey : greys) {
      for (int c = 0; c < 3; ++c) image.rgba.push_back(static_cast<std::uint8_t>(grey));
      image.rgba.push_back(static_cast<std::uint8_t>(alpha));
    }
    const std::string path = folder_ / (std::to_string(++files_) + ".png");
    std::string why;
    EXPECT_TRUE(write_png(path, image, why)) << why;
    return path;
  }
  static int red(const Image& image, int x, int y) {
    return image.rgba.at(static_cast<std::size_t>(4 * (y * image.width + x)));
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("ambf textures " + std::to_string(getpid()));
  mutable int files_ = 0;
};

TEST_F(Textures, BeginAtTheBottomAsOpenGlWants) {
  const Decoded decoded = decode({file(1, 2, {10, 200}), TextureUse::color}, 64);
  EXPECT_EQ(red(decoded.levels.at(0), 0, 0), 200);
  EXPECT_EQ(red(decode({file(1, 2, {10, 200}), TextureUse::sky}, 64).levels.at(0), 0, 0),
            10);  // cubes begin at the top
}

TEST_F(Textures, AFineCheckBecomesTheGreyThatADistantViewerSees) {
  const std::string path = file(2, 2, {0, 255, 255, 0});
  const Decoded seen = decode({path, TextureUse::color}, 64), raw = decode({path, TextureUse::raw}, 64);
  ASSERT_EQ(seen.levels.size(), 2U);
  EXPECT_NEAR(red(seen.levels[1], 0, 0), 188, 1);  // half the light, coded as sRGB
  EXPECT_NEAR(red(raw.levels[1], 0, 0), 128, 1);
}

TEST_F(Textures, HaveAllLevelsDownToOneTexelWhateverTheirShape) {
  const Decoded decoded = decode({file(5, 2, std::vector<int>(10, 100)), TextureUse::color}, 64);
  ASSERT_EQ(decoded.levels.size(), 3U);
  EXPECT_EQ(decoded.levels[1].width, 2);
  EXPECT_EQ(decoded.levels[2].width, 1);
  EXPECT_EQ(decoded.levels[2].height, 1);
}

TEST_F(Textures, LargerThanTheCardTakesAreHalved) {
  const Decoded decoded = decode({file(40, 10, std::vector<int>(400, 100)), TextureUse::color}, 16);
  EXPECT_EQ(decoded.levels.at(0).width, 10);
}

TEST_F(Textures, SayWhetherTheyAreOpaque) {
  EXPECT_FALSE(decode({file(1, 1, {9}), TextureUse::color}, 64).has_alpha);
  EXPECT_TRUE(decode({file(1, 1, {9}, 100), TextureUse::color}, 64).has_alpha);
}

TEST_F(Textures, AGreyNormalMapIsTakenForHeights) {
  // A step upwards to the right: normals on it lean to the left.
  const Decoded decoded =
      decode({file(4, 4, {0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255}), TextureUse::normal}, 64);
  const Image& normals = decoded.levels.at(0);
  EXPECT_LT(red(normals, 1, 1), 100);
  EXPECT_GT(normals.rgba.at(4 * 5 + 2), 128);
}

TEST_F(Textures, AreDecodedAsideAndAskedForAgainAfterwards) {
  const std::string large = file(1500, 1500, std::vector<int>(1500 * 1500, 77)), small = file(1, 1, {1});
  TextureLoader loader(4096);
  loader.ask({large, TextureUse::color});
  EXPECT_TRUE(loader.busy());  // asking did not wait for it
  EXPECT_TRUE(loader.take_finished().empty());
  loader.ask({small, TextureUse::color});
  loader.ask({"/no/such/file.png", TextureUse::color});
  loader.wait();
  EXPECT_FALSE(loader.busy());
  const std::vector<Decoded> finished = loader.take_finished();
  ASSERT_EQ(finished.size(), 3U);
  EXPECT_EQ(finished[0].levels.at(0).width, 1500);
  EXPECT_EQ(finished[1].key.file, small);
  EXPECT_TRUE(finished[2].levels.empty());
  EXPECT_FALSE(finished[2].why.empty());
  loader.ask({small, TextureUse::normal});
  loader.wait();
  EXPECT_EQ(loader.take_finished().size(), 1U);
}

TEST_F(Textures, TheLoaderEndsWithoutFinishingWhatNobodyWaitsFor) {
  const std::string large = file(1500, 1500, std::vector<int>(1500 * 1500, 77));
  TextureLoader loader(4096);
  for (int i = 0; i < 1000; ++i) loader.ask({large, TextureUse::color});  // minutes, if they were finished
}

}  // namespace
}  // namespace ambf::render
