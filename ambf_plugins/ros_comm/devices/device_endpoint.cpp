#include "ros_comm/devices/device_endpoint.h"

#include "base/clock.h"

namespace ambf::ros_comm {

namespace {

// Reading an info may wait for a thread of low priority, reading a status does not.
constexpr std::int64_t kInfoPeriodNs = 100'000'000;

}  // namespace

DeviceEndpoint::DeviceEndpoint(Node& node, state::DeviceAbility& devices, unsigned device, const std::string& topic)
    : node_(node),
      devices_(devices),
      device_(device),
      topic_(topic),
      states_(node, topic + "/State", kStateQueueSize),
      mappings_(node, topic + "/Mapping", kStateQueueSize),
      commands_(
          node, topic + "/Command",
          [this](const ros::MessageEvent<const ambf_msgs::ObjectCmd>& event) { on_command(*event.getConstMessage()); },
          [this](const std::string& why) { node_.traffic().refuse(topic_, why); }) {}

void DeviceEndpoint::publish(const WorldTime& time) {
  if (!has_subscribers()) return;
  const ClockPair now{base::steady_ns(), base::system_ns()};
  renew_info(now.steady_ns);
  if (!devices_.status(device_, status_) || status_.cycle == published_) return;
  published_ = status_.cycle;
  if (states_.subscribers() > 0) {
    fill(status_, time, now, state_);
    states_.publish(state_);
    node_.traffic().states.fetch_add(1, std::memory_order_relaxed);
  }
  if (mappings_.subscribers() > 0) {
    fill(status_, time, now, mapping_);
    mappings_.publish(mapping_);
    node_.traffic().states.fetch_add(1, std::memory_order_relaxed);
  }
}

void DeviceEndpoint::renew_info(std::int64_t now_ns) {
  if (now_ns < renew_info_ns_) return;
  renew_info_ns_ = now_ns + kInfoPeriodNs;
  std::shared_ptr<const state::DeviceInfo> info = devices_.info(device_);
  if (info == info_) return;
  info_ = std::move(info);
  fill_names(*info_, state_);
  fill_names(*info_, mapping_);
}

void DeviceEndpoint::on_command(const ambf_msgs::ObjectCmd& message) {
  HandCommand command;
  if (const std::string refusal = read(message, command); !refusal.empty()) {
    return node_.traffic().refuse(topic_, refusal);
  }
  command.has_target ? devices_.pull_to(device_, command.T_world_target) : devices_.push(device_, command.wrench_world);
  node_.traffic().accepted.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace ambf::ros_comm
