// Blades: when they cut, and what is reported once of what they cannot.
#include "model/kinds/actuator/detail/live_actuator.h"
#include "model/kinds/sensor.h"
#include "model/kinds/soft_body.h"
#include "physics/tissue.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"

namespace ambf::model {
namespace {

using state::Trigger;

bool wanted(const LiveWorld::Impl& live, std::uint32_t slot, LiveActuator& actuator) {
  intent_of(live, slot, actuator);  // for the jaw
  if (actuator.commanded) return actuator.wanted.actuate;
  const state::ActuatorInfo& info = state::actuators(*live.structure)[slot];
  switch (info.trigger) {
    case Trigger::command: break;
    case Trigger::contact: return true;
    case Trigger::jaw: return actuator.closed;
    case Trigger::sensor: {
      if (info.sensor_object == state::kNone) return false;
      const auto& hits = sensor_at(live, live.structure->objects[info.sensor_object].slot).hits;
      return std::any_of(hits.begin(), hits.end(), [](const ElementHit& hit) { return hit.soft != nullptr; });
    }
  }
  return false;
}

void report(LiveWorld::Impl& live, LiveActuator& actuator) {
  const auto count = static_cast<std::uint32_t>(state::soft_bodies(*live.structure).size());
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    const physics::SoftBody& body = soft_body_at(live, slot);
    if (body.is_thread()) continue;  // no element that a blade could divide
    const auto* tissue = body.is_tissue() ? static_cast<const physics::Tissue*>(&body) : nullptr;
    if (tissue != nullptr && tissue->can_be_cut()) {
      if (tissue->full() && !actuator.full_reported && live.report_soft_body(slot, CutReport::Of::full))
        actuator.full_reported = true;
    } else if (!actuator.uncuttable_reported) {
      live.report_soft_body(slot, CutReport::Of::uncuttable);
    }
  }
  actuator.uncuttable_reported = true;
}

}  // namespace

void cut(LiveWorld::Impl& live, std::uint32_t slot, physics::Body* holder, LiveActuator& actuator) {
  const bool cuts = wanted(live, slot, actuator) && holder != nullptr;
  if (cuts != (actuator.blade->holder() != nullptr) || actuator.blade->holder() != holder)
    actuator.blade->use(cuts ? holder : nullptr);
  if (cuts) report(live, actuator);
}

}  // namespace ambf::model
