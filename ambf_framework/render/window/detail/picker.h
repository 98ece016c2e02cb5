// One pointer's grasp of a body: a ray into the simulation finds it, then a spring pulls the grasped point towards the
// pointer, at the depth of the grasp. One per window. Main thread; the ray's answer arrives without waiting.
#pragma once

#include <memory>

#include "render/camera/camera.h"
#include "render/scene/motion.h"
#include "state/abilities/pick.h"

namespace ambf::render {

class Picker {
 public:
  explicit Picker(state::PickAbility& pick) : port_(pick.make_pick_port()) {}

  // False when the simulation has no free pick port.
  bool press(const Camera& camera, double width, double height, double x_px, double y_px);
  void drag(const Camera& camera, double width, double height, double x_px, double y_px);
  void release();

  // Once per picture: reads the ray's answer. True when a body was just picked; room, ground and walls are not held
  // then.
  bool update(const state::Frame& frame, const ScenePoses& poses, const Camera& camera);

  bool pressed() const { return pressed_; }
  bool holds() const { return holding_; }
  state::ObjectId last() const { return last_; }  // the body picked last
  void set_last(state::ObjectId object) { last_ = object; }
  // While holding: the slot of what is held, where it is pulled to (world), by what force (N); zero for what is moved
  // instead.
  std::uint32_t body() const { return body_; }
  const math::Vec3& target() const { return target_world_; }
  const math::Vec3& force() const { return force_world_; }

 private:
  struct Answer;

  std::unique_ptr<state::PickPort> port_;  // null: no free port
  std::shared_ptr<Answer> answer_;         // of the ray in flight
  bool pressed_ = false, holding_ = false;
  bool seen_ = false;  // a frame has shown the grasp
  double width_ = 1.0, height_ = 1.0, x_px_ = 0.0, y_px_ = 0.0;
  double depth_m_ = 0.0;  // along the view, of the grasped point
  state::ObjectId last_, held_;
  std::uint32_t body_ = state::kNone;
  math::Vec3 target_world_, force_world_;
};

}  // namespace ambf::render
