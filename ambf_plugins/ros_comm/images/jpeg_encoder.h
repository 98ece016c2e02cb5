// Who makes a JPEG of a picture: handed in, since ros_comm draws and decodes nothing itself. C++17.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace ambf::ros_comm {

// 8 bits a channel, rows from top to bottom. Empty when it cannot.
using JpegEncoder =
    std::function<std::vector<std::uint8_t>(const std::vector<std::uint8_t>& rgb, int width, int height)>;

}  // namespace ambf::ros_comm
