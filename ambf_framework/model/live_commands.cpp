#include "model/detail/live_commands.h"

#include <algorithm>
#include <tuple>

#include "base/clock.h"
#include "inputs/physics_records.h"
#include "inputs/recorder.h"
#include "math/rotation.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "state/kind_rows.h"

namespace ambf::model {
namespace {

using state::CartesianCommandType;
using state::JointCommandType;

// Steps add up to the watchdog's period exactly; rounding must not decide whether the last of them still counts (a
// restored world has the same ages on another clock).
constexpr double kRounding_s = 1e-6;

// Who commands: clients over ROS, by messages or with Step requests, are one master, and so are the windows' users, by
// mouse or panel.
state::Source master_of(state::Source source) {
  if (source == state::Source::step_service) return state::Source::ros;
  return source == state::Source::panel ? state::Source::pointer : source;
}

}  // namespace

void LiveCommands::reserve(std::size_t objects) {
  news_.reserve(objects + 64);  // more at once are taken in several goes
}

LiveCommands::LiveCommands(CommandTable& table, LiveWorld::Impl& live)
    : table_(table), live_(live), tables_(live.tables) {
  recorded_bytes_.reserve(4096);
}

CommandSlots* LiveCommands::slots(ObjectRef object) const { return tables_.at(object).slots.get(); }

bool LiveCommands::any_in_force(ObjectRef object) const {
  const CommandSlots* all = slots(object);
  bool any = false;
  all->each([&](int, const CommandSlot& slot) { any |= slot.in_force; });
  return any;
}

bool LiveCommands::take(const state::Structure& structure, double watchdog_s) {
  watchdog_now_s_ = watchdog_s;
  changed_ = false;

  table_.drain([&](std::size_t index) {
    if (index < tables_.by_index.size()) look_at(structure, tables_.by_index[index]);
  });
  take_news(structure);

  // Expiry. Objects drop out of the list while we go through it, so from the back.
  for (std::size_t i = tables_.commanded.size(); i-- > 0;) {
    const ObjectRef object = tables_.commanded[i];
    bool ended = false;
    const CommandSlots* all = slots(object);
    all->each([&](int, CommandSlot& slot) {
      if (!slot.in_force) return;
      const bool lasting = slot.lasting.load(std::memory_order_acquire);
      if (lasting) slot.since_s = watchdog_now_s_;
      if (record_ != nullptr && lasting != slot.seen_lasting)
        record_->add(inputs::CommandLastingRecord{all->object(), slot.source, lasting});
      slot.seen_lasting = lasting;
      if (watchdog_now_s_ - slot.since_s <= table_.watchdog_s() + kRounding_s) return;
      expire(structure, object, slot);
      ended |= !slot.in_force;
    });
    if (ended) merge(object);
  }
  return changed_;
}

void LiveCommands::look_at_all(const state::Structure& structure) {
  for (const ObjectRef object : tables_.by_index) look_at(structure, object);
  take_news(structure);
}

// A held pose stays in force, with the slot that commanded it; of its joints only held ones keep their targets.
void LiveCommands::expire(const state::Structure& structure, ObjectRef object, CommandSlot& slot) {
  if (slot.held) return;
  ++slot.expired;
  const bool hold = tables_.at(object).hold;
  const auto* command = std::get_if<state::RigidBodyCommand>(&slot.command());
  slot.held = hold && command != nullptr && command->type == CartesianCommandType::position;
  slot.in_force = slot.held;
  slot.from_snapshot &= slot.held;
  slot.give_up_waiting();
  end_joints(structure, slot, /*expired=*/true, hold);
}

bool LiveCommands::is_excluded(ObjectRef object, const CommandSlot& slot) const {
  const Kind& kind = kind_of(object.kind);
  bool excluded = false;
  slots(object)->each([&](int, const CommandSlot& other) {
    excluded |=
        other.in_force && master_of(other.source) != master_of(slot.source) && kind.excludes_others(other.command());
  });
  return excluded;
}

// News are gathered first and then taken in the order in which they were written.
void LiveCommands::look_at(const state::Structure& structure, ObjectRef object) {
  CommandSlots* all = object.slot == state::kNone ? nullptr : slots(object);
  if (all == nullptr) return;
  if (all->refused() > 0) note(object, *all);
  all->each([&](int, CommandSlot& slot) {
    const bool fresh = slot.latest.refresh();
    const std::uint64_t releases = slot.latest.releases();
    const bool released_again = releases != slot.seen_releases;
    slot.seen_releases = releases;
    if (slot.latest.sequence() == 0 && !slot.from_snapshot) return;  // bound, never posted
    const std::int64_t time_ns = slot.latest.time_ns();
    if (fresh) {
      slot.from_snapshot = false;
      slot.give_up_waiting();
      const std::uint64_t came = slot.latest.sequence() - slot.seen_sequence;
      slot.seen_sequence = slot.latest.sequence();
      slot.received += came;
      slot.coalesced += came - 1;
      slot.waiting = true;
      note(object, *all);
      if (record_ != nullptr) note_command(*all, slot, time_ns);
    }
    slot.held &= !fresh;
    // A restored command is not what was posted last: only a release after the restore ends it.
    if (slot.from_snapshot ? released_again : slot.latest.released()) {
      if (record_ != nullptr && (fresh || slot.in_force))
        record_->add(inputs::CommandEndedRecord{all->object(), slot.source});
      if (slot.in_force) {
        end(structure, slot);
        merge(object);
      }
      slot.give_up_waiting();
    } else if (fresh) {
      if (news_.size() == news_.capacity()) take_news(structure);
      news_.push_back({object, &slot, time_ns});
    } else if (slot.in_force && time_ns != slot.seen_ns) {
      slot.since_s = watchdog_now_s_;  // kept alive
      if (record_ != nullptr) record_->add(inputs::CommandKeptRecord{all->object(), slot.source, time_ns});
    }
    slot.seen_ns = time_ns;
  });
}

void LiveCommands::take_news(const state::Structure& structure) {
  std::sort(news_.begin(), news_.end(), [](const News& a, const News& b) {
    return std::tie(a.time_ns, a.object.kind, a.object.slot) < std::tie(b.time_ns, b.object.kind, b.object.slot);
  });
  for (const News& news : news_) {
    if (is_excluded(news.object, *news.slot)) {
      end(structure, *news.slot);
      merge(news.object);
      continue;
    }
    news.slot->in_force = true;
    news.slot->order = ++last_order_;
    news.slot->since_s = watchdog_now_s_;
    const Kind& kind = kind_of(news.object.kind);
    const bool some_frozen = live_.physics->frozen_count() > 0;
    if (kind.info().has_mass) {
      if (some_frozen) release_frozen(structure, news.object, *news.slot);
      apply_joints(structure, news.object, *news.slot);
    } else if (some_frozen) {
      kind.release_frozen(live_, news.object.slot, news.slot->command());
    }
    merge(news.object);
    if (kind.obeys_in_step()) {
      some_wait_ = true;
    } else {
      news.slot->obeyed(base::steady_ns());
    }
  }
  news_.clear();
}

void LiveCommands::note(ObjectRef object, CommandSlots& slots) {
  if (slots.noted) return;
  slots.noted = true;
  tables_.noted.push_back(object);
}

// Within joints the newest post wins: nothing that is in force can be newer than this one.
void LiveCommands::apply_joints(const state::Structure& structure, ObjectRef object, CommandSlot& slot) {
  const auto& entries = std::get<state::RigidBodyCommand>(slot.command()).joints;
  const auto& joints = structure.bodies[object.slot].joints;
  const std::size_t count = std::min(entries.size(), joints.size());
  slot.beyond += entries.size() > joints.size() ? 1 : 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (entries[i].type == JointCommandType::none) continue;
    LiveJoint& joint = tables_.joints()[joints[i]];
    if (joint.joint->frozen()) continue;
    if (entries[i].type != joint.order.type) joint.controller.reset();
    joint.order = {entries[i].type, entries[i].value, &slot};
  }
}

