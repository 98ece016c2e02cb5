#include "runtime/detail/throttle.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace ambf::runtime {

void Throttle::on_command(const state::WorldCommand& command) {
  Client& sender = client(command.client);
  const bool toggled = command.step_clock != sender.clock;
  sender.clock = command.step_clock;
  skip_steps_ = command.n_skip_steps;
  if (!command.enable_step_throttling) {
    release();
    return;
  }
  engaged_ = true;
  if (toggled) add_toggle(command.n_skip_steps);
}

void Throttle::on_silence() {
  if (release_when_silent_) release();
}

void Throttle::release() {
  engaged_ = in_work_ = false;
  grant_count_ = 0;
}

Throttle::Client& Throttle::client(std::uint64_t id) {
  ++messages_;
  Client* longest_silent = &clients_[0];
  for (Client& known : clients_) {
    if (known.last_seen != 0 && known.id == id) {
      known.last_seen = messages_;
      return known;
    }
    if (known.last_seen < longest_silent->last_seen) longest_silent = &known;
  }
  *longest_silent = {id, messages_, false};
  return *longest_silent;
}

void Throttle::add_toggle(unsigned steps) {
  ++received_;
  if (grant_count_ > 0) {
    Grant& last = grants_[(first_grant_ + grant_count_ - 1) % kGrants];
    if (last.steps == last.toggles * steps || grant_count_ == kGrants) {
      ++last.toggles;
      last.steps += steps;
      return;
    }
  }
  grants_[(first_grant_ + grant_count_++) % kGrants] = {1, steps};
}

std::uint64_t Throttle::steps_of_next() const {
  const Grant& grant = grants_[first_grant_];
  return grant.steps / grant.toggles;  // the last toggle of an entry gets what is left
}

unsigned Throttle::steps_left() const {
  const std::uint64_t left = in_work_ ? left_ : grant_count_ > 0 ? steps_of_next() : 0;
  return static_cast<unsigned>(std::min<std::uint64_t>(left, std::numeric_limits<unsigned>::max()));
}

bool Throttle::steps_done(unsigned steps) {
  if (!toggle_waiting()) {
    assert(steps == 0);
    return false;
  }
  if (!in_work_) {
    left_ = steps_of_next();
    in_work_ = true;
    Grant& grant = grants_[first_grant_];
    grant.steps -= left_;
    if (--grant.toggles == 0) {
      first_grant_ = (first_grant_ + 1) % kGrants;
      --grant_count_;
    }
  }
  assert(steps <= left_);
  left_ -= std::min<std::uint64_t>(steps, left_);
  if (left_ > 0) return false;
  in_work_ = false;
  ++finished_;
  return true;
}

}  // namespace ambf::runtime
