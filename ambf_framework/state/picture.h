// Pictures of cameras on their way from the renderer to the publisher, which do not know each other.
// Plain data and one interface. C++17.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "state/structure.h"

namespace ambf::state {

// Left and right are those of a stereo camera; every camera has a middle.
enum class Eye : std::uint8_t { middle, left, right };
inline constexpr std::size_t kEyes = 3;

enum class PictureKind : std::uint8_t { color, depth, mask };

// Where in a picture a point is. Optical axes: x right, y down, z ahead. Pixel centres are at whole numbers, from the
// upper left one. Perspective: u = (fx x + skew y)/z + cx, v = fy y/z + cy. Orthographic: u = fx x + cx, v = fy y + cy,
// with fx and fy in pixels a metre.
struct Intrinsics {
  int width = 0, height = 0;  // px
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0, skew = 0.0;
  bool orthographic = false;
  double baseline_m = 0.0;  // of a right eye: how far it is to the right of the left one
};

// One picture of one frame. Rows go from top to bottom; arrays that nobody wants are empty.
struct Picture {
  ObjectId camera;
  PictureKind kind = PictureKind::color;
  Eye eye = Eye::middle;
  Intrinsics intrinsics;
  std::int64_t system_ns = 0;  // of the frame
  std::uint32_t sim_step = 0;
  std::shared_ptr<const Structure> structure;

  std::vector<std::uint8_t> rgb;    // 8 bits a channel; with a depth: the colours of its points
  std::vector<float> depth_m;       // along the view axis; NaN where nothing is
  std::vector<float> points_m;      // with a depth that users' shaders computed: x, y, z of each pixel, optical axes
  std::vector<std::uint16_t> mask;  // mask_id() of whose surface it is; 0 where nothing is
};

// What an object is called in masks, for as long as it lives.
inline std::uint16_t mask_id(ObjectId id) {
  return static_cast<std::uint16_t>(id.index < 0xfffeu ? id.index + 1u : 0xffffu);
}

// What is wanted of one camera at this moment.
struct PictureWishes {
  std::array<bool, kEyes> color{};     // by Eye
  std::array<bool, kEyes> geometry{};  // only where the camera is and how it sees: nothing needs to be drawn for it
  bool depth = false;
  bool depth_color = false;  // with the colours of the points
  bool depth_geometry = false;
  bool mask = false;
};

// Takes pictures. Any thread; never waits for listeners.
class PictureSink {
 public:
  virtual ~PictureSink() = default;
  // Cheap: asked for every camera at every scene update.
  virtual PictureWishes wishes(ObjectId camera) const = 0;
  virtual void post(Picture picture) = 0;
  // Calls `start` as soon as there is a camera that publishes, at once where that is not known; so that nobody waits
  // for wishes that cannot come. Empty: forget what was given; it is not called afterwards.
  virtual void when_needed(const std::function<void()>& start) {
    if (start) start();
  }
};

inline bool anything(const PictureWishes& w) {
  bool wanted = w.depth || w.depth_color || w.depth_geometry || w.mask;
  for (std::size_t eye = 0; eye < kEyes; ++eye) wanted = wanted || w.color[eye] || w.geometry[eye];
  return wanted;
}

}  // namespace ambf::state
