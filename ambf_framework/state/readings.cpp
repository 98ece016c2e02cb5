#include "state/readings.h"

#include <algorithm>

#include "base/limits.h"
#include "state/detail/built_in_kinds.h"

namespace ambf::state {
namespace {

ColumnId<SensorReading> registered_readings;
ColumnId<SensedContact> registered_contacts;

std::size_t max_contacts(const Structure& structure) {
  const std::vector<SensorInfo>& all = sensors(structure);
  const auto of_contact = [](const SensorInfo& sensor) { return sensor.type == SensorType::contact; };
  const auto count = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), of_contact));
  return std::min(count * base::kMaxContactsOfASensor, base::kMaxSensedContacts);
}

}  // namespace

void register_reading_columns() {
  ColumnTraits readings;
  readings.name = "sensor_readings";
  readings.kind = sensor_kind().kind;
  readings.hashed = true;
  readings.while_diverged = WhileDiverged::last_good;
  registered_readings = register_column<SensorReading>(std::move(readings));
  ColumnTraits contacts;
  contacts.name = "sensed_contacts";
  contacts.hashed = true;
  contacts.while_diverged = WhileDiverged::last_good_structure;
  contacts.rows_of = max_contacts;
  registered_contacts = register_column<SensedContact>(std::move(contacts));
}

const SensorReading& reading_of(const Frame& frame, std::uint32_t sensor_slot) {
  return rows(frame, registered_readings)[sensor_slot];
}

ContactRange contacts_of(const Frame& frame, std::uint32_t sensor_slot) {
  const SensorReading& reading = reading_of(frame, sensor_slot);
  const std::vector<SensedContact>& all = rows(frame, registered_contacts);
  if (std::size_t{reading.first_contact} + reading.contacts > all.size()) return {};
  return {all.data() + reading.first_contact, all.data() + reading.first_contact + reading.contacts};
}

std::vector<SensorReading>& sensor_readings(Frame& frame) { return rows(frame, registered_readings); }
std::vector<SensedContact>& sensed_contacts(Frame& frame) { return rows(frame, registered_contacts); }

}  // namespace ambf::state
