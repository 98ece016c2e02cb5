#include "model/kinds/sensor/detail/judgement.h"

#include "physics/soft_body.h"
#include "state/soft_bodies.h"

namespace ambf::model {
namespace {

using What = state::SensorEvent::What;

std::uint32_t count(const LiveWorld::Impl& live) {
  return static_cast<std::uint32_t>(live.tables.of(state::sensor_kind().kind).size());
}

state::ObjectId id_of(const LiveWorld::Impl& live, const physics::Body& body) {
  return live.structure->objects[live.structure->bodies[body.user_index()].object].id;
}

// What the first element that senses anything senses; not valid: none does.
state::ObjectId first_sensed(const LiveWorld::Impl& live, const LiveSensor& sensor) {
  for (const ElementHit& hit : sensor.hits) {
    if (hit.body != nullptr) return id_of(live, *hit.body);
    if (hit.soft == nullptr) continue;
    return live.structure->objects[state::soft_bodies(*live.structure)[hit.soft->user_index()].object].id;
  }
  return {};
}

bool senses(const LiveSensor& sensor, const physics::Body* body) {
  for (const ElementHit& hit : sensor.hits)
    if (hit.body != nullptr && hit.body == body) return true;
  return false;
}

// The body of the first sensor of the same key that senses this one's body and is sensed itself; null: none.
const physics::Body* partner_of(const LiveWorld::Impl& live, std::uint32_t slot) {
  const LiveSensor& sensor = sensor_at(live, slot);
  if (sensor.key == state::kNone) return nullptr;
  const physics::Body* own = carrier_of(live, slot);
  for (std::uint32_t other = 0; other < count(live); ++other) {
    if (other == slot || sensor_at(live, other).key != sensor.key) continue;
    const physics::Body* body = carrier_of(live, other);
    if (senses(sensor, body) && senses(sensor_at(live, other), own)) return body;
  }
  return nullptr;
}

bool holds(state::SuccessWhen when, const Judgement& now) {
  switch (when) {
    case state::SuccessWhen::never: return false;
    case state::SuccessWhen::matched: return now.matched;
    case state::SuccessWhen::present: return now.sensed;
    case state::SuccessWhen::absent: return !now.sensed;
  }
  return false;
}

void log(LiveWorld::Impl& live, std::uint32_t slot, What what, bool begins, const state::ObjectId& object) {
  state::SensorEventLog& events = *live.sensor_events;
  state::SensorEvent& event = events.last[events.total++ % state::SensorEventLog::kSize];
  event.sensor = live.structure->objects[state::sensors(*live.structure)[slot].object].id;
  event.object = object;
  event.sim_step = static_cast<std::uint32_t>(live.steps);
  event.sim_time = live.sim_time;
  event.what = what;
  event.begins = begins;
}

}  // namespace

void number_keys(const LiveWorld::Impl& live) {
  const auto& infos = state::sensors(*live.structure);
  for (std::uint32_t slot = 0; slot < infos.size(); ++slot) {
    std::uint32_t first = 0;
    while (infos[first].matching_key != infos[slot].matching_key) ++first;
    sensor_at(live, slot).key = infos[slot].matching_key.empty() ? state::kNone : first;
  }
}

// What ends is logged before what begins: another object in its place is two events.
void set_judgement(LiveWorld::Impl& live, std::uint32_t slot, const Judgement& now) {
  Judgement& before = sensor_at(live, slot).judgement;
  const auto edge = [&](What what, bool was, bool is, const state::ObjectId& old_object,
                        const state::ObjectId& object) {
    const bool same = was == is && (!is || old_object == object);
    if (same) return;
    if (was) log(live, slot, what, false, old_object);
    if (is) log(live, slot, what, true, object);
  };
  edge(What::sensed, before.sensed, now.sensed, before.sensed_object, now.sensed_object);
  edge(What::matched, before.matched, now.matched, before.partner, now.partner);
  if (before.success != now.success) {
    const Judgement& of = now.success ? now : before;
    log(live, slot, What::success, now.success, of.matched ? of.partner : of.sensed_object);
  }
  before = now;
}

void judge_sensors(LiveWorld::Impl& live, std::uint64_t steps) {
  const auto& infos = state::sensors(*live.structure);
  const double h_s = live.physics->options().step;
  for (std::uint32_t slot = 0; slot < infos.size(); ++slot) {
    if (!infos[slot].is_judged()) continue;
    const LiveSensor& sensor = sensor_at(live, slot);
    Judgement now;
    now.sensed_object = first_sensed(live, sensor);
    now.sensed = now.sensed_object.valid();
    if (const physics::Body* body = partner_of(live, slot)) {
      now.matched = true;
      now.partner = id_of(live, *body);
    }
    if (holds(infos[slot].success_when, now)) {
      now.held_steps = sensor.judgement.held_steps + steps;
      // Half a step: a time in seconds is no whole number of them in binary.
      now.success = (static_cast<double>(now.held_steps) + 0.5) * h_s >= infos[slot].hold_s;
      now.success_since_s = sensor.judgement.success ? sensor.judgement.success_since_s : live.sim_time;
    }
    if (!now.success) now.success_since_s = 0.0;
    set_judgement(live, slot, now);
  }
}

}  // namespace ambf::model
