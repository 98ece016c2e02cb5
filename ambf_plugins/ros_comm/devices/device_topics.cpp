#include "ros_comm/devices/device_topics.h"

#include <algorithm>

#include "base/clock.h"
#include "base/realtime.h"
#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/topic_names.h"
#include "ros_comm/master.h"

namespace ambf::ros_comm {

namespace {

constexpr std::int64_t kRatesPeriodNs = 200'000'000;
constexpr std::int64_t kIdlePeriodNs = 20'000'000;  // while nobody subscribes: a newcomer hardly notices
constexpr double kReadsPerCycle = 2.0;              // so that no cycle is missed when the two threads drift
constexpr double kMaxReads_hz = 10000.0;

}  // namespace

std::string device_topic(const std::string& world_topic, unsigned device, const std::string& name) {
  const std::string space = world_topic.substr(0, world_topic.rfind('/') + 1);
  return topic_name(space + "physical_device_" + std::to_string(device) + "/" + name);
}

DeviceTopics::DeviceTopics(Node& node, const std::string& world_topic, state::DeviceAbility& devices)
    : node_(node),
      devices_(devices),
      rates_(node, world_topic + "/DeviceRates", kStateQueueSize),
      list_(node, world_topic + "/Devices", gate_, [this](auto& in, auto& out) { return list(in, out); }),
      set_(node, world_topic + "/SetDevice", gate_, [this](auto& in, auto& out) { return set(in, out); }) {
  const std::string known = node.master_pid();
  for (unsigned device = 0; device < devices.count(); ++device) {
    const std::string topic = device_topic(world_topic, device, devices.info(device)->name);
    try {
      endpoints_.push_back(std::make_unique<DeviceEndpoint>(node, devices, device, topic));
    } catch (const std::exception& e) {
      const std::string now = master::pid();
      if (now.empty() || now != known) throw;  // the master has ended: all topics of the world are tried again
      // An object of the scene may have a topic of this name and another type.
      node.log().error("ROS: no topics for the input device '%s': %s", devices.info(device)->name.c_str(), e.what());
      endpoints_.push_back(nullptr);
    }
  }
  if (!endpoints_.empty()) thread_ = std::thread([this] { publish_until_stopped(); });
}

DeviceTopics::~DeviceTopics() {
  gate_->close();
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void DeviceTopics::watch(const state::Frame& frame) {
  time_.publish({frame.sim_step, frame.wall_time, frame.sim_time});
}

void DeviceTopics::publish_rates(const state::Frame& frame) {
  if (frame.steady_ns - rates_published_ns_ < kRatesPeriodNs) return;
  rates_published_ns_ = frame.steady_ns;
  rates_message_.header.stamp = stamp_of(frame);
  rates_message_.sim_step = frame.sim_step;
  rates_message_.forces = devices_.forces();
  rates_message_.devices.resize(devices_.count());
  for (unsigned device = 0; device < devices_.count(); ++device) {
    state::DeviceStatus status;
    devices_.status(device, status);
    fill(*devices_.info(device), status, base::steady_ns(), rates_message_.devices[device]);
  }
  rates_.publish(rates_message_);
}

void DeviceTopics::publish_until_stopped() {
  base::enter_real_time("device topics", node_.sending_priority());
  std::int64_t next_ns = base::steady_ns();
  while (!stopping_) {
    WorldTime time;
    time_.read(time);
    double fastest_hz = 0.0;
    for (const std::unique_ptr<DeviceEndpoint>& endpoint : endpoints_) {
      if (endpoint == nullptr || !endpoint->has_subscribers()) continue;
      endpoint->publish(time);
      fastest_hz = std::max(fastest_hz, endpoint->rate_hz());
    }
    const double reads_hz = std::min(kReadsPerCycle * fastest_hz, kMaxReads_hz);
    const std::int64_t period_ns =
        reads_hz > 0.0 ? std::min(base::to_ns(1.0 / reads_hz), kIdlePeriodNs) : kIdlePeriodNs;
    next_ns = std::max(next_ns + period_ns, base::steady_ns());  // time that was lost is not caught up
    base::sleep_until(next_ns);
  }
}

unsigned DeviceTopics::find(const std::string& name) const {
  unsigned device = 0;
  while (device < devices_.count() && devices_.info(device)->name != name) ++device;
  return device;
}

bool DeviceTopics::list(ambf_msgs::Devices::Request&, ambf_msgs::Devices::Response& response) {
  response.success = 1;
  response.message = std::to_string(devices_.count()) + " input devices";
  response.forces = devices_.forces();
  response.devices.resize(devices_.count());
  for (unsigned device = 0; device < devices_.count(); ++device) {
    state::DeviceStatus status;
    devices_.status(device, status);
    const std::unique_ptr<DeviceEndpoint>& endpoint = endpoints_[device];
    fill(*devices_.info(device), status, endpoint == nullptr ? "" : endpoint->topic(), response.devices[device]);
  }
  return true;
}

bool DeviceTopics::set(ambf_msgs::SetDevice::Request& request, ambf_msgs::SetDevice::Response& response) {
  const auto answer = [&response](const std::string& problem, const std::string& done) {
    response.success = problem.empty();
    response.message = problem.empty() ? done : problem;
    return true;
  };
  if (request.device.empty()) {
    if (request.parameter != "forces" || request.value.size() != 1) {
      return answer("without a device, only 'forces' can be set, to one number: 0 off, else on", {});
    }
    devices_.set_forces(request.value[0] != 0.0);
    return answer({}, request.value[0] != 0.0 ? "forces are on" : "forces are off");
  }
  const unsigned device = find(request.device);
  if (device == devices_.count()) return answer("there is no input device of this name; Devices lists them", {});
  const state::DeviceParameter parameter = find_parameter(request.parameter);
  if (parameter == state::DeviceParameter::count) return answer("there is no such parameter; Devices lists them", {});
  math::Vec3 value;
  std::string problem = read_value(request.value, parameter, value);
  if (problem.empty()) problem = devices_.set(device, parameter, value);
  return answer(problem, request.device + ": " + request.parameter + " is set");
}

}  // namespace ambf::ros_comm
