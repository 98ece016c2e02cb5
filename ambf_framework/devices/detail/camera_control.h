// Moves the cameras of a device while its camera clutch is pressed: all of them, each in its own axes (Table 3.5, rows
// 1 and 2). A camera that somebody else moves is left alone until that ends. Device's thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "devices/detail/frame_view.h"
#include "devices/device_settings.h"
#include "devices/mapping.h"

namespace ambf::devices {

class CameraControl {
 public:
  explicit CameraControl(state::Source source) : source_(source) {}

  // Before the mapping's tick: acquires or releases the cameras. `pressed`: the camera clutch is, and counts.
  void acquire(EffectorBinding* binding, const FrameView& view, bool pressed);
  bool holds(std::size_t camera) const { return camera < FrameView::kMaxCameras && held_[camera]; }
  bool holds_any() const { return held() != 0; }
  std::uint16_t held() const;  // bit n: the n-th camera
  // After it: commands all that are held. The first camera is where the mapping wants it.
  void command(EffectorBinding* binding, const FrameView& view, const state::MappingFrames& frames,
               const math::Pose& T_u_iid_previous, double camera_scaling, std::int64_t now_ns);

 private:
  const state::Source source_;
  std::array<bool, FrameView::kMaxCameras> held_{};
  std::array<CameraClutch, FrameView::kMaxCameras> clutches_;
};

}  // namespace ambf::devices
