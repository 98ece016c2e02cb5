// A model file in a running simulation without ROS and windows: steps with commands go in, frames come out, and what
// the test judges (how far joints' pivots are apart) is computed here from the frame's body poses and the parsed file
// alone, never from the simulation's own figures. One thread.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "adf/adf.h"
#include "math/rotation.h"
#include "runtime/simulation.h"
#include "state/structure.h"
#include "tests/support/compat_models.h"
#include "tests/support/judged_log.h"
#include "tests/support/slowness.h"

namespace ambf::runtime::test {

inline std::string own_descriptions() { return std::string(AMBF_SOURCE_DIR) + "/ambf_models/descriptions/"; }
inline std::string own_model(const std::string& file) { return own_descriptions() + "multi-bodies/" + file; }

// A joint as its file describes it, with scales applied, and the frame's bodies that it joins.
struct JointPlaces {
  std::string name;
  state::JointType type = state::JointType::fixed;
  std::uint32_t parent = state::kNone, child = state::kNone;  // slots of bodies
  math::Vec3 parent_pivot, child_pivot, parent_axis, child_axis;
  bool active = true;  // not passive: somebody may command it
  bool has_axis() const {
    return type == state::JointType::revolute || type == state::JointType::torsion_spring || slides();
  }
  bool slides() const { return type == state::JointType::prismatic || type == state::JointType::linear_spring; }
  bool pivots_meet() const { return type != state::JointType::six_dof && type != state::JointType::six_dof_spring; }
};

// From the parent's pivot to the child's in the world, without what is free along the axis of a sliding joint.
inline math::Vec3 pivot_gap(const JointPlaces& joint, const math::Pose& T_world_parent,
                            const math::Pose& T_world_child) {
  math::Vec3 gap = T_world_child * joint.child_pivot - T_world_parent * joint.parent_pivot;
  if (joint.slides()) {
    const math::Vec3 axis = math::rotate(T_world_parent.orientation, joint.parent_axis);
    gap -= axis * math::dot(axis, gap);
  }
  return gap;
}

inline SimulationOptions steps_on_request(bool sleeping) {
  SimulationOptions options;
  options.fixed_step = true;
  options.physics_rate_hz = 1e6;
  options.speed_factor = 1e3;  // steps of 1 ms
  options.sleeping = sleeping;
  return options;
}

inline scene::World bare_world() {
  scene::World world;
  world.name_space = "/test/";
  world.gravity = {0, 0, -9.81};
  return world;
}

inline scene::World world_of(const std::string& file) {
  adf::WorldResult result = adf::load_world(file);
  EXPECT_TRUE(result.world.has_value()) << file;
  return result.world ? *result.world : bare_world();
}
inline scene::World own_world() { return world_of(own_descriptions() + "world/world.yaml"); }

class ModelRig {
 public:
  explicit ModelRig(const scene::World& world, const SimulationOptions& options = steps_on_request(false))
      : simulation(options, world, {}, log), reader(simulation.make_reader()) {
    if (options.fixed_step) simulation.set_paused(true);  // only the steps asked for
    simulation.begin();
  }

  // Loads a file; its joints' places are appended to `joints`.
  state::Outcome load(const std::string& path) {
    const auto before = simulation.structure();
    state::LoadRequest request;
    request.path = path;
    const state::Outcome outcome = simulation.load_and_wait(request);
    if (outcome.success) note_places(path, *before);
    return outcome;
  }
  state::Outcome load_text(const std::string& text) {
    state::LoadRequest request;
    request.text = text;
    request.path = "scene.yaml";
    return simulation.load_and_wait(request);
  }

  template <class Start>
  state::Outcome wait_for(Start start) {
    auto promise = std::make_shared<std::promise<state::Outcome>>();
    auto future = promise->get_future();
    start([promise](const state::Outcome& outcome) { promise->set_value(outcome); });
    if (future.wait_for(std::chrono::seconds(120 * kTestSlowness)) != std::future_status::ready)
      return {false, "no answer", {}, {}, 0, 0.0, 0, 0.0};
    return future.get();
  }
  state::Outcome step(unsigned n, std::vector<state::AddressedCommand> commands = {}) {
    const auto ticket = simulation.step(n, std::move(commands), false);
    if (ticket->wait(std::chrono::seconds(120 * kTestSlowness))) return ticket->outcome();
    return {false, "no answer", {}, {}, 0, 0.0, 0, 0.0};
  }
  state::Outcome run(double seconds) { return step(static_cast<unsigned>(seconds * 1e3 + 0.5)); }
  state::Outcome remove(const std::string& object) {
    return wait_for([&](state::Completion done) { simulation.remove(object, std::move(done)); });
  }

