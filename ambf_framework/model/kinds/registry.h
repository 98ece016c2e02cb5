// The table of kinds, as the model knows them: the built-in ones, and those that plugins and tests append before the
// first world is made (state/kinds.h says when). Read by any thread.
#pragma once

#include <memory>
#include <vector>

#include "state/ids.h"

namespace ambf::model {

class Kind;  // model/kinds/kind.h

// The state side of the kind must be registered already (state/kind_rows.h). Throws std::logic_error when it is not,
// when the kind has a model already, or once the first world was made.
void register_kind(std::unique_ptr<Kind> kind);

const Kind& kind_of(state::ObjectKind number);

// In the order of registration, which is the order in which their objects are loaded, linked, filled and saved.
const std::vector<std::unique_ptr<Kind>>& kinds();

// The built-in ones (model/kinds/*.cpp).
std::unique_ptr<Kind> make_rigid_body_kind();
std::unique_ptr<Kind> make_joint_kind();
std::unique_ptr<Kind> make_camera_kind();
std::unique_ptr<Kind> make_light_kind();
std::unique_ptr<Kind> make_actuator_kind();
std::unique_ptr<Kind> make_ghost_kind();
std::unique_ptr<Kind> make_sensor_kind();
std::unique_ptr<Kind> make_task_kind();
std::unique_ptr<Kind> make_vehicle_kind();

}  // namespace ambf::model
