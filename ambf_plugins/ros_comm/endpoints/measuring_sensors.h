// Topics of sensors that measure with more than rays: contact sensors, IMUs, force torque sensors. Private to
// ros_comm. C++17.
#pragma once

#include <memory>
#include <string>

#include "ros_comm/endpoints/endpoint_kinds.h"
#include "state/sensors.h"

namespace ambf::ros_comm {

// Null where the type has no topics beside the pair that all sensors have.
std::unique_ptr<comm::Endpoint> open_measuring_sensor(state::SensorType type, const EndpointParts& parts,
                                                      const state::ObjectInfo& object, const std::string& topic);

}  // namespace ambf::ros_comm
