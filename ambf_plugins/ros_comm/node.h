// The process's ROS node: joins a master, offers callback queues, and registers everything again when a master was restarted.
// Private to ros_comm. C++17.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/log.h"
#include "ros_comm/child_master.h"

namespace ambf::ros_comm {

// What is registered at the master besides ROS's own: needed to do it again.
struct Registration {
  enum class Kind { publisher, subscriber, service } kind = Kind::publisher;
  std::string name, type;
  bool operator<(const Registration& other) const {
    return std::tie(kind, name, type) < std::tie(other.kind, other.name, other.type);
  }
};

class Node {
 public:
  explicit Node(base::Log& log);
  ~Node();  // everything of ours is unregistered, our own master stopped
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  bool connected() const { return connected_; }
  ros::NodeHandle& handle() { return *handle_; }  // only when connected() was true once
  ros::CallbackQueue& commands() { return commands_; }
  ros::CallbackQueue& services() { return services_; }
  base::Log& log() { return log_; }

  void remember(const Registration& registration);
  void forget(const Registration& registration);

 private:
  void supervise();
  bool master_answers(std::string& master_pid);
  void join();
  void register_again();

  base::Log& log_;
  ChildMaster child_master_;
  ros::CallbackQueue commands_, services_;
  std::unique_ptr<ros::NodeHandle> handle_;
  std::atomic<bool> connected_{false}, stop_{false};
  std::mutex mutex_;
  std::multiset<Registration> registrations_;  // guarded
  std::vector<std::thread> threads_;
  std::thread supervisor_;
};

}  // namespace ambf::ros_comm
