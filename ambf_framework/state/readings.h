// What sensors measure beside what their elements sense: one reading a sensor, and the contacts of contact sensors, of
// which those beyond base::kMaxSensedContacts are left out.
// Plain data, read by any thread. C++17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "state/sensors.h"

namespace ambf::state {

// In the sensor's axes; 0 for the other types.
struct SensorReading {
  // IMU: specific force (m/s^2) and angular velocity (rad/s). Force Torque: N and N m at the sensor.
  math::Vec3 linear, angular;
  std::uint32_t first_contact = 0, contacts = 0;  // Contact: rows of the column of contacts
};

// A contact point of a contact sensor's body with another one. World axes.
struct SensedContact {
  std::uint32_t body = kNone;            // slot of the other body
  math::Vec3 point_world, normal_world;  // on the other body; unit, from it towards the sensor's
  double distance_m = 0.0;               // negative: depth
  math::Vec3 force_world;                // N on the sensor's body, friction included, mean of the last step
};

template <class Visit>
void visit_computed(SensorReading& row, Visit& visit) {
  visit(row.linear), visit(row.angular);
}
template <class Visit>
void visit_computed(SensedContact& row, Visit& visit) {
  visit(row.point_world), visit(row.normal_world), visit(row.distance_m), visit(row.force_world);
}

const SensorReading& reading_of(const Frame& frame, std::uint32_t sensor_slot);
// Of one sensor, sorted by the other body; both null where the frame has none (a diverged world, new structure).
struct ContactRange {
  const SensedContact* first = nullptr;
  const SensedContact* last = nullptr;
  const SensedContact* begin() const { return first; }
  const SensedContact* end() const { return last; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};
ContactRange contacts_of(const Frame& frame, std::uint32_t sensor_slot);

// All rows, for the physics thread to fill; of contacts at most their vector's capacity.
std::vector<SensorReading>& sensor_readings(Frame& frame);
std::vector<SensedContact>& sensed_contacts(Frame& frame);

}  // namespace ambf::state
