#include "model/detail/laws.h"

#include <algorithm>

#include "base/limits.h"
#include "math/rotation.h"
#include "model/detail/command_bounds.h"
#include "model/detail/live_objects.h"

namespace ambf::model {

math::Wrench set_twist(physics::Body& body, const math::Twist& twist) {
  const math::Wrench wrench = body.wrench_of_set_twist(twist);
  body.set_twist(twist);
  return wrench;
}

void Laws::reserve(std::size_t bodies) {
  room_ = bodies + base::kSpareLaws;
  held_.reserve(room_);
  rows_.reserve(room_);
}

bool Laws::hold(LiveBody& body, state::Source source, Law& law) {
  const auto same = std::find_if(held_.begin(), held_.end(),
                                 [&](const Held& held) { return held.body == &body && held.source == source; });
  if (same != held_.end()) {
    same->law = &law;
    return true;
  }
  if (held_.size() >= room_) return false;
  held_.push_back({&body, source, &law});
  return true;
}

void Laws::let_go(const LiveBody& body, state::Source source) {
  std::erase_if(held_, [&](const Held& held) { return held.body == &body && held.source == source; });
}

void Laws::end_of(const LiveBody& body) {
  std::erase_if(held_, [&](const Held& held) { return held.body == &body; });
}

void Laws::act(double h_s, const Cut& cut) {
  for (const Held& held : held_) act(*held.body, held.source, *held.law, h_s, cut);
}

void Laws::act(LiveBody& body, state::Source source, Law& law, double h_s, const Cut& cut) {
  if (body.body->frozen()) return;
  CommandBound bound(body, h_s);
  const math::Wrench wrench_world = bound.wrench(law.act(*body.body, h_s));
  if (bound.cut()) cut(body, source);
  body.body->apply_wrench(wrench_world);
  add_share(body, source, wrench_world);
}

void Laws::forget_shares() {
  rows_.clear();
  lost_ = 0;
  ++step_;
}

void Laws::add_share(LiveBody& body, state::Source source, const math::Wrench& wrench_world) {
  if (body.shares.step != step_) body.shares = {step_, state::kNone};
  std::uint32_t* link = &body.shares.first;
  while (*link != state::kNone && rows_[*link].source < source) link = &rows_[*link].next;
  if (*link != state::kNone && rows_[*link].source == source) {
    rows_[*link].wrench_world.force += wrench_world.force;
    rows_[*link].wrench_world.torque += wrench_world.torque;
    return;
  }
  if (rows_.size() >= room_) {
    ++lost_;
    return;
  }
  const std::uint32_t next = *link;
  *link = static_cast<std::uint32_t>(rows_.size());
  rows_.push_back({source, wrench_world, next});
}

}  // namespace ambf::model
