#include "ros_comm/endpoints/world_success.h"

#include <algorithm>

#include "ros_comm/endpoints/conversions.h"
#include "state/sensors.h"

namespace ambf::ros_comm {

WorldSuccess::WorldSuccess(Node& node, const std::string& topic) : publisher_(node, topic, kStateQueueSize, true) {}

void WorldSuccess::watch(const state::Frame& frame) {
  const state::Structure& structure = *frame.structure;
  bool changed = false;
  if (structure.version != structure_version_) {
    const std::vector<std::string> before = std::move(message_.names);
    structure_version_ = structure.version;
    message_.names.clear();
    slots_.clear();
    for (const state::SensorInfo& sensor : state::sensors(structure)) {
      if (sensor.success_when == state::SuccessWhen::never) continue;
      slots_.push_back(structure.objects[sensor.object].slot);
      message_.names.push_back(structure.objects[sensor.object].name);
    }
    changed = message_.names != before;
    message_.success.resize(slots_.size());
    message_.since.resize(slots_.size());
  }
  const auto& states = state::rows(frame, state::sensor_kind().column);
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const state::SensorState& sensor = states[slots_[i]];
    changed = changed || (message_.success[i] != 0) != sensor.success || message_.since[i] != sensor.success_since_s;
    message_.success[i] = sensor.success ? 1 : 0;
    message_.since[i] = sensor.success_since_s;
  }
  if (!changed) return;
  message_.header.stamp = stamp_of(frame);
  message_.sim_step = frame.sim_step;
  message_.sim_time = frame.sim_time;
  message_.all = !slots_.empty() && std::all_of(message_.success.begin(), message_.success.end(),
                                                [](std::uint8_t done) { return done != 0; });
  publisher_.publish(message_);
}

}  // namespace ambf::ros_comm
