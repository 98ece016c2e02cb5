// The camera a window looks through: an object of the simulation that the mouse moves by commands like anybody else, so that ROS users
// see it move and can move it; or, where there is none, one of our own that frames the whole scene. Main thread.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "render/camera.h"
#include "render/motion.h"
#include "render/mouse.h"
#include "state/control.h"

namespace ambf::render {

class ViewCamera {
 public:
  explicit ViewCamera(state::Control& control) : control_(control) {}

  // Once a picture, with the newest frame and what will be drawn. `scene` bounds what there is to see.
  void follow(const state::Frame& frame, const ScenePoses& poses, const Sphere& scene, double aspect,
              std::int64_t now_ns);

  const Camera& camera() const { return camera_; }
  const std::string& name() const { return name_; }
  const View& view() const { return view_; }
  double pan_multiplier() const { return info_.pan; }
  double rotate_multiplier() const { return info_.rotate; }
  double scroll_multiplier() const { return info_.scroll; }
  double arcball_multiplier() const { return info_.arcball; }
  unsigned monitor() const { return info_.monitor; }

  void move(const View& view, std::int64_t now_ns);
  void widen(double factor);  // the width of an orthographic view
  void rest();                // the mouse was let go
  // All cameras of `frame` back to where they were first seen.
  void reset_all(const state::Frame& frame, std::int64_t now_ns);

 private:
  void choose(const state::Structure& structure, const state::Frame& frame);
  void take_over(const state::Structure& structure, std::uint32_t slot, const state::Frame& frame);

  state::Control& control_;
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  state::ObjectId object_;  // invalid: our own camera
  std::uint32_t slot_ = state::kNone;
  std::unique_ptr<state::CommandPort> port_;
  state::CameraInfo info_;
  std::string name_;
  Camera camera_;
  View view_;
  math::Pose T_world_parent_;
  bool framed_ = false;                              // our own camera was placed
  std::int64_t moved_ns_ = 0;                        // when the mouse last moved it
  std::map<std::uint64_t, math::Pose> first_poses_;  // T_parent_camera by object
};

}  // namespace ambf::render
