#include "ros_comm/endpoints/endpoint_kinds.h"

#include <algorithm>

#include "state/actuators.h"
#include "state/ghosts.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"
#include "state/tasks.h"
#include "state/vehicles.h"

namespace ambf::ros_comm {

namespace {

std::vector<RegisteredEndpointKind>& table() {
  static std::vector<RegisteredEndpointKind> entries{
      {state::ObjectKind::rigid_body, body_endpoint_kind()},
      {state::ObjectKind::camera, camera_endpoint_kind()},
      {state::ObjectKind::light, light_endpoint_kind()},
      {state::actuator_kind().kind, actuator_endpoint_kind()},
      {state::sensor_kind().kind, sensor_endpoint_kind()},
      {state::vehicle_kind().kind, vehicle_endpoint_kind()},
      {state::ObjectKind::joint, joint_endpoint_kind()},
      {state::ghost_kind().kind, ghost_endpoint_kind()},
      {state::soft_body_kind().kind, soft_body_endpoint_kind()},
      {state::task_kind().kind, task_endpoint_kind()},
  };
  return entries;
}

std::vector<RegisteredEndpointKind>::iterator find_entry(state::ObjectKind kind) {
  return std::find_if(table().begin(), table().end(), [kind](const auto& each) { return each.kind == kind; });
}

}  // namespace

void add_endpoint_kind(state::ObjectKind kind, const EndpointKind& entry) {
  const auto found = find_entry(kind);
  if (found == table().end()) {
    table().push_back({kind, entry});
  } else {
    found->entry = entry;
  }
}

const EndpointKind* endpoint_kind(state::ObjectKind kind) {
  const auto found = find_entry(kind);
  return found == table().end() ? nullptr : &found->entry;
}

const std::vector<RegisteredEndpointKind>& endpoint_kinds() { return table(); }

}  // namespace ambf::ros_comm
