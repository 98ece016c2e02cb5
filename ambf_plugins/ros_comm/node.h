// The process's ROS node: joins a master, starts one where none is, offers callback queues, and registers everything
// again when a master was restarted. Private to ros_comm. C++17.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "base/log.h"
#include "ros_comm/child_program.h"
#include "ros_comm/lost_publishers.h"
#include "ros_comm/services/service_queue.h"
#include "ros_comm/step_requests.h"
#include "ros_comm/traffic.h"

namespace ambf::ros_comm {

// What is registered at the master besides ROS's own: needed to do it again.
struct Registration {
  enum class Kind { publisher, subscriber, service } kind = Kind::publisher;
  std::string name, type;
  bool operator<(const Registration& other) const {
    return std::tie(kind, name, type) < std::tie(other.kind, other.name, other.type);
  }
};

// Who sent a message or request, by the header of its connection.
std::string sender_in(const boost::shared_ptr<ros::M_string>& connection_header);

class Node {
 public:
  // Throws std::invalid_argument when the environment does not allow ROS (environment.h).
  Node(base::Log& log, int sending_priority);  // of roscpp's sending thread, SCHED_FIFO; 0: ordinary
  ~Node();                                     // everything of ours is unregistered, our own master stopped
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  // Whether a master answers: topics can be opened.
  bool connected() const { return connected_; }
  // The process id of the master that knows all of this node's names; empty before there is one.
  std::string master_pid() const;
  // A handle for one use, only when connected() was true once: a handle remembers all it ever opened, a little memory
  // for each.
  ros::NodeHandle handle() { return *handle_; }
  ros::CallbackQueue& commands() { return commands_; }
  ServiceQueue& services() { return services_; }
  base::Log& log() { return log_; }
  Traffic& traffic() { return traffic_; }
  StepRequests& step_requests() { return step_requests_; }
  int sending_priority() const { return sending_priority_; }  // of what publishes states; 0: ordinary
  std::size_t topics() const;                                 // publishers and subscribers
  bool stopping() const { return stop_; }

  // Closing a topic must not meet the opening or closing of another: roscpp keeps a place in its list while others may
  // change it. Open under a shared lock, close under a unique one, with its Registered.
  std::shared_mutex& topic_list() { return topic_list_; }

 private:
  friend class Registered;

  void supervise();
  void known_by(const std::string& pid);
  void start_master();
  void join();
  bool register_again();
  bool register_one(const Registration& registration);
  bool subscribe_again(const Registration& registration, const std::set<std::string>& lost);
  void forget_lost_publishers();
  bool has(const Registration& registration) const;

  base::Log& log_;
  const int sending_priority_;
  Traffic traffic_;
  StepRequests step_requests_;
  ros::CallbackQueue commands_;
  ServiceQueue services_;
  std::unique_ptr<ros::NodeHandle> handle_;
  std::atomic<bool> connected_{false}, stop_{false};
  std::shared_mutex topic_list_;
  mutable std::mutex mutex_;
  std::multiset<Registration> registrations_;  // guarded
  std::string master_pid_;                     // guarded

  ChildProgram child_master_;  // this and the next: supervisor thread
  bool absence_logged_ = false;
  LostPublishers lost_publishers_;
  std::vector<std::thread> threads_;
  std::thread supervisor_;
};

// The node knows of a registration for as long as this lives. Make it before the registration itself: should the master
// be replaced in between, it is made up for.
class Registered {
 public:
  Registered(Node& node, Registration registration);
  ~Registered();
  Registered(const Registered&) = delete;
  Registered& operator=(const Registered&) = delete;
  const std::string& name() const { return registration_.name; }

 private:
  Node& node_;
  const Registration registration_;
};

}  // namespace ambf::ros_comm
