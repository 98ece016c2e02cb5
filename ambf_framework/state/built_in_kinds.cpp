#include "state/detail/built_in_kinds.h"

namespace ambf::state {

void register_built_in_kinds() {
  static bool begun = false;
  if (begun) return;
  begun = true;
  register_ghost_kind();
  register_actuator_kind();
  register_vehicle_kind();
  register_sensor_kind();
  register_reading_columns();
  register_soft_body_kind();
  register_task_kind();  // after sensors and actuators, which it judges by
}

namespace {
const bool kRegistered = [] {
  register_built_in_kinds();
  return true;
}();
}  // namespace

}  // namespace ambf::state
