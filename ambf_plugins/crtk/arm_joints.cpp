#include "crtk/arm_joints.h"

#include <algorithm>

#include "crtk/arm_kind.h"

namespace ambf::crtk {

namespace {

// Index into objects of the body with this name or identifier, or of the only one whose identifier has it as a part;
// kNone: there is none, or there are several.
std::uint32_t find_body(const state::Structure& structure, const std::string& name) {
  std::uint32_t part = state::kNone;
  std::size_t parts = 0;
  for (const state::BodyInfo& body : structure.bodies) {
    const state::ObjectInfo& object = structure.objects[body.object];
    if (object.name == name || object.identifier == name) return body.object;
    if (object.identifier.find(name) == std::string::npos) continue;
    part = body.object;
    ++parts;
  }
  return parts == 1 ? part : state::kNone;
}

}  // namespace

ArmJoints::Found ArmJoints::find(const adf::CrtkArm& arm, const state::Structure& structure, std::string& problem) {
  gripper_ = state::kNone;
  base_ = find_body(structure, arm.base);
  if (base_ == state::kNone) {
    problem = "the scene has no body '" + arm.base + "', or several that may be meant";
    return Found::no_base;
  }
  const std::uint32_t object = base_;
  const state::BodyInfo& body = structure.bodies[structure.objects[object].slot];
  const auto is_there = [&](const std::string& name) {
    const bool there = std::any_of(body.joints.begin(), body.joints.end(), [&](std::uint32_t slot) {
      return without_blanks(structure.joints[slot].name) == without_blanks(name);
    });
    if (there) return true;
    std::string known;
    for (const std::uint32_t slot : body.joints) known += (known.empty() ? "" : ", ") + structure.joints[slot].name;
    problem = "below '" + arm.base + "' is no joint '" + name + "' that takes commands; there are: " + known;
    return false;
  };
  for (const kinematics::AdfJoint& joint : arm.kinematics.adf_joints) {
    if (!is_there(joint.name)) return Found::no_joint;
  }
  for (const kinematics::JawHalf& half : arm.kinematics.adf_jaw) {
    if (!is_there(half.name)) return Found::no_joint;
  }
  if (!arm.gripper) return Found::all;
  // It has no motor, so that it may be passive: any joint of the base's model.
  const state::ModelId model = structure.objects[object].model;
  for (std::uint32_t slot = 0; slot < structure.joints.size(); ++slot) {
    const state::JointInfo& joint = structure.joints[slot];
    const bool ours = structure.objects[joint.object].model == model;
    if (ours && without_blanks(joint.name) == without_blanks(arm.gripper->joint)) gripper_ = slot;
  }
  if (gripper_ == state::kNone) {
    problem = "the model of '" + arm.base + "' has no joint '" + arm.gripper->joint + "' for the gripper";
    return Found::no_joint;
  }
  gripper_scale_ = arm.gripper->scale, gripper_offset_ = arm.gripper->offset;
  return Found::all;
}

std::optional<double> ArmJoints::gripper(const state::Frame& frame) const {
  if (gripper_ == state::kNone) return std::nullopt;
  return gripper_scale_ * frame.joints[gripper_].position + gripper_offset_;
}

}  // namespace ambf::crtk
