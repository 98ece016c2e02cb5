// The comm instance of a camera or a light on ROS: both are told poses in their parent's frame. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/CameraCmd.h>
#include <ambf_msgs/CameraState.h>
#include <ambf_msgs/LightCmd.h>
#include <ambf_msgs/LightState.h>

#include <memory>
#include <string>

#include "comm/middleware.h"
#include "ros_comm/endpoints/command_watch.h"
#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/parameter_server.h"
#include "ros_comm/endpoints/topics.h"

namespace ambf::ros_comm {

template <class StateMessage, class CommandMessage>
class PoseEndpoint final : public comm::Endpoint {
 public:
  PoseEndpoint(Node& node, const state::ObjectInfo& object, const std::string& topic, state::CommandAbility& command,
               ParameterServer& parameters)
      : node_(node),
        command_ability_(command),
        name_(object.name),
        object_(object.id),
        port_(command.bind(object.id, state::Source::ros)),
        watch_(node.traffic(), object.name),
        publisher_(node, topic + "/State"),
        subscriber_(
            node, topic + "/Command",
            [this](const ros::MessageEvent<const CommandMessage>& event) { on_command(*event.getConstMessage()); }),
        parameters_(parameters.offer(object, topic)) {}

  bool has_subscribers() const override { return publisher_.subscribers() > 0; }

  void watch(const state::Frame&, bool active) override { watch_.see(active); }

  void publish(const state::Frame& frame, std::uint32_t slot) override {
    if (frame.structure->version != structure_version_) {
      structure_version_ = frame.structure->version;
      fill_names(*frame.structure, slot, message_);
    }
    fill(frame, slot, message_);
    publisher_.publish(message_);
  }

 private:
  void on_command(const CommandMessage& message) {
    state::PoseCommand command;
    const std::string refusal = read_pose_command(message.enable_position_controller != 0, message.pose, command);
    if (!refusal.empty()) {
      command_ability_.count_refused_command(object_);
      node_.traffic().refuse(name_, refusal);
      return;
    }
    if (!port_) return;  // the object is gone, its topics soon are
    port_->post(command);
    watch_.commanded();
  }

  Node& node_;
  state::CommandAbility& command_ability_;
  const std::string name_;
  const state::ObjectId object_;
  std::unique_ptr<state::CommandPort> port_;
  CommandWatch watch_;
  StateMessage message_;  // publisher thread
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  StatePublisher<StateMessage> publisher_;
  CommandSubscriber<CommandMessage> subscriber_;  // callbacks use all of the above
  const std::unique_ptr<ParameterServer::Offer> parameters_;
};

using LightEndpoint = PoseEndpoint<ambf_msgs::LightState, ambf_msgs::LightCmd>;

}  // namespace ambf::ros_comm
