// What makes an actuator hold: a command, its sensor, or its sensor while a jaw is closed.
#include "model/kinds/actuator/detail/live_actuator.h"
#include "model/kinds/sensor.h"
#include "physics/soft_body.h"

namespace ambf::model {
namespace {

using state::Trigger;

// EQUATIONS 16: a jaw lets go that much wider open than it grasps, so that it does not flutter at one opening.
constexpr double kHysteresis = 0.05;

std::uint32_t slot_of(const LiveWorld::Impl& live, std::uint32_t object) {
  return object == state::kNone ? state::kNone : live.structure->objects[object].slot;
}

// Whether the sensor still senses anything that the actuator holds.
bool senses_held(const LiveWorld::Impl& live, std::uint32_t sensor, const LiveActuator& actuator) {
  for (std::size_t i = 0; i < actuator.used; ++i)
    if (actuator.grasps[i]->holds() && senses(live, sensor, *actuator.grasps[i]->held())) return true;
  if (actuator.soft == nullptr) return false;
  const std::vector<ElementHit>& hits = sensor_at(live, sensor).hits;
  return std::any_of(hits.begin(), hits.end(), [&](const ElementHit& hit) {
    return hit.soft != nullptr && actuator.soft->holds_any_of(*hit.soft);
  });
}

}  // namespace

double jaw_opening(const LiveWorld::Impl& live, std::uint32_t body_slot) {
  double sum = 0.0;
  int count = 0;
  for (const std::uint32_t number : live.structure->bodies[body_slot].joints) {
    const physics::Joint& joint = *live.tables.joints()[number].joint;
    const auto& limits = joint.limits();
    if (!joint.has_coordinate() || !limits || !((*limits)[1] > (*limits)[0])) continue;
    sum += std::clamp((joint.position() - (*limits)[0]) / ((*limits)[1] - (*limits)[0]), 0.0, 1.0);
    ++count;
  }
  return count == 0 ? -1.0 : sum / count;
}

bool senses(const LiveWorld::Impl& live, std::uint32_t sensor, const physics::Body& body) {
  const std::vector<ElementHit>& hits = sensor_at(live, sensor).hits;
  return std::any_of(hits.begin(), hits.end(), [&](const ElementHit& hit) { return hit.body == &body; });
}

void list_sensed(const LiveWorld::Impl& live, std::uint32_t sensor, const physics::Body& holder, BodyList& out) {
  for (const ElementHit& hit : sensor_at(live, sensor).hits)
    if (hit.body != nullptr && hit.body != &holder) out.add(*hit.body);
}

Intent intent_of(const LiveWorld::Impl& live, std::uint32_t slot, LiveActuator& actuator) {
  const state::ActuatorInfo& info = state::actuators(*live.structure)[slot];
  const std::uint32_t own_sensor = slot_of(live, info.sensor_object);
  if (info.jaw_body != state::kNone) {
    const double opening = jaw_opening(live, info.jaw_body);
    if (opening < 0.0 || opening > actuator.below + kHysteresis) actuator.closed = false;
    if (opening >= 0.0 && opening < actuator.below) actuator.closed = true;
  }
  if (actuator.commanded) {
    const state::ActuatorCommand& wanted = actuator.wanted;
    if (!wanted.actuate || !wanted.use_sensor) return {wanted.actuate, wanted.actuate, state::kNone};
    std::uint32_t sensor = own_sensor;
    if (wanted.sensor.valid()) {  // what a file holds may name anything
      const std::uint32_t object = state::find(*live.structure, wanted.sensor);
      const bool is_sensor =
          object != state::kNone && live.structure->objects[object].kind == state::sensor_kind().kind;
      sensor = is_sensor ? slot_of(live, object) : state::kNone;
    }
    return {true, sensor != state::kNone, sensor};
  }
  if (own_sensor == state::kNone) return {};
  switch (info.trigger) {
    case Trigger::command:
    case Trigger::contact: break;
    case Trigger::sensor: return {senses_held(live, own_sensor, actuator), true, own_sensor};
    case Trigger::jaw: return {actuator.closed, actuator.closed, own_sensor};
  }
  return {};
}

}  // namespace ambf::model