void LiveCommands::end(const state::Structure& structure, CommandSlot& ended) {
  ended.in_force = ended.from_snapshot = ended.held = false;
  ended.give_up_waiting();
  end_joints(structure, ended, /*expired=*/false, /*hold=*/false);
}

// The joints that the slot led go to the newest other slot that commands them, else to their held target, else to
// effort 0.
void LiveCommands::end_joints(const state::Structure& structure, const CommandSlot& ended, bool expired, bool hold) {
  const TypedTable<LiveJoint> all_joints = tables_.joints();
  for (std::uint32_t number = 0; number < all_joints.size(); ++number) {
    LiveJoint& joint = all_joints[number];
    if (joint.order.led != &ended) continue;
    JointOrder next{JointCommandType::effort, 0.0, nullptr};
    for (const ObjectRef object : tables_.commanded) {
      if (!state::info_of(object.kind).has_mass) continue;
      const auto& joints = structure.bodies[object.slot].joints;
      const auto place = std::find(joints.begin(), joints.end(), number);
      if (place == joints.end()) continue;
      const auto entry = static_cast<std::size_t>(place - joints.begin());
      const CommandSlots* all = slots(object);
      all->each([&](int, CommandSlot& slot) {
        if (&slot == &ended || !slot.in_force || slot.held || (next.led != nullptr && slot.order < next.led->order))
          return;
        const auto& entries = std::get<state::RigidBodyCommand>(slot.command()).joints;
        if (entry >= entries.size() || entries[entry].type == JointCommandType::none) return;
        next = {entries[entry].type, entries[entry].value, &slot};
      });
    }
    if (next.led == nullptr && expired && (hold || joint.hold) && joint.order.type == JointCommandType::position) {
      joint.order.led = nullptr;
      continue;
    }
    joint.order = next;
    joint.controller.reset();
  }
}

