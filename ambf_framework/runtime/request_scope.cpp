#include "runtime/detail/request_scope.h"

#include "base/clock.h"

namespace ambf::runtime {

void RequestScope::set_paused(bool paused) {
  loop_.control().set_paused(paused, base::steady_ns());
  loop_.mark_changed();
}

void RequestScope::reset_world() {
  world().reset();
  restored();
}

void RequestScope::reset_bodies() {
  world().reset_bodies();
  restored();
}

void RequestScope::reset_bodies(const std::vector<state::ObjectId>& bodies) {
  world().reset_bodies(bodies);
  restored();
}

void RequestScope::set_speed(double factor) {
  loop_.keeper().set_speed(factor, base::steady_ns());
  loop_.mark_changed();
}

state::Outcome RequestScope::set_parameter(state::ObjectId object, state::Parameter parameter,
                                           const math::Vec3& value) {
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
  state::Outcome outcome;
  outcome.success = world().push(body, push);
  if (!outcome.success) outcome.message = "the body is gone or does not move";
  return outcome;
}

void RequestScope::restored() {
  loop_.control().recover();
  loop_.mark_changed();
}

}  // namespace ambf::runtime
