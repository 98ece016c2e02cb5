// A live world without files, threads or ROS: descriptions go in as structs, frames come out.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/cache.h"
#include "model/catalogue.h"
#include "model/command_table.h"
#include "model/live_world.h"
#include "physics/world.h"
#include "scene/description.h"
#include "state/structure.h"

namespace ambf::model::test {

inline constexpr double kStep_s = 0.001;

inline scene::Body box(const std::string& name, double mass, const math::Vec3& position, double side = 0.1) {
  scene::Body body;
  body.identity.identifier = "BODY " + name;
  body.identity.name = name;
  body.identity.name_space = "/test/";
  body.mass = mass;
  body.collision.shapes.push_back({{scene::Shape::box, {side, side, side}}, {}});
  body.visual.shapes = body.collision.shapes;
  body.T_world_body.position = position;
  return body;
}

inline scene::Joint joint(const std::string& name, const std::string& parent, const std::string& child,
                          state::JointType type = state::JointType::revolute) {
  scene::Joint joint;
  joint.identity.identifier = "JOINT " + name;
  joint.identity.name = name;
  joint.identity.name_space = "/test/";
  joint.parent = "BODY " + parent;
  joint.child = "BODY " + child;
  joint.type = type;
  return joint;
}

inline scene::Model model(const std::string& name, std::vector<scene::Body> bodies,
                          std::vector<scene::Joint> joints = {}) {
  scene::Model model;
  model.file = model.name = name;
  model.bodies = std::move(bodies);
  model.joints = std::move(joints);
  return model;
}

// Links of 0.2 m along x, hinged about `axis` (in body frames) at their ends; the first one is static. Bodies link0..,
// joints j1..
inline scene::Model chain(int links, const math::Vec3& axis = {0, 1, 0}, const std::string& name = "chain.yaml") {
  scene::Model out = model(name, {});
  for (int i = 0; i < links; ++i) {
    scene::Body link = box("link" + std::to_string(i), i == 0 ? 0.0 : 1.0, {0.2 * i, 0, 0});
    out.bodies.push_back(link);
    if (i == 0) continue;
    scene::Joint j = joint("j" + std::to_string(i), "link" + std::to_string(i - 1), "link" + std::to_string(i));
    j.parent_pivot = {0.1, 0, 0};
    j.child_pivot = {-0.1, 0, 0};
    j.parent_axis = j.child_axis = axis;
    out.joints.push_back(j);
  }
  return out;
}

class Rig {
 public:
  explicit Rig(const math::Vec3& gravity = {0, 0, 0}, double step_s = kStep_s, bool sleeping = true)
      : catalogue(options(step_s), commands, meshes), h_s(step_s) {
    physics::WorldOptions world;
    world.gravity = gravity;
    world.step = h_s;
    world.sleeping = sleeping;
    live = std::make_unique<LiveWorld>(std::make_unique<physics::World>(world), commands);
  }

  // Both sides of a change: what the loader prepares, and the physics thread applies.
  Prepared apply(Prepared prepared) {
    if (!prepared.success) return prepared;
    frame = std::move(prepared.frames.front());
    const Garbage garbage = live->apply(std::move(prepared));
    live->fill(*frame);
    return prepared;
  }
  Prepared load(const scene::Model& model, const LoadOptions& load_options = {}) {
    return apply(catalogue.prepare_load(model, load_options));
  }

  void step(int count = 1) {
    for (int i = 0; i < count; ++i) {
      live->take_commands(watchdog_s);
      live->step(h_s);
      watchdog_s += h_s;
    }
    live->take_commands(watchdog_s);
    live->fill(*frame);
  }
  // As step, with `each` called before every step.
  template <class Each>
  void step(int count, Each&& each) {
    for (int i = 0; i < count; ++i) {
      each(i);
      step();
    }
  }

  // Index of the object called exactly /test/`name`.
  std::uint32_t object(const std::string& name, state::ObjectKind kind = state::ObjectKind::rigid_body) const {
    const auto& objects = live->structure()->objects;
    for (std::uint32_t i = 0; i < objects.size(); ++i)
      if (objects[i].kind == kind && objects[i].name == "/test/" + name) return i;
    return state::kNone;
  }
  state::ObjectId id(const std::string& name, state::ObjectKind kind = state::ObjectKind::rigid_body) const {
    return live->structure()->objects.at(object(name, kind)).id;
  }
  std::uint32_t slot(const std::string& name, state::ObjectKind kind = state::ObjectKind::rigid_body) const {
    return live->structure()->objects.at(object(name, kind)).slot;
  }
  const state::BodyState& body(const std::string& name) const { return frame->bodies.at(slot(name)); }
  const state::BodyInfo& info(const std::string& name) const { return live->structure()->bodies.at(slot(name)); }
  std::vector<std::string> children_names(const std::string& name) const {
    std::vector<std::string> names;
    for (const std::uint32_t child : info(name).children) names.push_back(live->structure()->objects[child].name);
    return names;
  }
  const state::JointState& joint_state(const std::string& name) const {
    return frame->joints.at(slot(name, state::ObjectKind::joint));
  }
  std::unique_ptr<state::CommandPort> port(const std::string& name, state::Source source = state::Source::ros,
                                           state::ObjectKind kind = state::ObjectKind::rigid_body) {
    return commands.bind(id(name, kind), source);
  }

  CommandTable commands;
  mesh::MeshCache meshes;
  Catalogue catalogue;
  double h_s;
  std::unique_ptr<LiveWorld> live;
  std::unique_ptr<state::Frame> frame;
  double watchdog_s = 0.0;

 private:
  static CatalogueOptions options(double step_s) {
    CatalogueOptions options;
    options.step_s = step_s;
    options.world_namespace = "/test/";
    return options;
  }
};

// Commands in one line.
inline state::Command force(const math::Vec3& force_world, const math::Vec3& torque_world = {}) {
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::force;
  command.wrench_world = {force_world, torque_world};
  return command;
}
inline state::Command pose(const math::Pose& T_world_body) {
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::position;
  command.T_world_body = T_world_body;
  return command;
}
inline state::Command twist(const math::Twist& twist_world) {
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::velocity;
  command.twist_world = twist_world;
  return command;
}
inline state::Command joints(std::vector<state::JointCommand> entries) {
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::force;
  command.joints = std::move(entries);
  return command;
}
inline state::JointCommand to_position(double value) { return {state::JointCommandType::position, value}; }
inline state::JointCommand to_velocity(double value) { return {state::JointCommandType::velocity, value}; }
inline state::JointCommand to_effort(double value) { return {state::JointCommandType::effort, value}; }
inline constexpr state::JointCommand kLeaveAlone{};

}  // namespace ambf::model::test
