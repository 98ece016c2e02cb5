// The description of an actuator. Beside description.h, because few files read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/types.h"
#include "scene/block_kinds.h"
#include "state/actuators.h"

namespace ambf::scene {

struct Actuator {
  std::string parent;  // empty: the world, where it can hold nothing
  state::ActuatorType type = state::ActuatorType::constraint;
  math::Pose T_parent_actuator;  // in the frame of the parent's centre of mass, where the parent is a body
  bool visible = false;
  double visible_size_m = 0.02;
  std::optional<double> max_impulse;  // Ns along and Nms about each axis, a step; absent: no bound
  std::optional<double> tau;          // factor on the share of an error that a step takes back; absent: 1
  std::string sensor;                 // empty: none
  state::Trigger trigger = state::Trigger::command;
  std::string jaw;           // body whose descendants are the jaw
  double below = 0.5;        // of the jaw's opening, 0 closed .. 1 open
  double hardness = 1000.0;  // N/m, of what holds each node of a soft body
  double damping = 1.0;      // N s/m, likewise
  // Magnets: of the pull where the sensor touches. Needles: across it or of the thread: above it a puncture tears out.
  double strength_N = 0.0;
  std::vector<math::Vec3> edge;   // blades: a polyline, m, in the parent's body frame
  double sharpness = 0.0;         // blades: N for each m of edge in tissue
  std::vector<math::Vec3> arc;    // needles: from the tip to the rear, m, in the parent's body frame
  double puncture_force = 0.2;    // needles: N
  double needle_friction = 10.0;  // needles: N for each m of needle or thread in tissue
  std::string thread;             // needles: the soft body that they draw; empty: none
  double range_m = 0.0;           // magnets: where the pull ends; 0: at the end of the sensor's rays
};

namespace kind {
extern const BlockKind kActuator;
}

}  // namespace ambf::scene
