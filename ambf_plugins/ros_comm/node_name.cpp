#include "ros_comm/node_name.h"

#include <cstdio>

namespace ambf::ros_comm {

std::string node_name(int process, std::int64_t milliseconds) {
  return "ambf_comm_node_" + std::to_string(process) + "_" + std::to_string(milliseconds);
}

int process_in(const std::string& node) {
  int process = 0, end = 0;
  const char* name = node.c_str() + (node.rfind('/', 0) == 0 ? 1 : 0);
  const bool ours = std::sscanf(name, "ambf_comm_node_%d_%*d%n", &process, &end) == 1 && end > 0;
  return ours && process > 0 ? process : 0;
}

}  // namespace ambf::ros_comm
