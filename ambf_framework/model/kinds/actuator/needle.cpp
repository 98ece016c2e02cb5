// Needles: on what they sit, the thread that they draw, and when they tie it.
#include "model/kinds/actuator/detail/live_actuator.h"
#include "model/kinds/soft_body.h"

namespace ambf::model {

physics::Thread* thread_of(const LiveWorld::Impl& live, std::uint32_t slot) {
  const std::uint32_t object = state::actuators(*live.structure)[slot].thread_object;
  if (object == state::kNone) return nullptr;
  physics::SoftBody& body = soft_body_at(live, live.structure->objects[object].slot);
  return body.is_thread() ? static_cast<physics::Thread*>(&body) : nullptr;
}

void sew(LiveWorld::Impl& live, std::uint32_t slot, physics::Body* holder, LiveActuator& actuator) {
  physics::Needle& needle = *actuator.needle;
  needle.use(holder);
  needle.draw(thread_of(live, slot));
  const bool acts = actuator.commanded && actuator.wanted.actuate, ties = acts && !actuator.wanted.use_sensor;
  if (acts && !ties) needle.untie();
  if (ties && !actuator.closed && !needle.tie()) {
    if (needle.stitches() < needle.tied() + 2)
      live.report_needle(slot, CutReport::Of::nothing_to_tie, actuator.untied_reported);
    else
      live.report_needle(slot, CutReport::Of::knots, actuator.knots_reported);
  }
  actuator.closed = ties;
  if (needle.too_many_stitches()) live.report_needle(slot, CutReport::Of::stitches, actuator.stitches_reported);
  if (needle.too_many_holders()) live.report_needle(slot, CutReport::Of::holders, actuator.holders_reported);
}

}  // namespace ambf::model
