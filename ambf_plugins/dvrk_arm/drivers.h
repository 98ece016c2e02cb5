// The drivers `ros_arm` (MTML, MTMR, any CRTK master) and `ros_generic` (any pose, twist or Joy). They never power,
// home or move an arm: they read it and send forces. No ROS header is needed to register them. C++17.
#pragma once

#include "base/log.h"

namespace ambf::ros_comm {
class Node;
}

namespace ambf::dvrk_arm {

// Before the first device is opened. `node` and `log` outlive every driver.
void register_drivers(ros_comm::Node& node, base::Log& log);

}  // namespace ambf::dvrk_arm
