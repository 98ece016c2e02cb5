#include "command_writer.h"

#include <algorithm>

namespace ambf::python {
namespace {

math::Vec3 vec3(const double* from) { return {from[0], from[1], from[2]}; }

bool read_body(const CommandArrays& arrays, std::uint32_t slot, state::RigidBodyCommand& command) {
  switch (static_cast<BodyMode>(arrays.body_mode[slot])) {
    case BodyMode::none: command.type = state::CartesianCommandType::none; return true;
    case BodyMode::wrench: {
      command.type = state::CartesianCommandType::force;
      const double* wrench = arrays.body_wrench + 6 * slot;
      command.wrench_world = {vec3(wrench), vec3(wrench + 3)};
      return true;
    }
    case BodyMode::pose: {
      command.type = state::CartesianCommandType::position;
      const double* pose = arrays.body_pose + 7 * slot;
      command.T_world_body = {vec3(pose), {pose[3], pose[4], pose[5], pose[6]}};
      return true;
    }
    case BodyMode::twist: {
      command.type = state::CartesianCommandType::velocity;
      const double* twist = arrays.body_twist + 6 * slot;
      command.twist_world = {vec3(twist), vec3(twist + 3)};
      return true;
    }
  }
  return false;
}

}  // namespace

void CommandWriter::follow(runtime::LocalSimulation& world) {
  world_ = &world;
  structure_ = world.structure();
  std::vector<Body> before = std::move(bodies_);
  bodies_ = std::vector<Body>(structure_->bodies.size());
  led_.assign(structure_->joints.size(), 0);
  for (std::uint32_t slot = 0; slot < bodies_.size(); ++slot) {
    const state::BodyInfo& info = structure_->bodies[slot];
    Body& body = bodies_[slot];
    body.id = structure_->objects[info.object].id;
    for (std::uint32_t entry = 0; entry < info.joints.size(); ++entry) {
      const std::uint32_t joint = info.joints[entry];
      if (led_[joint] == 0) {
        body.joints.push_back({joint, entry, structure_->objects[structure_->joints[joint].object].id});
      }
      led_[joint] = 1;
    }
    const auto same = std::find_if(before.begin(), before.end(), [&](const Body& b) { return b.id == body.id; });
    if (same == before.end()) continue;
    body.port = std::move(same->port);
    body.in_force = same->in_force;
    for (Led& led : body.joints) {
      led.commanded = std::any_of(same->joints.begin(), same->joints.end(),
                                  [&](const Led& other) { return other.id == led.id && other.commanded; });
    }
  }
  follow_actuators();
}

void CommandWriter::follow_actuators() {
  const std::vector<state::ActuatorInfo>& infos = state::actuators(*structure_);
  std::vector<Actuator> before = std::move(actuators_);
  actuators_ = std::vector<Actuator>(infos.size());
  for (std::uint32_t slot = 0; slot < actuators_.size(); ++slot) {
    Actuator& actuator = actuators_[slot];
    actuator.id = structure_->objects[infos[slot].object].id;
    const auto same =
        std::find_if(before.begin(), before.end(), [&](const Actuator& a) { return a.id == actuator.id; });
    if (same == before.end()) continue;
    actuator.port = std::move(same->port);
    actuator.in_force = same->in_force;
  }
}

std::string CommandWriter::read(const CommandArrays& arrays, std::uint32_t slot, Body& body) const {
  auto& command = std::get<state::RigidBodyCommand>(body.command);
  if (!read_body(arrays, slot, command)) {
    return "body_mode[" + std::to_string(slot) + "] is " + std::to_string(arrays.body_mode[slot]) + ", not 0 to 3";
  }
  body.wanted = command.type != state::CartesianCommandType::none;
  command.joints.assign(body.joints.empty() ? 0 : body.joints.back().entry + 1, {});
  for (const Led& led : body.joints) {
    const signed char mode = arrays.joint_mode[led.joint];
    state::JointCommand& entry = command.joints[led.entry];
    switch (static_cast<JointMode>(mode)) {
      case JointMode::none:
        if (led.commanded) entry.type = state::JointCommandType::effort;  // 0: the motor is off
        continue;
      case JointMode::effort: entry.type = state::JointCommandType::effort; break;
      case JointMode::position: entry.type = state::JointCommandType::position; break;
      case JointMode::velocity: entry.type = state::JointCommandType::velocity; break;
      default: return "joint_mode[" + std::to_string(led.joint) + "] is " + std::to_string(mode) + ", not -1 to 2";
    }
    entry.value = arrays.joint_value[led.joint];
    body.wanted = true;
  }
  const std::string problem = body.wanted ? state::check(command) : std::string();
  if (problem.empty()) return problem;
  return "command to '" + structure_->objects[structure_->bodies[slot].object].name + "': " + problem;
}

std::string CommandWriter::read(const CommandArrays& arrays, std::uint32_t slot, Actuator& actuator) const {
  const auto mode = static_cast<ActuatorMode>(arrays.actuator_mode[slot]);
  const std::int32_t body = arrays.actuator_body[slot];
  actuator.wanted = mode != ActuatorMode::none;
  actuator.command = {};
  switch (mode) {
    case ActuatorMode::none:
    case ActuatorMode::release: return {};
    case ActuatorMode::body:
      if (body < 0 || static_cast<std::size_t>(body) >= bodies_.size()) {
        return "actuator_body[" + std::to_string(slot) + "] is " + std::to_string(body) + ", not a row of bodies";
      }
      actuator.command.body = bodies_[body].id;
      break;
    case ActuatorMode::sensed: actuator.command.use_sensor = true; break;
    default:
      return "actuator_mode[" + std::to_string(slot) + "] is " + std::to_string(arrays.actuator_mode[slot]) +
             ", not -1 to 2";
  }
  actuator.command.actuate = true;
  const std::uint32_t object = state::actuators(*structure_)[slot].object;
  const std::string problem = state::check(actuator.command, *structure_, object);
  return problem.empty() ? problem : "command to '" + structure_->objects[object].name + "': " + problem;
}

std::string CommandWriter::check(const CommandArrays& arrays) {
  for (std::uint32_t joint = 0; joint < led_.size(); ++joint) {
    if (led_[joint] == 0 && arrays.joint_mode[joint] != static_cast<signed char>(JointMode::none)) {
      return "joint_mode[" + std::to_string(joint) + "]: '" + structure_->joints[joint].name +
             "' is passive and takes no commands";
    }
  }
  for (std::uint32_t slot = 0; slot < bodies_.size(); ++slot) {
    std::string problem = read(arrays, slot, bodies_[slot]);
    if (!problem.empty()) return problem;
  }
  for (std::uint32_t slot = 0; slot < actuators_.size(); ++slot) {
    std::string problem = read(arrays, slot, actuators_[slot]);
    if (!problem.empty()) return problem;
  }
  return {};
}

std::string CommandWriter::post(const CommandArrays& arrays) {
  std::string problem = check(arrays);
  if (!problem.empty()) return problem;
  const auto put_in_force = [this](auto& object, const state::Command& command) {
    if (object.wanted) {
      if (object.port == nullptr) object.port = world_->bind(object.id, state::Source::step_service);
      if (!object.in_force) object.port->hold();
      object.port->post(command);
    } else if (object.in_force) {
      object.port->release();
    }
    object.in_force = object.wanted;
  };
  for (Actuator& actuator : actuators_) {
    if (actuator.wanted || actuator.in_force) put_in_force(actuator, state::KindCommand{actuator.command});
  }
  for (Body& body : bodies_) {
    put_in_force(body, body.command);
    for (Led& led : body.joints) {
      const bool on = arrays.joint_mode[led.joint] != static_cast<signed char>(JointMode::none);
      led.commanded = body.wanted && (led.commanded || on);
    }
  }
  return {};
}

void CommandWriter::release() {
  for (Body& body : bodies_) {
    if (body.in_force) body.port->release();
    body.in_force = false;
    for (Led& led : body.joints) led.commanded = false;
  }
  for (Actuator& actuator : actuators_) {
    if (actuator.in_force) actuator.port->release();
    actuator.in_force = false;
  }
}

std::vector<state::ObjectId> CommandWriter::commanded() const {
  std::vector<state::ObjectId> joints;
  for (const Body& body : bodies_) {
    for (const Led& led : body.joints) {
      if (led.commanded) joints.push_back(led.id);
    }
  }
  return joints;
}

void CommandWriter::restore(const std::vector<state::ObjectId>& commanded) {
  for (Actuator& actuator : actuators_) actuator.in_force |= actuator.port != nullptr;
  for (Body& body : bodies_) {
    body.in_force |= body.port != nullptr;
    for (Led& led : body.joints) {
      led.commanded = std::find(commanded.begin(), commanded.end(), led.id) != commanded.end();
    }
  }
}

}  // namespace ambf::python
