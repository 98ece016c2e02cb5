#include "model/kinds/held.h"

#include "model/kinds/actuator/detail/live_actuator.h"

namespace ambf::model {

namespace {

const LiveActuator& actuator_at(const LiveWorld::Impl& live, std::uint32_t slot) {
  return static_cast<const LiveActuator&>(*live.tables.of(state::actuator_kind().kind)[slot]);
}

}  // namespace

HeldBodies held_by(const LiveWorld::Impl& live, std::uint32_t actuator) {
  const LiveActuator& live_actuator = actuator_at(live, actuator);
  HeldBodies held;
  held.holder = state::holder_of(*live.structure, state::actuators(*live.structure)[actuator].object);
  for (std::size_t i = 0; i < live_actuator.used; ++i)
    if (const physics::Grasp& grasp = *live_actuator.grasps[i]; grasp.holds())
      held.bodies[held.count++] = grasp.held()->user_index();
  return held;
}

const physics::Needle* needle_of(const LiveWorld::Impl& live, std::uint32_t actuator) {
  return actuator_at(live, actuator).needle.get();
}

}  // namespace ambf::model