void LiveCommands::merge(ObjectRef object) {
  CommandSlots* all = slots(object);
  const bool active = any_in_force(object);
  bool& flag = tables_.at(object).active;
  if (active != flag) {
    flag = active;
    changed_ = true;
    auto& commanded = tables_.commanded;
    const auto same = [&](const ObjectRef& other) { return other.kind == object.kind && other.slot == object.slot; };
    if (active) {
      commanded.push_back(object);
    } else {
      commanded.erase(std::find_if(commanded.begin(), commanded.end(), same));
    }
  }

  if (kind_of(object.kind).merge(live_, object.slot, *all)) changed_ = true;
}

CommandSlot* LiveCommands::leading_slot(std::uint64_t order) const {
  CommandSlot* leading = nullptr;
  for (const ObjectRef object : tables_.commanded)
    slots(object)->each([&](int, CommandSlot& slot) {
      if (slot.in_force && slot.order == order) leading = &slot;
    });
  return leading;
}

void LiveCommands::obey_waiting() {
  if (!some_wait_) return;
  some_wait_ = false;
  const std::int64_t now_ns = base::steady_ns();
  for (const ObjectRef object : tables_.commanded)
    slots(object)->each([&](int, CommandSlot& slot) { slot.obeyed(now_ns); });
}

void LiveCommands::fill(std::size_t noted, const state::Structure& structure, state::CommandState& out) const {
  const ObjectRef ref = tables_.noted[noted];
  const CommandSlots& all = *slots(ref);
  out = {};
  out.object = state::rows_of(ref.kind).object(structure, ref.slot);
  out.refused = all.refused();
  const CommandSlot* last = nullptr;
  all.each([&](int source, const CommandSlot& slot) {
    out.received += slot.received, out.applied += slot.applied, out.coalesced += slot.coalesced;
    out.expired += slot.expired, out.beyond += slot.beyond, out.bounded += slot.bounded;
    if (slot.in_force) out.sources |= state::SourceSet{1} << source;
    if (slot.order == 0) return;  // nothing of it was ever in force
    if (last != nullptr && (last->in_force != slot.in_force ? last->in_force : last->order > slot.order)) return;
    last = &slot;
    out.source = static_cast<state::Source>(source);
  });
  if (last == nullptr) return;
  out.in_force = last->in_force;
  out.received_ns = last->command_received_ns();
  out.applied_ns = last->waiting || last->from_snapshot ? 0 : last->applied_ns;
  out.silent_s = std::max(0.0, watchdog_now_s_ - last->since_s);
  out.period = last->latest.value().period;
  out.delay = last->delays.last();
}

void LiveCommands::end_object(const state::Structure& structure, ObjectRef object) {
  const CommandSlots* all = slots(object);
  if (all == nullptr) return;
  all->each([&](int, CommandSlot& slot) {
    if (slot.in_force) end(structure, slot);
  });
  merge(object);
}

void LiveCommands::end_hold(const state::Structure& structure, ObjectRef object) {
  if (const CommandSlots* all = slots(object); all != nullptr) {
    all->each([&](int, CommandSlot& slot) {
      if (slot.held) end(structure, slot);
    });
    merge(object);
  }
  const TypedTable<LiveJoint> joints = tables_.joints();
  const auto let_go = [&](std::uint32_t number) {
    LiveJoint& joint = joints[number];
    if (joint.order.led != nullptr || joint.order.type != JointCommandType::position) return;
    joint.order = {JointCommandType::effort, 0.0, nullptr};
    joint.controller.reset();
  };
  if (state::info_of(object.kind).connects_bodies) return let_go(object.slot);
  for (const std::uint32_t number : structure.bodies[object.slot].joints) {
    if (!joints[number].hold) let_go(number);
  }
}

}  // namespace ambf::model
