#include "runtime/detail/request_scope.h"

#include "base/clock.h"
#include "inputs/physics_records.h"

namespace ambf::runtime {

void RequestScope::begin_scene_request(std::uint64_t change) {
  loop_.note(inputs::SceneRequestRecord{change, loop_.watch_s()});
}

void RequestScope::set_paused(bool paused) {
  loop_.note(inputs::PauseRecord{paused});
  loop_.control().set_paused(paused, base::steady_ns());
  loop_.mark_changed();
}

void RequestScope::reset_world() {
  loop_.note(inputs::ResetRecord{inputs::ResetOf::world, {}});
  world().reset();
  restored();
}

void RequestScope::reset_bodies() {
  loop_.note(inputs::ResetRecord{inputs::ResetOf::bodies, {}});
  world().reset_bodies();
  restored();
}

void RequestScope::reset_bodies(const std::vector<state::ObjectId>& bodies) {
  loop_.note(inputs::ResetRef{inputs::ResetOf::some_bodies, bodies});
  world().reset_bodies(bodies);
  restored();
}

void RequestScope::set_speed(double factor) {
  loop_.keeper().set_speed(factor, base::steady_ns());
  loop_.mark_changed();
}

state::Outcome RequestScope::set_parameter(state::ObjectId object, state::Parameter parameter,
                                           const math::Vec3& value) {
  loop_.note(inputs::ParameterRecord{object, parameter, value});
  state::Outcome outcome;
  const std::optional<math::Vec3> now = world().set_parameter(object, parameter, value);
  outcome.success = now.has_value();
  if (!now) {
    outcome.message = "the object is gone or has no such parameter";
  } else if (state::info_of(parameter).per_axis ? !(*now == value) : now->x != value.x) {
    outcome.message = "cut to what is stable";
  }
  return outcome;
}

state::Outcome RequestScope::push(state::ObjectId body, const state::Push& push) {
  loop_.note(inputs::PushRecord{body, push});
  state::Outcome outcome;
  outcome.success = world().push(body, push);
  if (!outcome.success) outcome.message = "the body is gone or does not move";
  return outcome;
}

void RequestScope::set_gravity(const math::Vec3& gravity_world) {
  loop_.note(inputs::GravityRecord{gravity_world});
  world().set_gravity(gravity_world);
}

bool RequestScope::set_hold(state::ObjectId object, bool hold) {
  loop_.note(inputs::HoldRecord{object, hold});
  return world().set_hold(object, hold);
}

void RequestScope::set_lens(state::ObjectId camera, const state::Lens& lens) {
  loop_.note(inputs::LensRecord{camera, lens});
  world().set_lens(camera, lens);
}

void RequestScope::set_beam(state::ObjectId light, const state::Beam& beam) {
  loop_.note(inputs::BeamRecord{light, beam});
  world().set_beam(light, beam);
}

bool RequestScope::pick(std::size_t slot, std::uint64_t press, const math::Vec3& from_world, const math::Vec3& to_world,
                        state::PickHit& hit) {
  loop_.note(inputs::PickRecord{static_cast<std::uint32_t>(slot), press, from_world, to_world});
  return world().pick(slot, press, from_world, to_world, hit);
}

void RequestScope::restored() {
  loop_.control().recover();
  loop_.mark_changed();
}

}  // namespace ambf::runtime
