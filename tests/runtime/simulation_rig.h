// A whole simulation without ROS and windows: ADF text goes in, frames come out, time is the real one.
#pragma once

#include <chrono>
#include <future>
#include <string>
#include <vector>

#include "runtime/simulation.h"
#include "state/structure.h"
#include "tests/support/judged_log.h"
#include "tests/support/slowness.h"

namespace ambf::runtime::test {

inline constexpr auto kPatience =
    std::chrono::seconds(20 * kTestSlowness);  // far beyond what anything takes, so that only a hang fails

// A floor, a box that falls on it, and a closed four-bar linkage driven by commands: contacts, loops, motors.
inline const std::string kScene = R"(
bodies: [BODY floor, BODY box, BODY base, BODY crank, BODY coupler, BODY rocker]
joints: [JOINT base-crank, JOINT crank-coupler, JOINT coupler-rocker, JOINT base-rocker]
namespace: /test/
BODY floor: {name: floor, mass: 0, collision shape: BOX, collision geometry: {x: 4, y: 4, z: 0.2}, shape: BOX,
  geometry: {x: 4, y: 4, z: 0.2},
  location: {position: {x: 0, y: 0, z: -0.1}, orientation: {r: 0, p: 0, y: 0}}}
BODY box: {name: box, mass: 1, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: BOX,
  geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 1, y: 1, z: 0.3}, orientation: {r: 0.3, p: 0.2, y: 0.1}}}
BODY base: {name: base, mass: 0, collision shape: BOX, collision geometry: {x: 0.02, y: 0.02, z: 0.02}, shape: BOX,
  geometry: {x: 0.02, y: 0.02, z: 0.02},
  location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}
BODY crank: {name: crank, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.02, y: 0.02, z: 0.2}, shape: BOX,
  geometry: {x: 0.02, y: 0.02, z: 0.2},
  location: {position: {x: 0, y: 0, z: 1.1}, orientation: {r: 0, p: 0, y: 0}}}
BODY coupler: {name: coupler, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.4, y: 0.02, z: 0.02},
  shape: BOX, geometry: {x: 0.4, y: 0.02, z: 0.02},
  location: {position: {x: 0.2, y: 0, z: 1.2}, orientation: {r: 0, p: 0, y: 0}}}
BODY rocker: {name: rocker, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.02, y: 0.02, z: 0.2},
  shape: BOX, geometry: {x: 0.02, y: 0.02, z: 0.2},
  location: {position: {x: 0.4, y: 0, z: 1.1}, orientation: {r: 0, p: 0, y: 0}}}
JOINT base-crank: {name: base-crank, parent: BODY base, child: BODY crank, type: revolute, max motor impulse: 0.05,
  parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: -0.1}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
JOINT crank-coupler: {name: crank-coupler, parent: BODY crank, child: BODY coupler, type: revolute,
  enable motor: false, passive: true,
  parent pivot: {x: 0, y: 0, z: 0.1}, child pivot: {x: -0.2, y: 0, z: 0}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
JOINT coupler-rocker: {name: coupler-rocker, parent: BODY coupler, child: BODY rocker, type: revolute,
  enable motor: false, passive: true,
  parent pivot: {x: 0.2, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0.1}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
JOINT base-rocker: {name: base-rocker, parent: BODY base, child: BODY rocker, type: revolute, enable motor: false,
  passive: true,
  parent pivot: {x: 0.4, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: -0.1}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
)";

inline scene::World empty_world() {
  scene::World world;
  world.name_space = "/test/";
  world.gravity = {0, 0, -9.81};
  return world;
}

// Fixed steps of 1 ms, as fast as they go, unless told otherwise.
inline SimulationOptions free_running() {
  SimulationOptions options;
  options.fixed_step = true;
  options.physics_rate_hz = 1e6;
  options.speed_factor = 1e3;
  return options;
}

class Rig {
 public:
  explicit Rig(const SimulationOptions& options = free_running(), const std::string& scene = kScene,
               const scene::World& world = empty_world())
      : simulation(options, world, {}, log), reader(simulation.make_reader()) {
    if (!scene.empty()) loaded = load(scene);
  }

  state::Outcome load(const std::string& text) {
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
    if (future.wait_for(kPatience) != std::future_status::ready) return {false, "no answer", {}, {}, 0, 0.0, 0, 0.0};
    return future.get();
  }

  // n steps by the Step service; the newest frame is then that of the last one.
  state::Outcome step(unsigned n, std::vector<state::AddressedCommand> commands = {}) {
    const auto ticket = simulation.step(n, std::move(commands), false);
    if (ticket->wait(kPatience)) return ticket->outcome();
    return {false, "no answer", {}, {}, 0, 0.0, 0, 0.0};
  }

  const state::Frame& frame() { return *reader->latest(); }

  state::ObjectId id(const std::string& name) {
    const auto structure = simulation.structure();
    const std::uint32_t index = state::find(*structure, name, state::ObjectKind::rigid_body);
    return index == state::kNone ? state::ObjectId{} : structure->objects[index].id;
  }
  const state::BodyState& body(const std::string& name) {
    const state::Frame& newest = frame();
    const std::uint32_t index = state::find(*newest.structure, name, state::ObjectKind::rigid_body);
    return newest.bodies[newest.structure->objects[index].slot];
  }

  // Waits until `good` holds for a published frame.
  template <class Condition>
  bool wait_until(Condition good) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end) {
      if (good(frame())) return true;
      reader->wait_newer(frame().sequence, std::chrono::milliseconds(20));
    }
    return false;
  }

  JudgedLog log;
  Simulation simulation;
  std::unique_ptr<state::FrameReader> reader;
  state::Outcome loaded;
};

// The crank's joint is the base's first (and only active) one.
inline state::AddressedCommand crank_command(Rig& rig, state::JointCommandType type, double value) {
  state::RigidBodyCommand command;
  command.joints = {{type, value}};
  return {rig.id("BODY base"), command};
}

inline state::AddressedCommand push(Rig& rig, const std::string& body, const math::Vec3& force) {
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::force;
  command.wrench_world.force = force;
  return {rig.id(body), command};
}

}  // namespace ambf::runtime::test
