// Compares a picture with the committed one of its name, tests/render/reference/NAME.png. AMBF_UPDATE_PICTURES=1
// writes the reference instead: then look at it, as a user would, before it is committed. Keep references small (320
// x 240).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "render/images/image_file.h"

namespace ambf::render::testing {

// Another driver rounds edges and colours differently: single pixels here and there. A thing that vanished, came or
// moved makes a patch of wrong pixels, however small a share of the picture it is.
struct Tolerance {
  double mean = 2.0;    // of 255, over all pixels and channels
  int strong = 40;      // of 255: a pixel that differs by more in a channel is wrong
  double share = 0.01;  // of the pixels may be wrong ...
  int patch = 8;        // ... and so many that touch each other
};

struct Difference {
  double mean = 0.0;   // of 255
  double share = 1.0;  // of the pixels that are wrong: one picture has nothing like them among the 3 x 3 around it
  int patch = 0;       // pixels of the largest patch of these
};

// Marks pixels of `a` that differ by more than `strong` from each of the 3 x 3 pixels of `b` around them.
inline void mark_missing(const Image& a, const Image& b, int strong, std::vector<bool>& wrong) {
  const auto at = [](const Image& image, int x, int y) {
    return &image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
  };
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const std::uint8_t* p = at(a, x, y);
      int nearest = 255;
      for (int v = std::max(0, y - 1); v <= std::min(a.height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(a.width - 1, x + 1); ++u) {
          const std::uint8_t* q = at(b, u, v);
          nearest = std::min(nearest, std::max({std::abs(p[0] - q[0]), std::abs(p[1] - q[1]), std::abs(p[2] - q[2])}));
        }
      }
      if (nearest > strong) wrong[static_cast<std::size_t>(y * a.width + x)] = true;
    }
  }
}

// Pixels of the largest patch; pixels that touch at a corner are in one. Clears `wrong`.
inline int largest_patch(std::vector<bool>& wrong, int width, int height) {
  int largest = 0;
  std::vector<int> open;
  for (int start = 0; start < width * height; ++start) {
    int size = 0;
    const auto visit = [&](int pixel) {
      if (!wrong[static_cast<std::size_t>(pixel)]) return;
      wrong[static_cast<std::size_t>(pixel)] = false;
      open.push_back(pixel);
      ++size;
    };
    visit(start);
    while (!open.empty()) {
      const int x = open.back() % width, y = open.back() / width;
      open.pop_back();
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) visit(v * width + u);
      }
    }
    largest = std::max(largest, size);
  }
  return largest;
}

inline Difference difference_of(const Image& picture, const Image& reference, int strong) {
  if (picture.width != reference.width || picture.height != reference.height) return {255.0, 1.0, 0};
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    if (i % 4 != 3) sum += std::abs(picture.rgba[i] - reference.rgba[i]);
  }
  std::vector<bool> wrong(picture.rgba.size() / 4);
  mark_missing(picture, reference, strong, wrong);
  mark_missing(reference, picture, strong, wrong);
  const auto pixels = static_cast<double>(wrong.size());
  const auto count = static_cast<double>(std::count(wrong.begin(), wrong.end(), true));
  return {sum / (3.0 * pixels), count / pixels, largest_patch(wrong, picture.width, picture.height)};
}

inline std::filesystem::path reference_file(const std::string& name) {
  return std::filesystem::path(AMBF_SOURCE_DIR) / "tests/render/reference" / (name + ".png");
}

inline bool within(const Difference& difference, const Tolerance& tolerance) {
  return difference.mean <= tolerance.mean && difference.share <= tolerance.share &&
         difference.patch <= tolerance.patch;
}

inline ::testing::AssertionResult matches_reference(const Image& picture, const std::string& name,
                                                    const Tolerance& tolerance = {}) {
  const std::filesystem::path file = reference_file(name);
  std::string why;
  if (std::getenv("AMBF_UPDATE_PICTURES") != nullptr) {
    if (!write_png(file.string(), picture, why)) return ::testing::AssertionFailure() << file << ": " << why;
    return ::testing::AssertionSuccess();
  }
  Image reference;
  if (!read_image(file.string(), reference, why)) return ::testing::AssertionFailure() << file << ": " << why;
  const Difference difference = difference_of(picture, reference, tolerance.strong);
  if (within(difference, tolerance)) return ::testing::AssertionSuccess();
  const std::filesystem::path shown = std::filesystem::temp_directory_path() / ("ambf_" + name + ".png");
  write_png(shown.string(), picture, why);
  return ::testing::AssertionFailure() << name << " differs from " << file << " by " << difference.mean
                                       << " of 255 on average, and strongly in " << 100.0 * difference.share
                                       << " % of the pixels, at most " << difference.patch
                                       << " of them in one place; this picture: " << shown;
}

// For pictures from which a small thing was left out: the comparison must notice that.
inline ::testing::AssertionResult differs_from_reference(const Image& picture, const std::string& name,
                                                         const Tolerance& tolerance = {}) {
  if (std::getenv("AMBF_UPDATE_PICTURES") != nullptr) return ::testing::AssertionSuccess();
  Image reference;
  std::string why;
  if (!read_image(reference_file(name).string(), reference, why)) return ::testing::AssertionFailure() << why;
  const Difference difference = difference_of(picture, reference, tolerance.strong);
  if (!within(difference, tolerance)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "taken for " << name << ": differs by " << difference.mean << " of 255, in "
                                       << 100.0 * difference.share << " % of the pixels, at most " << difference.patch
                                       << " of them in one place";
}

}  // namespace ambf::render::testing
