// Calls to the ROS master and to other nodes that roscpp does not offer. Each waits for its answer: never call one from
// the publisher thread. Private to ros_comm. C++17.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

// NOLINTNEXTLINE(readability-identifier-naming): the library's name
namespace XmlRpc {
class XmlRpcValue;
}

namespace ambf::ros_comm::master {

inline constexpr const char* kDefaultUri = "http://localhost:11311";

// Whether the master is this machine: then we may start one, and need not be reachable from elsewhere.
bool is_local(const std::string& host);

// The command that starts a master on this port, also where its folder of logs is somebody else's.
std::vector<std::string> command(std::uint32_t port);

// The master's process id as text when it answers (it changes when a master is restarted); empty when it does not.
std::string pid();

// Names of the nodes, other than this one, that publish `topic`.
std::vector<std::string> other_publishers(const std::string& topic);

// Whether the node still runs: its process answers and is the one that the name belongs to. Nodes without answer within
// `timeout_s` count as dead.
bool alive(const std::string& node, double timeout_s);

// The parameter server. roscpp's own functions wait for a lost master and report each try; these return false at once.
bool get_parameter(const std::string& name, XmlRpc::XmlRpcValue& value);
bool set_parameter(const std::string& name, const XmlRpc::XmlRpcValue& value);
void delete_parameter(const std::string& name);

// Unregisters everything that a dead node left registered.
void unregister_node(const std::string& node);

// Of each topic that we subscribe to, the addresses of the nodes to which we hold a connection, or try to get it back.
std::map<std::string, std::set<std::string>> heard_publishers();

// Sends our own node the list of a topic's publishers, as the master would.
void announce_publishers(const std::string& topic, const std::vector<std::string>& uris);

}  // namespace ambf::ros_comm::master
