// The commands and services that an arm takes. Callbacks run on the node's threads until this ends. C++17.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "crtk/arm_control.h"
#include "ros_comm/node.h"
#include "ros_comm/services/offered_service.h"

namespace ambf::crtk {

// Runs what a command asks of the arm, under its lock; what it returns is why it was refused, or "".
using Act = std::function<std::string(ArmControl&)>;
using Execute = std::function<void(const Act&)>;

class ArmCommands {
 public:
  // `execute` must outlive it. Throws when ROS does not take a topic.
  ArmCommands(ros_comm::Node& node, const std::string& prefix, const adf::CrtkArm& arm, Execute execute);
  ~ArmCommands();
  ArmCommands(const ArmCommands&) = delete;
  ArmCommands& operator=(const ArmCommands&) = delete;

 private:
  // A subscriber of any type.
  struct Taken {
    virtual ~Taken() = default;
  };
  template <class Message>
  using Does = std::function<std::string(ArmControl&, const Message&)>;
  template <class Message>
  void take(const std::string& name, Does<Message> does);
  void take_joints();
  void take_poses();
  void take_wrenches();
  void take_jaw();
  void take_master();
  void take_others();
  void offer_services();

  ros_comm::Node& node_;
  const std::string prefix_;
  const adf::CrtkArm arm_;
  const Execute execute_;
  const std::shared_ptr<ros_comm::Gate> gate_ = std::make_shared<ros_comm::Gate>();
  std::vector<std::unique_ptr<Taken>> taken_;
  std::vector<std::unique_ptr<ros_comm::Offered>> services_;
};

}  // namespace ambf::crtk
