#include "crtk/model_joints.h"

#include <cmath>

#include "scene/chain.h"

namespace ambf::crtk {

std::vector<kinematics::MechanismJoint> mechanism_joints(const state::Frame& frame) {
  const state::Structure& structure = *frame.structure;
  std::vector<kinematics::MechanismJoint> made;
  for (std::size_t slot = 0; slot < structure.joints.size(); ++slot) {
    const state::JointInfo& joint = structure.joints[slot];
    const auto kind = scene::mechanism_kind(joint.type);
    if (!kind || joint.parent_body == state::kNone || joint.child_body == state::kNone) continue;
    const math::Pose T_parent_child =
        math::inverse(frame.bodies[joint.parent_body].T_world_body) * frame.bodies[joint.child_body].T_world_body;
    const double position = frame.joints[slot].position;
    if (!math::is_finite(T_parent_child) || !std::isfinite(position)) return {};
    made.push_back({joint.name, *kind, joint.parent_body, joint.child_body, joint.pivot_parent, joint.axis_parent,
                    T_parent_child, position});
  }
  return made;
}

}  // namespace ambf::crtk
