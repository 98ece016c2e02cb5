// The world's own topics: State, Command (throttling), Command/Reset, Command/Reset/Bodies, Rates, CommandRates and
// Contacts; its services; and what belongs to input devices. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/WorldCmd.h>
#include <ambf_msgs/WorldCommandRates.h>
#include <ambf_msgs/WorldContacts.h>
#include <ambf_msgs/WorldRates.h>
#include <ambf_msgs/WorldState.h>
#include <std_msgs/Empty.h>

#include <atomic>
#include <memory>
#include <string>

#include "comm/middleware.h"
#include "ros_comm/devices/device_topics.h"
#include "ros_comm/endpoints/command_rates.h"
#include "ros_comm/endpoints/rates.h"
#include "ros_comm/endpoints/topics.h"
#include "ros_comm/endpoints/world_success.h"
#include "ros_comm/services/services.h"

namespace ambf::ros_comm {

class WorldEndpoint final : public comm::Endpoint {
 public:
  WorldEndpoint(Node& node, const std::string& topic, const TopicNames& topics, const state::Abilities& simulation);

  bool has_subscribers() const override {
    return state_.subscribers() + rates_.subscribers() + command_rates_.subscribers() + contacts_.subscribers() > 0 ||
           (devices_ != nullptr && devices_->has_subscribers());
  }
  std::uint32_t step_interval() const override { return state_.step_interval(); }
  bool has_newcomers() const override { return state_.newcomers() || contacts_.newcomers(); }
  void publish(const state::Frame& frame, std::uint32_t slot) override;
  void watch(const state::Frame& frame, bool active) override;

 private:
  void on_command(const ros::MessageEvent<const ambf_msgs::WorldCmd>& event);

  Node& node_;
  state::RunAbility& run_;
  std::atomic<std::int64_t> last_command_ns_{0};  // 0: none, or its silence has been noticed
  ambf_msgs::WorldState message_;                 // publisher thread, as the next
  ambf_msgs::WorldContacts contacts_message_;
  Rates rates_now_;
  CommandRates command_rates_now_;
  StatePublisher<ambf_msgs::WorldState> state_;
  StatePublisher<ambf_msgs::WorldRates> rates_;
  StatePublisher<ambf_msgs::WorldCommandRates> command_rates_;
  StatePublisher<ambf_msgs::WorldContacts> contacts_;
  WorldSuccess success_;
  CommandSubscriber<ambf_msgs::WorldCmd> command_;
  CommandSubscriber<std_msgs::Empty> reset_, reset_bodies_;
  Services services_;
  std::unique_ptr<DeviceTopics> devices_;  // null: the simulation has no input devices
};

}  // namespace ambf::ros_comm
