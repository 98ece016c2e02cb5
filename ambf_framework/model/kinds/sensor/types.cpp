// The types of sensors that are simulated.
#include <algorithm>
#include <array>

#include "model/kinds/sensor.h"

namespace ambf::model {

const SensorType* sensor_type(state::SensorType type) {
  static const std::array kTypes{proximity_sensor_type(), range_sensor_type(), resistance_sensor_type(),
                                 contact_sensor_type(),   imu_sensor_type(),   force_torque_sensor_type()};
  const auto found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const SensorType& row) { return row.type == type; });
  return found == kTypes.end() ? nullptr : &*found;
}

}  // namespace ambf::model
