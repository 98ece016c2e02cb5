// A joint between two bodies, with the ADF's frame rules (ADF joint block; dissertation §4.3.3). Made off the physics
// thread; between World::add() and World::remove() only the physics thread may call anything here. Never owns its
// bodies.
//
// Every joint is one set of constraint rows of ours, whatever its type: locked directions (error reduction `erp`,
// softness `cfm`), a drive row per free direction (velocity motor, implicit damping, implicit spring or PD) and
// one-sided limit rows. The coordinate q is the right-handed turn (rad), or the shift (m), of the child relative to
// the parent about the parent axis:
//   R_parent_child(q) = AxisAngle(ax_p, offset - joint_offset + q) rot(ax_c, ax_p)         (revolute kinds)
//   p_parent_child(q) = pvt_p + q ax_p - R pvt_c                                            (prismatic kinds)
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "math/types.h"
#include "physics/body.h"
#include "scene/description.h"

namespace ambf::physics {

namespace detail {
struct JointData;
}

// What a scene::Joint leaves to its surroundings.
struct JointOptions {
  double parent_scale = 1.0, child_scale = 1.0;  // of the bodies: multiply the pivots
  double erp = 0.8, cfm = 0.0;                   // where the joint names none
};

// How far a joint's locked directions are from where they should be.
struct JointGap {
  double position = 0.0;  // m, between the pivots (along the free axis of a prismatic kind: not counted)
  double angle = 0.0;     // rad, between the axes (revolute kinds) or of the whole rotation (fixed, prismatic kinds)
};

class Joint {
 public:
  // Names in the description are not looked at. Zero axes must have been refused before.
  Joint(const scene::Joint& description, Body& parent, Body& child, const JointOptions& options = {});
  ~Joint();  // leaves its world. Off the physics thread only once it has left
  Joint(const Joint&) = delete;
  Joint& operator=(const Joint&) = delete;

  state::JointType type() const;
  Body& parent() const;
  Body& child() const;
  bool has_coordinate() const;  // one free direction: revolute, prismatic, linear and torsion spring

  // Coordinate and its rate, from poses and twists at this moment (kinds with several free directions: turn about the
  // axis).
  double position() const;          // rad, counted on over full turns; m
  double wrapped_position() const;  // rad in [-pi, pi]; m
  double velocity() const;          // rad/s; m/s
  // Torque or force along the free direction in the last step: what was commanded plus motor, damping, spring and
  // limits.
  double effort() const;  // Nm; N
  // Everything this joint did to its bodies in the last step, at their COM, world axes.
  math::Wrench reaction_on_parent() const;
  math::Wrench reaction_on_child() const;
  JointGap gap() const;
  // Pose of the child that the description asks for at coordinate q (kinds with one coordinate; others: q is ignored).
  math::Pose child_pose_in_parent(double q) const;

  // The joint's own frame (z along the axis) in the parent's and in the child's body frame; scaled.
  math::Pose frame_in_parent() const;
  math::Pose frame_in_child() const;

  // Ties this coordinate to another joint's: q = multiplier q_leader + offset (rad or m), by a row that acts on both;
  // chains work. Before this joint is added to its world; both have a coordinate, and the leader follows neither this
  // joint nor a follower of it. In force while both are in the world and enabled, with SolverKind::direct only.
  // effort() is without the tie's share.
  void follow(Joint& leader, double multiplier, double offset);

  // One drive at a time; what was set stays until something else is set. All of them wake a sleeping joint when they
  // change what it does.
  void set_free();  // only damping and springs act
  void set_motor_velocity(double velocity,
                          double max_impulse);  // Ns or Nms a step; max_impulse of the description if < 0
  void set_motor_velocity(double velocity) { set_motor_velocity(velocity, -1.0); }
  void set_effort(double effort);  // + on the child, - on the parent, at the same point
  // Implicit PD: K (q_d - q) + D (v_d - v) + feedforward, evaluated at the end of the step, so stable for any gains.
  struct Servo {
    double position = 0.0, velocity = 0.0;  // q_d, v_d
    double stiffness = 0.0, damping = 0.0;  // K (Nm/rad or N/m), D
    double feedforward = 0.0;               // Nm or N
    double max_effort = 0.0;                // Nm or N; 0: no bound
  };
  void set_servo(const Servo& servo);
  double max_motor_impulse() const;

  void set_damping(double damping);  // viscous, implicit
  double damping() const;
  void set_limits(const std::optional<std::array<double, 2>>& limits);
  const std::optional<std::array<double, 2>>& limits() const;
  void set_softness(double erp, double cfm);
  double erp() const;
  double cfm() const;
  // Reflected inertia of the two bodies about (along) the free direction, each as if otherwise free: kg m^2 or kg. An
  // explicit damper D is stable only while D h < 2 * this.
  double effective_inertia() const;

  bool frozen() const;  // World::freeze_diverged() froze its bodies
  void set_enabled(bool enabled);
  bool enabled() const;

  // No drive, no turns counted. Poses are the bodies'.
  void reset();

  detail::JointData& data() const { return *data_; }

 private:
  std::unique_ptr<detail::JointData> data_;
};

}  // namespace ambf::physics
