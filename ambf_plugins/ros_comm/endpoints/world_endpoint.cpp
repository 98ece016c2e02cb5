#include "ros_comm/endpoints/world_endpoint.h"

#include <functional>

#include "base/clock.h"
#include "ros_comm/endpoints/contact_messages.h"
#include "ros_comm/endpoints/conversions.h"

namespace ambf::ros_comm {

namespace {
constexpr std::int64_t kSilenceNs = 500'000'000;  // as the watchdogs of all other objects
void nothing_to_refuse(const std::string&) {}     // an Empty has no fields whose lengths could be wrong
}  // namespace

WorldEndpoint::WorldEndpoint(Node& node, const std::string& topic, const TopicNames& topics,
                             const state::Abilities& simulation)
    : node_(node),
      run_(simulation.run),
      rates_now_(node, simulation.devices),
      state_(node, topic + "/State"),
      rates_(node, topic + "/Rates"),
      command_rates_(node, topic + "/CommandRates"),
      contacts_(node, topic + "/Contacts"),
      success_(node, topic + "/Success"),
      command_(
          node, topic + "/Command",
          [this](const ros::MessageEvent<const ambf_msgs::WorldCmd>& event) { on_command(event); },
          [&node, topic](const std::string& why) { node.traffic().refuse(topic, why); }, kWorldCommandQueue),
      reset_(
          node, topic + "/Command/Reset",
          [this](const ros::MessageEvent<const std_msgs::Empty>&) { run_.reset_world(); }, nothing_to_refuse, 1),
      reset_bodies_(
          node, topic + "/Command/Reset/Bodies",
          [this](const ros::MessageEvent<const std_msgs::Empty>&) { run_.reset_bodies(); }, nothing_to_refuse, 1),
      services_(node, topic, topics, simulation) {
  message_.n_devices = 0;
  if (simulation.devices == nullptr || simulation.devices->count() == 0) return;
  devices_ = std::make_unique<DeviceTopics>(node, topic, *simulation.devices);
  message_.n_devices = static_cast<std::uint8_t>(simulation.devices->count());
}

void WorldEndpoint::on_command(const ros::MessageEvent<const ambf_msgs::WorldCmd>& event) {
  const ambf_msgs::WorldCmd& message = *event.getConstMessage();
  state::WorldCommand command;
  command.enable_step_throttling = message.enable_step_throttling != 0;
  command.step_clock = message.step_clock != 0;
  command.n_skip_steps = message.n_skip_steps;
  command.client = std::hash<std::string>()(event.getPublisherName());
  run_.post_world(command);
  node_.traffic().accepted.fetch_add(1, std::memory_order_relaxed);
  last_command_ns_ = base::steady_ns();
}

void WorldEndpoint::watch(const state::Frame& frame, bool throttled) {
  if (devices_ != nullptr) devices_->watch(frame);
  success_.watch(frame);
  std::int64_t last = last_command_ns_;
  if (last == 0 || frame.steady_ns - last < kSilenceNs) return;
  // A command that arrives at this very moment counts as a sign of life.
  if (!last_command_ns_.compare_exchange_strong(last, 0) || !throttled) return;
  node_.log().info("no command to the world for 0.5 s: the client that throttles it is silent");
  run_.world_command_expired();
}

void WorldEndpoint::publish(const state::Frame& frame, std::uint32_t) {
  if (state_.subscribers() > 0) {
    fill(frame, message_);
    state_.publish(message_);
  }
  if (contacts_.subscribers() > 0) {
    fill(frame, contacts_message_);
    contacts_.publish(contacts_message_);
  }
  if (rates_.subscribers() > 0 && rates_now_.due(frame.steady_ns)) rates_.publish(rates_now_.measure(frame));
  if (command_rates_.subscribers() > 0 && command_rates_now_.due(frame.steady_ns)) {
    command_rates_.publish(command_rates_now_.measure(frame));
  }
  if (devices_ != nullptr && devices_->has_subscribers()) devices_->publish_rates(frame);
}

}  // namespace ambf::ros_comm
