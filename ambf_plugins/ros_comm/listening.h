// How many may wait to be let in by this process. roscpp lets five wait at its XML-RPC port, at which everybody who
// listens to a topic asks for it first; a client that comes when five wait is turned away by the kernel and comes again
// a second later: a recorder of all topics then misses the first second of one. Any thread, once roscpp has started.
// Private to ros_comm. C++17.
#pragma once

#include <cstdint>

namespace ambf::ros_comm {

// Lets as many wait at this process's listening TCP socket of that port as the kernel allows. False: there is no such
// socket.
bool let_many_wait(std::uint32_t port);

}  // namespace ambf::ros_comm
