// A bound on how deeply values in XML-RPC requests may lie within each other. roscpp's parser calls itself for each
// level: a request of 4 MB with 100,000 levels overflows the stack and ends the process, one with 10,000 holds roscpp's
// thread for seconds. Private to ros_comm. C++17.
#pragma once

namespace ambf::ros_comm {

// Finds the library's parser, which the bounded one in xml_depth.cpp stands in front of. Before ROS is started. False:
// this program's parser is not the one that roscpp calls (a linker option, another version), and nothing is bounded.
bool bound_xml_depth();

}  // namespace ambf::ros_comm
