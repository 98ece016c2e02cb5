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

void RequestScope::restored() {
  loop_.control().recover();
  loop_.mark_changed();
}

}  // namespace ambf::runtime
