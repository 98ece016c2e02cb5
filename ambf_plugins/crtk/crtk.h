// The interface of the Collaborative Robotics Toolkit over simulated arms (docs/crtk.md): topics and services of each
// arm, and its state. Its set-points move in the simulation (crtk/arm_kind.h); the physics thread never waits for
// anything here. No ROS header is needed to use it. C++17.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adf/crtk_arms.h"
#include "base/log.h"
#include "state/abilities/abilities.h"

namespace ambf::ros_comm {
class Node;
}

namespace ambf::crtk {

class Interface {
 public:
  // Starts at once; an arm gets its topics when its joints are in the scene and ROS is there. All references must
  // outlive it. name_space: before the arms' names, "" or "/..."; priority: SCHED_FIFO of the thread that moves the
  // arms, where permitted; 0: ordinary scheduling. simulated_time: stamps are in simulated time, which is published on
  // /clock, and the parameter /use_sim_time is set meanwhile.
  Interface(const std::vector<adf::CrtkArm>& arms, const std::string& name_space, const state::Abilities& simulation,
            ros_comm::Node& node, base::Log& log, int priority, bool simulated_time);
  ~Interface();  // closes all topics; the arms let go
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::crtk
