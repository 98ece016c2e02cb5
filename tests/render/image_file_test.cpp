#include "render/images/image_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace ambf::render {
namespace {

namespace fs = std::filesystem;

class ImageFile : public ::testing::Test {
 protected:
  ImageFile() : path_((fs::temp_directory_path() / ("ambf image " + std::to_string(getpid()))).string()) {}
  ~ImageFile() override { fs::remove(path_); }
  void put(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }
  std::string bytes() {
    std::ostringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }
  std::string path_, why_;
  Image image_;
};

TEST_F(ImageFile, PngsComeBackAsTheyWereWritten) {
  const Image image{2, 1, {1, 2, 3, 255, 250, 128, 7, 100}};
  ASSERT_TRUE(write_png(path_, image, why_)) << why_;
  ASSERT_TRUE(read_image(path_, image_, why_)) << why_;
  EXPECT_EQ(image_.width, 2);
  EXPECT_EQ(image_.height, 1);
  EXPECT_EQ(image_.rgba, image.rgba);
}

// 2 x 2 pixels of one grey, baseline, made once by an encoder.
const unsigned char kGreyJpeg[] = {
    0xff, 0xd8, 0xff, 0xe0, 0x00, 0x10, 'J',  'F',  'I',  'F',  0x00, 0x01, 0x01, 0x00, 0x00, 0x01, 0x00, 0x01,
    0x00, 0x00, 0xff, 0xdb, 0x00, 0x43, 0x00, 1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,
    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,
    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,
    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    0xff,
    0xc0, 0x00, 0x0b, 0x08, 0x00, 0x02, 0x00, 0x02, 0x01, 0x01, 0x11, 0x00, 0xff, 0xc4, 0x00, 0x14, 0x00, 0x01,
    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0x00, 0xff, 0xc4,
    0x00, 0x14, 0x10, 0x01, 0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
    0,    0x00, 0xff, 0xda, 0x00, 0x08, 0x01, 0x01, 0x00, 0x00, 0x3f, 0x00, 0x3f, 0xff, 0xd9};

TEST_F(ImageFile, JpegsAreReadToo) {
  put({reinterpret_cast<const char*>(kGreyJpeg), sizeof kGreyJpeg});
  ASSERT_TRUE(read_image(path_, image_, why_)) << why_;
  EXPECT_EQ(image_.width, 2);
  EXPECT_EQ(image_.height, 2);
  for (std::size_t i = 0; i < image_.rgba.size(); i += 4) {
    EXPECT_EQ(image_.rgba[i], 128);
    EXPECT_EQ(image_.rgba[i + 2], 128);
    EXPECT_EQ(image_.rgba[i + 3], 255);
  }
}

TEST_F(ImageFile, BrokenOnesGiveAReason) {
  for (const char* bytes : {"", "hello", "\x89PNG\r\n\x1a\n", "\xff\xd8\xff", "\xff\xd8\xff\xe0"}) {
    put(bytes);
    why_.clear();
    EXPECT_FALSE(read_image(path_, image_, why_));
    EXPECT_FALSE(why_.empty());
    EXPECT_TRUE(image_.rgba.empty());
  }
  EXPECT_FALSE(read_image("/no/such/file", image_, why_));
  EXPECT_FALSE(read_image("/", image_, why_));
}

TEST_F(ImageFile, NoBytesDoHarm) {
  Image picture{16, 16, std::vector<std::uint8_t>(16 * 16 * 4, 77)};
  ASSERT_TRUE(write_png(path_, picture, why_));
  const std::string seeds[] = {bytes(), {reinterpret_cast<const char*>(kGreyJpeg), sizeof kGreyJpeg}};
  std::mt19937 random(7);
  for (const std::string& seed : seeds) {
    for (int i = 0; i < 300; ++i) {
      std::string bytes = seed;
      for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      if (i % 4 == 0) bytes.resize(random() % bytes.size());
      put(bytes);
      Image image;
      if (read_image(path_, image, why_)) {
        EXPECT_EQ(image.rgba.size(),
                  static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
      }
    }
  }
}

}  // namespace
}  // namespace ambf::render