  const state::Frame& frame() { return *reader->latest(); }
  std::uint32_t slot(const std::string& body) {
    const auto structure = simulation.structure();
    const std::uint32_t index = state::find(*structure, body, state::ObjectKind::rigid_body);
    EXPECT_NE(index, state::kNone) << body;
    return index == state::kNone ? 0 : structure->objects[index].slot;
  }
  const state::BodyState& body(const std::string& name) {
    const std::uint32_t at = slot(name);
    return frame().bodies[at];
  }
  state::ObjectId id(const std::string& name) {
    const auto structure = simulation.structure();
    const std::uint32_t index = state::find(*structure, name, state::ObjectKind::rigid_body);
    EXPECT_NE(index, state::kNone) << name;
    return index == state::kNone ? state::ObjectId{} : structure->objects[index].id;
  }
  std::uint32_t joint_slot(const std::string& name) {
    const auto structure = simulation.structure();
    for (std::uint32_t i = 0; i < structure->joints.size(); ++i)
      if (structure->joints[i].name == name) return i;
    ADD_FAILURE() << "no joint " << name;
    return 0;
  }

  // One command that gives every named joint below `body` the same kind of order; other joints are left alone.
  state::AddressedCommand joint_command(const std::string& body, state::JointCommandType type,
                                        const std::vector<std::pair<std::string, double>>& values) {
    const auto structure = simulation.structure();
    const auto& listed = structure->bodies[slot(body)].joints;
    state::RigidBodyCommand command;
    command.joints.resize(listed.size());
    for (const auto& [name, value] : values) {
      bool found = false;
      for (std::size_t i = 0; i < listed.size(); ++i) {
        if (structure->joints[listed[i]].name != name) continue;
        command.joints[i] = {type, value};
        found = true;
      }
      EXPECT_TRUE(found) << name << " is not below " << body;
    }
    return {id(body), command};
  }

  // Largest pivot gap of the loaded models' joints in the newest frame, m, and the joint that has it.
  double largest_gap(std::string* whose = nullptr) {
    const state::Frame& now = frame();
    double largest = 0.0;
    for (const JointPlaces& joint : joints) {
      if (!joint.pivots_meet()) continue;
      const double gap =
          math::norm(pivot_gap(joint, now.bodies[joint.parent].T_world_body, now.bodies[joint.child].T_world_body));
      if (gap <= largest) continue;
      largest = gap;
      if (whose != nullptr) *whose = joint.name;
    }
    return largest;
  }

  JudgedLog log;
  Simulation simulation;
  std::unique_ptr<state::FrameReader> reader;
  std::vector<JointPlaces> joints;

 private:
  // A model's joints come in the order of its file, after those that were there.
  void note_places(const std::string& path, const state::Structure& before) {
    const adf::ModelResult parsed = adf::load_model(path);
    ASSERT_TRUE(parsed.model.has_value());
    const auto structure = simulation.structure();
    ASSERT_EQ(structure->joints.size() - before.joints.size(), parsed.model->joints.size());
    for (std::size_t i = 0; i < parsed.model->joints.size(); ++i) {
      const scene::Joint& described = parsed.model->joints[i];
      const state::JointInfo& live = structure->joints[before.joints.size() + i];
      ASSERT_EQ(live.name, described.identity.name);
      const auto scale_of = [&](std::uint32_t body) {
        // Bodies of other files would need theirs; those that tested models tie together have none.
        return body < before.bodies.size() ? 1.0 : parsed.model->bodies.at(body - before.bodies.size()).scale;
      };
      joints.push_back({described.identity.name, described.type, live.parent_body, live.child_body,
                        described.parent_pivot * scale_of(live.parent_body),
                        described.child_pivot * scale_of(live.child_body), described.parent_axis,
                        described.child_axis});
    }
  }
};

}  // namespace ambf::runtime::test
