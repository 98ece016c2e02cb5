#include "model/kinds/held.h"

#include "model/kinds/actuator/detail/live_actuator.h"

namespace ambf::model {

HeldBodies held_by(const LiveWorld::Impl& live, std::uint32_t actuator) {
  const auto& live_actuator = static_cast<const LiveActuator&>(*live.tables.of(state::actuator_kind().kind)[actuator]);
  HeldBodies held;
  held.holder = state::holder_of(*live.structure, state::actuators(*live.structure)[actuator].object);
  for (std::size_t i = 0; i < live_actuator.used; ++i)
    if (const physics::Grasp& grasp = *live_actuator.grasps[i]; grasp.holds())
      held.bodies[held.count++] = grasp.held()->user_index();
  return held;
}

}  // namespace ambf::model
