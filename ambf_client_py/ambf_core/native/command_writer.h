// Posts what the command arrays hold to the objects of a world, as a Step request does: all of it or nothing. Joints
// are commanded through the first body, in load order, that lists them. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fields.h"
#include "runtime/local_simulation.h"
#include "state/actuators.h"

namespace ambf::python {

class CommandWriter {
 public:
  // The newest structure of `world`; commands of surviving bodies stay in force.
  void follow(runtime::LocalSimulation& world);
  // Empty, or why nothing was posted. A joint or body whose mode has become none is let go: its motor is off, its
  // share ends.
  std::string post(const CommandArrays& arrays);
  // The same without posting.
  std::string check(const CommandArrays& arrays);
  // Ends all commands.
  void release();
  // Joints whose motors this commands, or has switched off: what post() does with mode none depends on it.
  std::vector<state::ObjectId> commanded() const;
  // A state comes back that was saved when commanded() was this: any command that was ever given may be in force.
  void restore(const std::vector<state::ObjectId>& commanded);

 private:
  struct Led {
    std::uint32_t joint;  // slot
    std::uint32_t entry;  // in RigidBodyCommand::joints
    state::ObjectId id;
    bool commanded = false;
  };
  struct Body {
    state::ObjectId id;
    std::vector<Led> joints;
    std::unique_ptr<state::CommandPort> port;  // bound when first commanded
    state::Command command = state::RigidBodyCommand{};
    bool in_force = false;
    bool wanted = false;
  };
  struct Actuator {
    state::ObjectId id;
    std::unique_ptr<state::CommandPort> port;  // bound when first commanded
    state::ActuatorCommand command;
    bool in_force = false;
    bool wanted = false;
  };
  void follow_actuators();
  std::string read(const CommandArrays& arrays, std::uint32_t slot, Body& body) const;
  std::string read(const CommandArrays& arrays, std::uint32_t slot, Actuator& actuator) const;

  runtime::LocalSimulation* world_ = nullptr;
  std::shared_ptr<const state::Structure> structure_;
  std::vector<Body> bodies_;         // by slot
  std::vector<char> led_;            // by joint slot
  std::vector<Actuator> actuators_;  // by slot
};

}  // namespace ambf::python
