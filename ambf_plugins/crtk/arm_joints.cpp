#include "crtk/arm_joints.h"

#include <algorithm>

namespace ambf::crtk {

namespace {

// Names of joints lose their blanks where they are published.
std::string without_blanks(std::string name) {
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name;
}

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
  joints_.clear(), halves_.clear();
  gripper_ = state::kNone;
  const std::uint32_t object = find_body(structure, arm.base);
  if (object == state::kNone) {
    problem = "the scene has no body '" + arm.base + "', or several that may be meant";
    return Found::no_base;
  }
  base_ = structure.objects[object].id;
  const state::BodyInfo& body = structure.bodies[structure.objects[object].slot];
  std::string known;
  const auto bound = [&](const std::string& name, double sign, double offset, std::vector<Joint>& list) {
    std::size_t index = 0;
    for (const std::uint32_t slot : body.joints) {
      if (without_blanks(structure.joints[slot].name) == without_blanks(name)) {
        list.push_back({slot, index, sign, offset});
        return true;
      }
      ++index;
    }
    if (known.empty()) {
      for (const std::uint32_t slot : body.joints) known += (known.empty() ? "" : ", ") + structure.joints[slot].name;
    }
    problem = "below '" + arm.base + "' is no joint '" + name + "' that takes commands; there are: " + known;
    return false;
  };
  for (const kinematics::AdfJoint& joint : arm.kinematics.adf_joints) {
    if (!bound(joint.name, joint.sign, joint.offset, joints_)) return Found::no_joint;
  }
  for (const kinematics::JawHalf& half : arm.kinematics.adf_jaw) {
    if (!bound(half.name, half.wrist, 0.0, halves_)) return Found::no_joint;
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

bool ArmJoints::same_as(const ArmJoints& other) const { return base_ == other.base_; }

Measured ArmJoints::read(const state::Frame& frame) const {
  Measured made;
  made.valid = true;
  made.sim_time = frame.sim_time;
  made.step_s = frame.run.step_s;
  made.epoch = frame.epoch;
  made.stamp_ns = frame.system_ns;
  for (const Joint& joint : joints_) {
    made.position.push_back(joint.sign * frame.joints[joint.slot].position + joint.offset);
    made.velocity.push_back(joint.sign * frame.joints[joint.slot].velocity);
  }
  double yaw = 0.0, yaw_rate = 0.0, opening = 0.0, rate = 0.0;
  for (const Joint& half : halves_) {
    const state::JointState& state = frame.joints[half.slot];
    const double share = half.sign / static_cast<double>(halves_.size());
    yaw += share * state.position, yaw_rate += share * state.velocity;
    opening += state.position, rate += state.velocity;
  }
  if (!halves_.empty()) made.position.push_back(yaw), made.velocity.push_back(yaw_rate);
  made.position.push_back(opening);
  made.velocity.push_back(rate);
  return made;
}

std::optional<double> ArmJoints::gripper(const state::Frame& frame) const {
  if (gripper_ == state::kNone) return std::nullopt;
  return gripper_scale_ * frame.joints[gripper_].position + gripper_offset_;
}

void ArmJoints::fill(const std::vector<Target>& targets, const Measured& measured,
                     state::RigidBodyCommand& command) const {
  using state::JointCommandType;
  command.type = state::CartesianCommandType::none;
  std::fill(command.joints.begin(), command.joints.end(), state::JointCommand{});
  const auto set = [&](const Joint& joint, JointCommandType type, double value) {
    if (command.joints.size() <= joint.index) command.joints.resize(joint.index + 1);
    command.joints[joint.index] = {type, value};
  };
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Target& target = targets[i];
    const bool effort = target.type == JointCommandType::effort;
    set(joints_[i], target.type, joints_[i].sign * (effort ? target.value : target.value - joints_[i].offset));
  }
  if (halves_.empty()) return;
  const Target &wrist = targets[joints_.size()], &jaw = targets[joints_.size() + 1];
  const bool free_wrist = wrist.type == JointCommandType::effort, squeezes = jaw.type == JointCommandType::effort;
  // Both halves carry the wrist: it follows efforts only while the jaw does, too. A jaw that squeezes has one half that
  // holds the wrist where it shall be, and one that presses on it.
  const double yaw = free_wrist ? measured.position[joints_.size()] : wrist.value;
  const double opening = squeezes ? measured.position.back() : jaw.value;
  for (std::size_t i = 0; i < halves_.size(); ++i) {
    const double sign = halves_[i].sign;
    if (free_wrist && squeezes) {
      set(halves_[i], JointCommandType::effort, 0.5 * sign * wrist.value + jaw.value);
    } else if (squeezes && i > 0) {
      set(halves_[i], JointCommandType::effort, jaw.value);
    } else {
      set(halves_[i], JointCommandType::position, sign * yaw + 0.5 * opening);
    }
  }
}

}  // namespace ambf::crtk
