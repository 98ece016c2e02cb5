#include "model/effectors/effector_table.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "state/kinds.h"

namespace ambf::model {
namespace {

// Beyond these no device of ours works; a saved state holds no more either.
constexpr double kMaxPosition_m = 1e6, kMaxGain = 1e9, kMaxPeriod_s = 10.0;
constexpr double kUnitWithin = 1e-3;

bool within(const math::Vec3& v, double min, double max) {
  const auto inside = [&](double value) { return value >= min && value <= max; };  // false for NaN
  return inside(v.x) && inside(v.y) && inside(v.z);
}

bool acceptable(const state::SetPoint& set_point) {
  const state::EffectorGains& gains = set_point.gains;
  return within(set_point.T_world_ref.position, -kMaxPosition_m, kMaxPosition_m) &&
         std::abs(math::norm(set_point.T_world_ref.orientation) - 1.0) <= kUnitWithin &&
         within(gains.linear_stiffness, 0.0, kMaxGain) && within(gains.linear_damping, 0.0, kMaxGain) &&
         within(gains.angular_stiffness, 0.0, kMaxGain) && within(gains.angular_damping, 0.0, kMaxGain) &&
         set_point.period_s >= 0.0 && set_point.period_s <= kMaxPeriod_s && std::isfinite(set_point.jaw);
}

}  // namespace

class EffectorTable::Port final : public state::EffectorPort {
 public:
  Port(EffectorTable& table, EffectorSlot& slot)
      : table_(table), slot_(slot), hold_(slot.holds), body_(slot.body), source_(slot.source) {}
  ~Port() override {
    let_go();
    table_.give_back(slot_, hold_);
  }

  void post(const state::SetPoint& set_point) override {
    if (acceptable(set_point)) slot_.posted.post({hold_, body_, source_, set_point}, base::steady_ns());
  }
  void let_go() override { slot_.posted.release(); }

 private:
  EffectorTable& table_;
  EffectorSlot& slot_;
  const std::uint64_t hold_;
  const state::ObjectId body_;
  const state::Source source_;
};

std::unique_ptr<state::EffectorPort> EffectorTable::hold(const state::Structure& structure, state::ObjectId body,
                                                         state::Source source) {
  const std::uint32_t object = state::find(structure, body);
  if (object == state::kNone || static_cast<int>(source) >= base::kMaxSources) return nullptr;
  const state::ObjectInfo& info = structure.objects[object];
  if (!state::info_of(info.kind).has_mass || structure.bodies[info.slot].mass == 0.0) return nullptr;

  const std::lock_guard lock(mutex_);
  const auto free = std::find_if(slots_.begin(), slots_.end(), [](const EffectorSlot& slot) { return !slot.taken; });
  if (free == slots_.end()) return nullptr;
  for (EffectorSlot& slot : slots_)
    if (slot.taken && slot.body == body && slot.source == source)
      slot.ended.store(slot.holds, std::memory_order_release);
  free->taken = true;
  ++free->holds;
  free->body = body;
  free->source = source;
  const auto used = static_cast<std::size_t>(free - slots_.begin()) + 1;
  if (used > used_.load(std::memory_order_relaxed)) used_.store(used, std::memory_order_release);
  return std::make_unique<Port>(*this, *free);
}

bool EffectorTable::replay(std::uint32_t slot, const PostedSetPoint& posted) {
  if (slot >= slots_.size() || !acceptable(posted.set_point)) return false;
  slots_[slot].posted.post(posted, base::steady_ns());
  if (slot >= used_.load(std::memory_order_relaxed)) used_.store(slot + 1, std::memory_order_release);
  return true;
}

bool EffectorTable::replay_ended(std::uint32_t slot, std::uint64_t hold, bool released) {
  if (slot >= slots_.size()) return false;
  if (released) {
    slots_[slot].posted.release();
  } else {
    slots_[slot].ended.store(hold, std::memory_order_release);
  }
  return true;
}

void EffectorTable::give_back(EffectorSlot& slot, std::uint64_t hold) {
  const std::lock_guard lock(mutex_);
  slot.ended.store(hold, std::memory_order_release);
  slot.taken = false;
}

}  // namespace ambf::model
