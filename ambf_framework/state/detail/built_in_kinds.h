// The kinds of the product that are registered as a plugin's are: after the built-in entries of the table, before any
// other. One line each here and in built_in_kinds.cpp.
#pragma once

namespace ambf::state {

// Does nothing from its second call on. First called from a static initializer, so that no two threads race for it.
void register_built_in_kinds();

void register_actuator_kind();
void register_ghost_kind();
void register_sensor_kind();
void register_reading_columns();  // of sensors
void register_soft_body_kind();
void register_task_kind();
void register_vehicle_kind();

}  // namespace ambf::state
