// A kind of objects that is added to the simulation for this interface: the set-points of one arm, which move in every
// step (arm_motion.h) and command joints of the scene. It is loaded as a model of one block, so that recordings of
// inputs, saved states and frames have it without knowing it (docs/decisions/0051-arms-in-the-step.md). C++17.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "crtk/arm_motion.h"
#include "state/kind_rows.h"

namespace ambf::scene {
struct BlockKind;
}

namespace ambf::crtk {

// Position of the axis = (position of the joint) / ratio + offset; of two joints that carry one axis, half a jaw each:
// position of each = ratio x axis + opening / 2.
struct MovedJoint {
  std::uint32_t slot = state::kNone;  // in Structure::joints; kNone: it is not in the scene
  std::size_t axis = 0;
  double ratio = 1.0, offset = 0.0;
  bool half_of_jaw = false;
};

struct ArmInfo : state::PlacedInfo {
  std::string arm;  // its name
  ArmLimits limits;
  std::vector<MovedJoint> joints;

  bool whole() const;  // all its joints are there
};

struct ArmState : state::PlacedState {
  ArmMotion motion;
};

template <class Visit>
void visit_computed(ArmState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object);
  for (double& value : row.motion.position) visit(value);
  for (double& value : row.motion.velocity) visit(value);
  for (double& value : row.motion.goal) visit(value);
}

// The ADF block that describes one: numbers and names in lists of texts.
struct ArmBlock {
  std::string parent, arm;
  std::vector<std::string> axes;    // "lower upper max_velocity max_acceleration turns|slides|jaw"
  std::vector<std::string> joints;  // "axis ratio offset joint|half name"
};
// False: a text is not of that form.
bool read_block(const ArmBlock& block, ArmInfo& info, std::vector<std::string>& names);

const state::PlacedKind<ArmState>& arm_kind();
const scene::BlockKind& arm_blocks();

// Before the first world is made, and before the first file is read; again does nothing.
void register_arms();

// Positions and velocities of the axes, of positions and velocities of the joints by slot.
template <class Joints>
void measure(const ArmInfo& info, const Joints& joints, Axes& position, Axes& velocity, Axes& effort) {
  position.fill(0.0), velocity.fill(0.0), effort.fill(0.0);
  for (const MovedJoint& joint : info.joints) {
    if (joint.slot == state::kNone) continue;
    const auto& now = joints[joint.slot];
    if (!joint.half_of_jaw) {
      position[joint.axis] = now.position / joint.ratio + joint.offset;
      velocity[joint.axis] = now.velocity / joint.ratio;
      effort[joint.axis] = now.effort * joint.ratio;
      continue;
    }
    const std::size_t jaw = info.limits.joints;
    position[joint.axis] += 0.5 * joint.ratio * now.position;
    velocity[joint.axis] += 0.5 * joint.ratio * now.velocity;
    effort[joint.axis] += joint.ratio * now.effort;
    position[jaw] += now.position, velocity[jaw] += now.velocity, effort[jaw] += 0.5 * now.effort;
  }
}

// The name of a model's joint without blanks, as topics have it.
std::string without_blanks(std::string name);

}  // namespace ambf::crtk
