// Compares a picture with the committed one of its name, tests/render/reference/NAME.png. AMBF_UPDATE_PICTURES=1 writes the
// reference instead: then look at it, as a user would, before it is committed. Keep references small (320 x 240).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "render/pictures/image_file.h"

namespace ambf::render::testing {

// Another driver rounds edges differently, another Mesa rounds colours: what a user would not see passes.
struct Tolerance {
  double mean = 2.0;    // of 255, over all pixels and channels
  int strong = 40;      // of 255: a pixel that differs by more in a channel is wrong ...
  double share = 0.01;  // ... and so many of them may be
};

struct Difference {
  double mean = 0.0;   // of 255
  double share = 1.0;  // of the pixels that differ strongly from every one of the reference's 3 x 3 around it
};

inline Difference difference_of(const Image& picture, const Image& reference, int strong) {
  if (picture.width != reference.width || picture.height != reference.height) return {255.0, 1.0};
  const auto at = [&](const Image& image, int x, int y) {
    return &image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
  };
  const auto apart = [](const std::uint8_t* a, const std::uint8_t* b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
  };
  double sum = 0.0;
  int wrong = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t *p = at(picture, x, y), *r = at(reference, x, y);
      for (int c = 0; c < 3; ++c) sum += std::abs(p[c] - r[c]);
      int nearest = 255;
      for (int v = std::max(0, y - 1); v <= std::min(picture.height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(picture.width - 1, x + 1); ++u) {
          nearest = std::min(nearest, apart(p, at(reference, u, v)));
        }
      }
      wrong += nearest > strong ? 1 : 0;
    }
  }
  const double pixels = static_cast<double>(picture.width) * picture.height;
  return {sum / (3.0 * pixels), wrong / pixels};
}

inline ::testing::AssertionResult matches_reference(const Image& picture, const std::string& name,
                                                    const Tolerance& tolerance = {}) {
  const std::filesystem::path file =
      std::filesystem::path(AMBF_SOURCE_DIR) / "tests/render/reference" / (name + ".png");
  std::string why;
  if (std::getenv("AMBF_UPDATE_PICTURES") != nullptr) {
    if (!write_png(file.string(), picture, why)) return ::testing::AssertionFailure() << file << ": " << why;
    return ::testing::AssertionSuccess();
  }
  Image reference;
  if (!read_image(file.string(), reference, why)) return ::testing::AssertionFailure() << file << ": " << why;
  const Difference difference = difference_of(picture, reference, tolerance.strong);
  if (difference.mean <= tolerance.mean && difference.share <= tolerance.share) {
    return ::testing::AssertionSuccess();
  }
  const std::filesystem::path shown = std::filesystem::temp_directory_path() / ("ambf_" + name + ".png");
  write_png(shown.string(), picture, why);
  return ::testing::AssertionFailure() << name << " differs from " << file << " by " << difference.mean
                                       << " of 255 on average, and strongly in " << 100.0 * difference.share
                                       << " % of the pixels; this picture: " << shown;
}

}  // namespace ambf::render::testing
