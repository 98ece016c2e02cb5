// The world's own topics: State, Command (throttling), Command/Reset, Command/Reset/Bodies and Rates; and its services. Private to
// ros_comm. C++17.
#pragma once

#include <ambf_msgs/WorldCmd.h>
#include <ambf_msgs/WorldRates.h>
#include <ambf_msgs/WorldState.h>
#include <std_msgs/Empty.h>

#include <memory>
#include <string>

#include "comm/middleware.h"
#include "ros_comm/services.h"
#include "ros_comm/topics.h"

namespace ambf::ros_comm {

class WorldEndpoint final : public comm::Endpoint {
 public:
  WorldEndpoint(Node& node, const std::string& world_name, state::Control& control);

  bool has_subscribers() const override { return state_.subscribers() + rates_.subscribers() > 0; }
  void publish(const state::Frame& frame, std::uint32_t slot) override;

 private:
  void on_command(const ros::MessageEvent<const ambf_msgs::WorldCmd>& event);
  void publish_rates(const state::Frame& frame);

  state::Control& control_;
  ambf_msgs::WorldState message_;  // publisher thread
  std::int64_t last_rates_ns_ = 0;
  StatePublisher<ambf_msgs::WorldState> state_;
  StatePublisher<ambf_msgs::WorldRates> rates_;
  CommandSubscriber<ambf_msgs::WorldCmd> command_;
  CommandSubscriber<std_msgs::Empty> reset_, reset_bodies_;
  Services services_;
};

}  // namespace ambf::ros_comm
