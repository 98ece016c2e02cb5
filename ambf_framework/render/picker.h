// Holding a body with the pointer: a ray into the simulation, then a pull towards where the pointer is, at the depth where it was grasped.
// Main thread; the answer to the ray comes from another one without waiting.
#pragma once

#include <memory>

#include "render/camera.h"
#include "render/motion.h"
#include "state/control.h"

namespace ambf::render {

class Picker {
 public:
  explicit Picker(state::Control& control) : control_(control) {}

  void press(const Camera& camera, double width, double height, double x_px, double y_px);
  void drag(const Camera& camera, double width, double height, double x_px, double y_px);
  void release();

  // Once a picture: takes the answer to the ray when it has come. True when a body was just grasped.
  bool update(const state::Frame& frame, const ScenePoses& poses, const Camera& camera);

  bool pressed() const { return pressed_; }
  bool holds() const { return holding_; }
  state::ObjectId last() const { return last_; }  // the body picked last
  // While holding: the body's slot, the grasped point on it and where it is pulled to (world).
  std::uint32_t body() const { return body_; }
  math::Vec3 grasped(const ScenePoses& poses) const { return poses.bodies[body_] * point_body_; }
  const math::Vec3& target() const { return target_world_; }

 private:
  struct Answer;

  state::Control& control_;
  std::shared_ptr<Answer> answer_;  // of the ray on its way
  bool pressed_ = false, holding_ = false;
  double width_ = 1.0, height_ = 1.0, x_px_ = 0.0, y_px_ = 0.0;
  double depth_m_ = 0.0;  // along the view, of the grasped point
  state::ObjectId last_, held_;
  std::uint32_t body_ = state::kNone;
  math::Vec3 point_body_, target_world_;
};

}  // namespace ambf::render
