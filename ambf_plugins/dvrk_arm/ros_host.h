// Where drivers behind ROS find the process's node. Devices are made before ROS is started and may outlive it: their
// drivers search the node when they open, and lose their hardware when it ends. Private to dvrk_arm. C++17.
#pragma once

#include <atomic>
#include <mutex>
#include <set>
#include <shared_mutex>

#include "ros_comm/node.h"

namespace ambf::dvrk_arm {

class RosDriver;

class RosHost {
 public:
  // Held while a driver opens or closes: the node stays until then. Null: there is none.
  class Lease {
   public:
    explicit Lease(RosHost& host) : lock_(host.mutex_), node_(host.ending_ ? nullptr : host.node_) {}
    ros_comm::Node* node() const { return node_; }

   private:
    std::shared_lock<std::shared_mutex> lock_;
    ros_comm::Node* node_;
  };

  void attach(ros_comm::Node& node);
  void detach();  // closes all drivers
  bool ending() const { return ending_; }
  void add(RosDriver& driver);
  void remove(RosDriver& driver);

 private:
  std::shared_mutex mutex_;
  std::atomic<bool> ending_{false};
  ros_comm::Node* node_ = nullptr;  // guarded
  std::mutex drivers_mutex_;
  std::set<RosDriver*> drivers_;  // guarded by it
};

}  // namespace ambf::dvrk_arm
