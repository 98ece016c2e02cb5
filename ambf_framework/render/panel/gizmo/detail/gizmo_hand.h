// Moves one object to the gizmo's target through the same abilities as other clients: a camera, a light or a static
// body by a pose command; a moving body by a spring, or while paused together with what is jointed to it, and its
// rotation by its Cartesian controller. Main thread; answers arrive without waiting.
#pragma once

#include <memory>
#include <string>

#include "render/scene/motion.h"
#include "state/abilities/command.h"
#include "state/abilities/pick.h"

namespace ambf::render {

class GizmoHand {
 public:
  GizmoHand(state::CommandAbility& command, state::PickAbility& pick) : command_(command), pick_ability_(pick) {}

  // Whether a ring would do anything: commands to bodies act in steps, and there are none while paused.
  static bool can_turn(const state::Frame& frame, state::ObjectId object);
  // In the newest frame; false: gone, or not something with a pose of its own.
  static bool pose_of(const state::Frame& frame, state::ObjectId object, math::Pose& T_world_object);

  // `towards_viewer`: unit, where to try first to take hold of a body. Returns why not, or nothing.
  std::string begin(const state::Frame& frame, state::ObjectId object, bool turns, const math::Vec3& towards_viewer,
                    std::int64_t now_ns);
  void move(const state::Frame& frame, const math::Pose& T_world_target);
  void end(const state::Frame& frame, std::int64_t now_ns);
  // Once a picture. A message for the user, or nothing.
  std::string update(const state::Frame& frame, std::int64_t now_ns);

  bool holds() const { return way_ != Way::none; }  // from begin() until nothing is under way any more

 private:
  enum class Way : std::uint8_t { none, pose_command, body_command, pull };
  struct Answer;

  void try_pick();
  void post(const state::Frame& frame);
  void let_go();

  state::CommandAbility& command_;
  state::PickAbility& pick_ability_;
  Way way_ = Way::none;
  state::ObjectId object_;
  std::uint64_t epoch_ = 0;
  bool moved_ = false, ending_ = false;
  bool placed_ = false;  // is where it is put, rather than pulled or driven there
  std::int64_t ended_ns_ = 0;
  math::Pose T_world_start_, T_world_target_;
  std::unique_ptr<state::CommandPort> port_;
  // Taking hold: rays from all sides, until one meets the object first.
  std::unique_ptr<state::PickPort> pick_;
  std::shared_ptr<Answer> answer_;
  math::Vec3 middle_world_, towards_viewer_, grasped_world_;
  double radius_m_ = 0.0;
  int tried_ = 0;
  bool grasped_ = false;
};

}  // namespace ambf::render
