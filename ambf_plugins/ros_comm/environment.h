// What the environment says about ROS (ROS_MASTER_URI and relatives), judged before roscpp reads it: roscpp aborts the
// process where a variable makes no sense. Call before ROS is started. No ROS header is needed to use it.
#pragma once

#include <string>

namespace ambf::ros_comm {

// Sets ROS_MASTER_URI where the user has not. Empty, or which variable has a value with which ROS cannot be started,
// and what it should be.
std::string problem_of_environment();

}  // namespace ambf::ros_comm
