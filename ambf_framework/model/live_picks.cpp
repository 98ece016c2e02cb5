#include "model/detail/live_picks.h"

#include "inputs/physics_records.h"
#include "inputs/recorder.h"
#include "physics/soft_body.h"
#include "state/soft_bodies.h"

namespace ambf::model {
namespace {

// A pointer pulls a soft body by no more than this many times its weight.
constexpr double kMaxSoftPull = 10.0, kWeight = 9.81;  // N/kg

// The pose of `body` in which the point it is held by is at `target_world`.
math::Pose moved_to(const physics::Body& body, const math::Vec3& point_body, const math::Vec3& target_world) {
  math::Pose pose = body.pose();
  pose.position += target_world - pose * point_body;
  return pose;
}

// All that joints connect with `first`, as a flag by slot; false when something static is among it.
bool collect_jointed(const state::Structure& structure, const TypedTable<LiveBody>& bodies, std::uint32_t first,
                     std::vector<std::uint8_t>& flags) {
  flags.assign(bodies.size(), 0);
  flags[first] = 1;
  for (bool grown = true; grown;) {
    grown = false;
    for (const state::JointInfo& joint : structure.joints) {
      if (flags[joint.parent_body] == flags[joint.child_body]) continue;
      const std::uint32_t other = flags[joint.parent_body] != 0 ? joint.child_body : joint.parent_body;
      if (bodies[other].body->is_static()) return false;
      flags[other] = 1;
      grown = true;
    }
  }
  return true;
}

}  // namespace

void LivePicks::hold(std::size_t slot, std::uint64_t press, LiveBody& live, const math::Vec3& point_world) {
  Held& held = held_[slot];
  end(held);
  if (has_ended(slot, press)) return;
  held.body = live.body.get();
  held.press = press;
  held.point_body = math::inverse(held.body->pose()) * point_world;
  held.target_world = point_world;
  held.pull = world_.begin_pull(*held.body, point_world);
}

void LivePicks::hold(std::size_t slot, std::uint64_t press, physics::SoftBody& body, const physics::SoftRayHit& where) {
  Held& held = held_[slot];
  end(held);
  if (has_ended(slot, press)) return;
  physics::SoftGrip& grip = grip_of(held);
  const std::size_t nodes = where.face < 0 ? 1 : 3;
  grip.set_max_force(kMaxSoftPull * kWeight * body.mass() / static_cast<double>(nodes));
  if (where.face < 0) grip.hold_in_world(world_, body, where.node);
  if (where.face >= 0)
    for (const std::uint32_t node : body.faces()[static_cast<std::size_t>(where.face)])
      grip.hold_in_world(world_, body, node);
  if (grip.held().empty()) return;
  held.soft = &body;
  held.press = press;
  held.target_world = where.point;
}

bool LivePicks::take(const state::Structure& structure, const TypedTable<LiveBody>& bodies, bool still) {
  bool changed = false;
  for (std::size_t slot = 0; slot < held_.size(); ++slot) {
    Held& held = held_[slot];
    if (held.soft != nullptr && grip_of(held).held().empty()) {  // it was removed, reset or frozen
      held = {};
      changed = true;
    }
    if (held.body == nullptr && held.soft == nullptr) continue;
    PickSlot& port = table_[slot];
    if (has_ended(slot, held.press)) {
      end(held);
      changed = true;
      continue;
    }
    held.pulls = held.pulls || !still;
    if (!port.target.refresh() || port.target.value().press != held.press) continue;
    changed = true;
    if (held.soft != nullptr) grip_of(held).shift(port.target.value().point_world - held.target_world);
    held.target_world = port.target.value().point_world;
    if (record_ != nullptr)
      record_->add(inputs::PickTargetRecord{static_cast<std::uint32_t>(slot), held.press, held.target_world});
    if (held.pull >= 0) world_.move_pull(held.pull, held.target_world);
    if (held.soft != nullptr) continue;  // while the world stands still, its springs wait
    if (still) {
      move_still(held, structure, bodies);
    } else if (held.body->is_static()) {
      held.body->move_to(moved_to(*held.body, held.point_body, held.target_world));
    }
  }
  return changed;
}

bool LivePicks::has_ended(std::size_t slot, std::uint64_t press) const {
  const bool ended = table_[slot].ended.load(std::memory_order_acquire) >= press;
  if (ended && record_ != nullptr) record_->add(inputs::PickEndedRecord{static_cast<std::uint32_t>(slot), press});
  return ended;
}

void LivePicks::move_still(Held& held, const state::Structure& structure, const TypedTable<LiveBody>& bodies) {
  held.pulls = false;
  if (held.body->is_static()) {
    held.body->set_pose(moved_to(*held.body, held.point_body, held.target_world));
    return;
  }
  if (!collect_jointed(structure, bodies, held.body->user_index(), moving_along_)) return;
  const math::Vec3 way = held.target_world - held.body->pose() * held.point_body;
  for (std::size_t slot = 0; slot < bodies.size(); ++slot) {
    if (moving_along_[slot] == 0) continue;
    math::Pose pose = bodies[slot].body->pose();
    pose.position += way;
    bodies[slot].body->set_pose(pose);
  }
}

void LivePicks::report(Laws& laws, const TypedTable<LiveBody>& bodies) const {
  for (const Held& held : held_)
    if (held.pull >= 0)
      laws.add_share(bodies[held.body->user_index()], state::Source::pointer, world_.pull_wrench(held.pull));
}

void LivePicks::end(Held& held) {
  if (held.pull >= 0) world_.end_pull(held.pull);
  grip_of(held).release();
  held = {};
}

void LivePicks::end_of(const physics::Body& body) {
  for (Held& held : held_)
    if (held.body == &body) end(held);
}

void LivePicks::end_all() {
  for (Held& held : held_) end(held);
}

void LivePicks::fill(state::Frame& frame) const {
  std::vector<state::PickState>& picks = frame.picks;
  std::vector<state::SoftPick>& soft_picks = state::soft_picks(frame);
  picks.clear();
  soft_picks.clear();
  for (std::size_t slot = 0; slot < held_.size(); ++slot) {
    const Held& held = held_[slot];
    if (const auto nodes = grips_[slot].held(); held.soft != nullptr && !nodes.empty()) {
      state::SoftPick pick{static_cast<std::uint32_t>(slot), held.soft->user_index(), {}, held.target_world, {}};
      for (const physics::HeldNode& each : nodes) {
        pick.point_world += each.body->position(each.node) / static_cast<double>(nodes.size());
        pick.force_world += each.force_world;
      }
      soft_picks.push_back(pick);
    }
    if (held.body == nullptr) continue;
    const math::Vec3 force = held.pull >= 0 && held.pulls ? world_.pull_wrench(held.pull).force : math::Vec3{};
    picks.push_back(
        {static_cast<std::uint32_t>(slot), held.body->user_index(), held.point_body, held.target_world, force});
  }
}

}  // namespace ambf::model
