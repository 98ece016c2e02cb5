// Makes JPEGs (libjpeg-turbo). Never throws or prints. Any thread but the physics thread.
#pragma once

#include <cstdint>
#include <vector>

namespace ambf::render {

inline constexpr int kJpegQuality = 90;  // hardly distinguishable from the original

// 8 bits a channel, rows from top to bottom. Empty when it cannot (sizes that do not fit).
std::vector<std::uint8_t> encode_jpeg(const std::vector<std::uint8_t>& rgb, int width, int height);

}  // namespace ambf::render
