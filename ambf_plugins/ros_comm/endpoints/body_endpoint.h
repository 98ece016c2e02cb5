// The comm instance of a rigid body on ROS. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/RigidBodyCmd.h>
#include <ambf_msgs/RigidBodyState.h>

#include <atomic>
#include <memory>

#include "comm/middleware.h"
#include "ros_comm/endpoints/command_watch.h"
#include "ros_comm/endpoints/topics.h"
#include "state/abilities/command.h"

namespace ambf::ros_comm {

class BodyEndpoint final : public comm::Endpoint {
 public:
  BodyEndpoint(Node& node, const state::ObjectInfo& object, const std::string& topic, state::CommandAbility& command);

  bool has_subscribers() const override { return publisher_.subscribers() > 0; }
  void publish(const state::Frame& frame, std::uint32_t slot) override;
  void watch(const state::Frame&, bool active) override { watch_.see(active); }

 private:
  void on_command(const ambf_msgs::RigidBodyCmd& message);

  Node& node_;
  state::CommandAbility& command_ability_;
  const std::string name_;
  const state::ObjectId object_;
  std::unique_ptr<state::CommandPort> port_;
  CommandWatch watch_;
  state::RigidBodyCommand command_;  // command thread
  // Commands may switch publishing of these on, for good.
  std::atomic<bool> wants_children_{false}, wants_joint_names_{false}, wants_joint_positions_{false};
  std::atomic<std::uint32_t> wishes_{0};  // + 1 with each change of the three
  ambf_msgs::RigidBodyState message_;     // publisher thread
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  std::uint32_t wishes_seen_ = 0;
  StatePublisher<ambf_msgs::RigidBodyState> publisher_;
  CommandSubscriber<ambf_msgs::RigidBodyCmd> subscriber_;  // last: callbacks use all of the above
};

}  // namespace ambf::ros_comm
