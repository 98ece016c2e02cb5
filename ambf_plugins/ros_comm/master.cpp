#include "ros_comm/master.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "ros_comm/node_name.h"

namespace ambf::ros_comm::master {

namespace {

using XmlRpc::XmlRpcValue;

bool ask(const char* method, const XmlRpcValue& request, XmlRpcValue& payload) {
  XmlRpcValue response;
  return ros::master::execute(method, request, response, payload, false);
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : value;
}

// As rosgraph finds it.
std::string log_folder() {
  if (const std::string logs = variable("ROS_LOG_DIR"); !logs.empty()) return logs;
  if (const std::string home = variable("ROS_HOME"); !home.empty()) return home + "/log";
  return variable("HOME") + "/.ros/log";
}

XmlRpcValue one(const std::string& argument) {
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  request[1] = argument;
  return request;
}

std::string uri_of(const std::string& node) {
  XmlRpcValue payload;
  if (!ask("lookupNode", one(node), payload) || payload.getType() != XmlRpcValue::TypeString) return {};
  return payload;
}

// Calls a node's own interface without waiting longer than `timeout_s`; its third element is the answer.
bool call_node(const std::string& uri, const char* method, const XmlRpcValue& request, double timeout_s,
               XmlRpcValue& answer) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return false;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  if (!client.executeNonBlock(method, request)) return false;
  XmlRpc::XmlRpcDispatch dispatch;
  dispatch.addSource(&client, XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  XmlRpcValue response;
  bool done = false;
  while (!done && std::chrono::steady_clock::now() < deadline) {
    dispatch.work(0.01);
    done = client.executeCheckDone(response);
    if (!done && client.getfd() < 0) return false;  // refused
  }
  dispatch.removeSource(&client);
  if (!done || client.isFault() || response.getType() != XmlRpcValue::TypeArray || response.size() < 3) return false;
  answer = response[2];
  return true;
}

// For each name in one part of the master's state (0 publishers, 1 subscribers, 2 services) that `node` has registered.
template <class Visit>
void each_registration(XmlRpcValue& state, int part, const std::string& node, Visit visit) {
  XmlRpcValue& list = state[part];
  for (int i = 0; i < list.size(); ++i) {
    for (int j = 0; j < list[i][1].size(); ++j) {
      if (std::string(list[i][1][j]) == node) visit(std::string(list[i][0]));
    }
  }
}

bool system_state(XmlRpcValue& state) {
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  return ask("getSystemState", request, state) && state.getType() == XmlRpcValue::TypeArray && state.size() == 3;
}

}  // namespace

std::vector<std::string> command(std::uint32_t port) {
  std::vector<std::string> words{"rosmaster", "--core", "-p", std::to_string(port)};
  // rosmaster ends where its folder is there and not writable; where it can make none, it does without.
  const std::string logs = log_folder();
  if (access(logs.c_str(), F_OK) == 0 && access(logs.c_str(), W_OK) != 0) {
    words.insert(words.begin(), {"env", "ROS_LOG_DIR=/dev/null/none"});
  }
  return words;
}

bool is_local(const std::string& host) {
  if (host == "localhost" || host == "127.0.0.1" || host == "::1") return true;
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 && host == name;
}

std::string pid() {
  XmlRpcValue request, payload;
  request[0] = ros::this_node::getName();
  if (!ask("getPid", request, payload)) return {};
  return payload.getType() == XmlRpcValue::TypeInt ? std::to_string(static_cast<int>(payload)) : "unknown";
}

std::vector<std::string> other_publishers(const std::string& topic) {
  std::vector<std::string> others;
  XmlRpcValue state;
  if (!system_state(state)) return others;
  XmlRpcValue& list = state[0];
  for (int i = 0; i < list.size(); ++i) {
    if (std::string(list[i][0]) != topic) continue;
    for (int j = 0; j < list[i][1].size(); ++j) {
      std::string node = list[i][1][j];
      if (node != ros::this_node::getName()) others.push_back(std::move(node));
    }
  }
  return others;
}

bool alive(const std::string& node, double timeout_s) {
  const std::string uri = uri_of(node);
  XmlRpcValue request, answer;
  request[0] = ros::this_node::getName();
  if (uri.empty() || uri == ros::XMLRPCManager::instance()->getServerURI()) return false;  // its port is ours now
  if (!call_node(uri, "getPid", request, timeout_s, answer) || answer.getType() != XmlRpcValue::TypeInt) return false;
  // The port of a dead node may have been given to another: our nodes say in their name whose they are.
  const int owner = process_in(node);
  return owner == 0 || owner == static_cast<int>(answer);
}

bool get_parameter(const std::string& name, XmlRpcValue& value) {
  XmlRpcValue question;
  question[0] = ros::this_node::getName();
  question[1] = name;
  return ask("getParam", question, value);
}

bool set_parameter(const std::string& name, const XmlRpcValue& value) {
  XmlRpcValue question, nothing;
  question[0] = ros::this_node::getName();
  question[1] = name;
  question[2] = value;
  return ask("setParam", question, nothing);
}

void delete_parameter(const std::string& name) {
  XmlRpcValue question, nothing;
  question[0] = ros::this_node::getName();
  question[1] = name;
  ask("deleteParam", question, nothing);
}

void unregister_node(const std::string& node) {
  const std::string uri = uri_of(node);
  XmlRpcValue state;
  if (uri.empty() || !system_state(state)) return;
  static constexpr const char* kMethods[] = {"unregisterPublisher", "unregisterSubscriber", "unregisterService"};
  for (int part = 0; part < 3; ++part) {
    each_registration(state, part, node, [&](const std::string& name) {
      XmlRpcValue request, payload;
      request[0] = node;
      request[1] = name;
      request[2] = uri;
      if (part == 2) {  // services are identified by their own address
        XmlRpcValue address;
        if (!ask("lookupService", one(name), address)) return;
        request[2] = address;
      }
      ask(kMethods[part], request, payload);
    });
  }
}

std::map<std::string, std::set<std::string>> heard_publishers() {
  std::map<std::string, std::set<std::string>> topics;
  XmlRpcValue request, info;  // a list of [id, address, direction, transport, topic, ...]
  request[0] = ros::this_node::getName();
  if (!call_node(ros::XMLRPCManager::instance()->getServerURI(), "getBusInfo", request, 1.0, info)) return topics;
  for (int i = 0; info.getType() == XmlRpcValue::TypeArray && i < info.size(); ++i) {
    if (std::string(info[i][2]) == "i") topics[std::string(info[i][4])].insert(std::string(info[i][1]));
  }
  return topics;
}

void announce_publishers(const std::string& topic, const std::vector<std::string>& uris) {
  XmlRpcValue request, answer, list;
  list.setSize(static_cast<int>(uris.size()));
  for (std::size_t i = 0; i < uris.size(); ++i) list[static_cast<int>(i)] = uris[i];
  request[0] = "/master";
  request[1] = topic;
  request[2] = list;
  call_node(ros::XMLRPCManager::instance()->getServerURI(), "publisherUpdate", request, 1.0, answer);
}

}  // namespace ambf::ros_comm::master
