// The drivers `ros_arm` (MTML, MTMR, any CRTK master) and `ros_generic` (any pose, twist or Joy). They never power,
// home or move an arm: they read it and send forces. No ROS header is needed to register them. C++17.
#pragma once

#include "base/log.h"

namespace ambf::ros_comm {
class Node;
}

namespace ambf::dvrk_arm {

// Before the first device is made; at most once. Their devices wait for a node. `log` outlives every driver.
void register_drivers(base::Log& log);

// The process's ROS node for these drivers while this lives; its end sends zero forces and closes their topics. One at
// a time; `node` outlives it.
class ArmConnection {
 public:
  explicit ArmConnection(ros_comm::Node& node);
  ~ArmConnection();
  ArmConnection(const ArmConnection&) = delete;
  ArmConnection& operator=(const ArmConnection&) = delete;
};

}  // namespace ambf::dvrk_arm
