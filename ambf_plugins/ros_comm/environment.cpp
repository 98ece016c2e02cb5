#include "ros_comm/environment.h"

#include <ros/names.h>
#include <ros/network.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "ros_comm/master.h"

namespace ambf::ros_comm {

namespace {

constexpr std::size_t kMaxShown = 80;      // characters of a value
constexpr std::size_t kMaxHostName = 253;  // of DNS
constexpr std::size_t kMaxNamespace = 1024;
constexpr std::uint32_t kMaxPort = 65535;

std::string value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

std::string shown(const char* variable, const std::string& value) {
  return std::string(variable) + "='" + value.substr(0, kMaxShown) + (value.size() > kMaxShown ? "..." : "") + "'";
}

bool may_be_host(const std::string& name) {
  return !name.empty() && name.size() <= kMaxHostName && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == '-' || c == '_' || c == ':';
  });
}

}  // namespace

std::string problem_of_environment() {
  if (value_of("ROS_MASTER_URI").empty()) setenv("ROS_MASTER_URI", master::kDefaultUri, 1);
  const std::string uri = value_of("ROS_MASTER_URI");
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port) || !may_be_host(host) || port == 0 || port > kMaxPort) {
    return shown("ROS_MASTER_URI", uri) + " is not the address of a ROS master: it should be http://HOST:PORT, as " +
           master::kDefaultUri + " is";
  }
  for (const char* variable : {"ROS_IP", "ROS_HOSTNAME"}) {
    const std::string name = value_of(variable);
    if (!name.empty() && !may_be_host(name)) {
      return shown(variable, name) + " is not an address of this machine: others could not reach its topics";
    }
  }
  const std::string space = value_of("ROS_NAMESPACE");
  std::string why;
  if (space.size() > kMaxNamespace) why = "it is longer than " + std::to_string(kMaxNamespace) + " characters";
  if (!why.empty() || !ros::names::validate(space, why)) {
    return shown("ROS_NAMESPACE", space) + " is not a ROS name: " + why.substr(0, 2 * kMaxShown);
  }
  return {};
}

}  // namespace ambf::ros_comm
