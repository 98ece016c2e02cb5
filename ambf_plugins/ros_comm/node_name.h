// Names of our ROS nodes: unique, and saying which process they belong to, so that a name left behind at the master by
// a killed simulator can be distinguished from a living one. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ambf::ros_comm {

// "ambf_comm_node_<process>_<milliseconds since 1970>"
std::string node_name(int process, std::int64_t milliseconds);
// The process in such a name, with or without leading '/'; 0 when it is none of ours.
int process_in(const std::string& node);

}  // namespace ambf::ros_comm
