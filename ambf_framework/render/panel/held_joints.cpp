#include "render/panel/detail/held_joints.h"

#include <algorithm>

namespace ambf::render {

std::uint64_t HeldJoints::key_of(const state::Structure& structure, std::uint32_t joint) {
  return key_of(structure.objects[structure.joints[joint].object].id);
}

std::string HeldJoints::refusal(const state::Structure& structure, std::uint32_t joint) {
  const state::JointInfo& info = structure.joints[joint];
  if (info.passive) return "passive: nobody commands it";
  switch (info.type) {
    case state::JointType::revolute:
    case state::JointType::prismatic:
    case state::JointType::linear_spring:
    case state::JointType::torsion_spring: break;
    default: return "it has no single coordinate";
  }
  const auto& joints = structure.bodies[info.parent_body].joints;
  if (std::find(joints.begin(), joints.end(), joint) == joints.end()) return "no body commands it";
  return {};
}

std::string HeldJoints::hold(const state::Structure& structure, std::uint32_t joint,
                             const state::JointCommand& command) {
  if (std::string why = refusal(structure, joint); !why.empty()) return why;
  const std::uint32_t parent = structure.joints[joint].parent_body;
  const state::ObjectId body = structure.objects[structure.bodies[parent].object].id;
  state::RigidBodyCommand checked;
  checked.joints = {command};
  if (std::string why = state::check(checked); !why.empty()) {
    command_.count_refused_command(body);
    return why;
  }
  Body& held = bodies_[key_of(body)];
  if (held.port == nullptr) held.port = command_.bind(body, state::Source::panel);
  if (held.port == nullptr) {
    bodies_.erase(key_of(body));
    return "its body is gone";
  }
  structure_version_ = structure.version;
  held.joints[key_of(structure, joint)] = command;
  post(structure, parent, held, kNobody);
  return {};
}

// A joint that is let go while others below the same body are held gets the command that the watchdog would give:
// no effort.
void HeldJoints::post(const state::Structure& structure, std::uint32_t body, Body& held, std::uint64_t let_go) const {
  state::RigidBodyCommand command;
  const auto& joints = structure.bodies[body].joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::uint64_t key = key_of(structure, joints[i]);
    const auto entry = held.joints.find(key);
    if (entry == held.joints.end() && key != let_go) continue;
    command.joints.resize(i + 1);
    command.joints[i] =
        entry == held.joints.end() ? state::JointCommand{state::JointCommandType::effort, 0.0} : entry->second;
  }
  held.port->hold();
  held.port->post(command);
  held.posted_ns = now_ns_;
}

std::uint32_t HeldJoints::joint_of(const state::Structure& structure, std::uint64_t key) {
  for (std::uint32_t i = 0; i < structure.joints.size(); ++i)
    if (key_of(structure, i) == key) return i;
  return state::kNone;
}

void HeldJoints::release(const state::Structure& structure, std::uint32_t joint) {
  const std::uint32_t parent = structure.joints[joint].parent_body;
  const auto body = bodies_.find(key_of(structure.objects[structure.bodies[parent].object].id));
  const std::uint64_t key = key_of(structure, joint);
  if (body == bodies_.end() || body->second.joints.erase(key) == 0) return;
  if (body->second.joints.empty()) {
    body->second.port->release();
    bodies_.erase(body);
  } else {
    post(structure, parent, body->second, key);
  }
}

void HeldJoints::release_all() {
  for (auto& [key, body] : bodies_) body.port->release();
  bodies_.clear();
}

std::optional<state::JointCommand> HeldJoints::held(const state::Structure& structure, std::uint32_t joint) const {
  const state::BodyInfo& parent = structure.bodies[structure.joints[joint].parent_body];
  const auto body = bodies_.find(key_of(structure.objects[parent.object].id));
  if (body == bodies_.end()) return std::nullopt;
  const auto entry = body->second.joints.find(key_of(structure, joint));
  return entry == body->second.joints.end() ? std::nullopt : std::optional(entry->second);
}

// Of what stays, places in the message may have changed.
void HeldJoints::drop_what_is_gone(const state::Structure& structure) {
  std::map<std::uint64_t, std::uint32_t> slots;  // of joints that are there
  for (std::uint32_t i = 0; i < structure.joints.size(); ++i) slots[key_of(structure, i)] = i;
  for (auto body = bodies_.begin(); body != bodies_.end();) {
    auto& joints = body->second.joints;
    std::erase_if(joints, [&](const auto& joint) { return slots.count(joint.first) == 0; });
    if (joints.empty()) {
      body->second.port->release();
      body = bodies_.erase(body);
      continue;
    }
    post(structure, structure.joints[slots[joints.begin()->first]].parent_body, body->second, kNobody);
    ++body;
  }
}

std::string HeldJoints::follow(const state::Frame& frame, std::int64_t now_ns) {
  constexpr std::int64_t kPatience_ns = 200'000'000;
  const state::Structure& structure = *frame.structure;
  const bool jumped = frame.epoch != epoch_;
  const bool back = jumped && frame.sim_step < sim_step_;
  epoch_ = frame.epoch;
  sim_step_ = frame.sim_step;
  now_ns_ = now_ns;
  if (bodies_.empty()) return {};
  // A reset or restore ended all commands. What the user held then is not what is there now.
  if (back) {
    const std::string count = joint_count();
    release_all();
    return count + " no longer held here: the world was reset or restored";
  }
  if (jumped || structure.version != structure_version_) {
    structure_version_ = structure.version;
    drop_what_is_gone(structure);
  }
  // Whatever else ended a command, a picture shows it.
  for (auto& [key, held] : bodies_) {
    const std::uint32_t joint = joint_of(structure, held.joints.begin()->first);
    const std::uint32_t body = structure.joints[joint].parent_body;
    if (!frame.bodies[body].active && now_ns - held.posted_ns > kPatience_ns) post(structure, body, held, kNobody);
  }
  return {};
}

std::string HeldJoints::joint_count() const {
  std::size_t count = 0;
  for (const auto& [key, body] : bodies_) count += body.joints.size();
  return count == 1 ? "1 joint is" : std::to_string(count) + " joints are";
}

}  // namespace ambf::render
