#include "state/sensors.h"

#include <algorithm>
#include <array>

#include "state/detail/built_in_kinds.h"
#include "state/soft_bodies.h"

namespace ambf::state {
namespace {

PlacedKind<SensorState> registered_kind;
ColumnId<SensedElement> registered_elements;
ColumnId<SensorEventLog> registered_events;

std::size_t count_elements(const Structure& structure) {
  const std::vector<SensorInfo>& all = sensors(structure);
  return all.empty() ? 0 : all.back().first_element + all.back().elements;
}

std::size_t count_event_logs(const Structure& structure) {
  const std::vector<SensorInfo>& all = sensors(structure);
  return std::any_of(all.begin(), all.end(), [](const SensorInfo& sensor) { return sensor.is_judged(); }) ? 1 : 0;
}

}  // namespace

const char* name_of(SensorType type) {
  static constexpr std::array kNames{"Proximity", "Resistance", "Range", "Contact", "IMU", "Force Torque"};
  return kNames[static_cast<std::size_t>(type)];
}

void register_sensor_kind() {
  KindInfo info;
  info.name = "sensor";
  info.label = "sensor";
  info.plural = "sensors";
  registered_kind = register_placed_kind<SensorInfo, SensorState>(std::move(info));
  ColumnTraits traits;
  traits.name = "sensed_elements";
  traits.hashed = true;
  traits.while_diverged = WhileDiverged::last_good_structure;
  traits.rows_of = count_elements;
  registered_elements = register_column<SensedElement>(std::move(traits));
  ColumnTraits events;
  events.name = "sensor_events";
  events.rows_of = count_event_logs;
  registered_events = register_column<SensorEventLog>(std::move(events));
}

const PlacedKind<SensorState>& sensor_kind() {
  register_built_in_kinds();
  return registered_kind;
}

const std::vector<SensorInfo>& sensors(const Structure& structure) {
  static const std::vector<SensorInfo> none;
  const auto number = static_cast<std::size_t>(sensor_kind().kind);
  const bool has_table = number < structure.registered.size() && structure.registered[number].has_value();
  return has_table ? table<SensorInfo>(structure, sensor_kind().kind) : none;
}

std::uint32_t sensed_object(const Structure& structure, const SensedElement& element) {
  if (element.body < structure.bodies.size()) return structure.bodies[element.body].object;
  const std::vector<SoftBodyInfo>& soft = soft_bodies(structure);
  return element.soft_body < soft.size() ? soft[element.soft_body].object : kNone;
}

ElementRange elements_of(const Frame& frame, std::uint32_t sensor_slot) {
  const SensorInfo& sensor = sensors(*frame.structure)[sensor_slot];
  const std::vector<SensedElement>& all = rows(frame, registered_elements);
  if (sensor.first_element + sensor.elements > all.size()) return {};
  return {all.data() + sensor.first_element, all.data() + sensor.first_element + sensor.elements};
}

std::vector<SensedElement>& sensed_elements(Frame& frame) { return rows(frame, registered_elements); }

const SensorEventLog* sensor_events(const Frame& frame) {
  const std::vector<SensorEventLog>& logs = rows(frame, registered_events);
  return logs.empty() ? nullptr : logs.data();
}

SensorEventLog* sensor_events(Frame& frame) {
  std::vector<SensorEventLog>& logs = rows(frame, registered_events);
  logs.resize(count_event_logs(*frame.structure));  // within the room that it was made with
  return logs.empty() ? nullptr : logs.data();
}

}  // namespace ambf::state
