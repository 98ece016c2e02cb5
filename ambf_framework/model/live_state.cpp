// LiveWorld::save and restore: between live objects and a SavedState.
#include <cassert>

#include "model/detail/live_impl.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "model/live_world.h"
#include "model/saved_state.h"

namespace ambf::model {
namespace {

std::vector<SavedCommand> commands_of(const CommandSlots& slots, double now_s) {
  std::vector<SavedCommand> commands;
  slots.each([&](int source, const CommandSlot& slot) {
    if (slot.in_force) commands.push_back({source, slot.order, now_s - slot.since_s, slot.command()});
  });
  return commands;
}

}  // namespace

std::vector<std::uint8_t> LiveWorld::save() {
  Impl& live = *impl_;
  SavedState saved;
  live.physics->save_state(saved.physics);
  saved.steps = live.steps;
  saved.sim_time = live.sim_time;
  saved.last_order = live.commands.last_order();
  const double now_s = live.commands.watchdog_now_s();
  saved.objects.resize(state::kind_count());
  for (const auto& kind : kinds()) {
    const LiveTable& table = live.tables.of(kind->number());
    for (std::uint32_t slot = 0; slot < table.size(); ++slot) {
      auto object = kind->make_saved();
      kind->save(live, slot, *object);
      if (table[slot]->slots != nullptr) object->commands = commands_of(*table[slot]->slots, now_s);
      saved.objects[static_cast<std::size_t>(kind->number())].push_back(std::move(object));
    }
  }
  saved.effectors = live.effectors.save();
  live.changed = true;
  return encode(saved, *live.structure);
}

std::string LiveWorld::restore(const std::vector<std::uint8_t>& bytes) {
  SavedState saved;
  std::string wrong = decode(bytes, *impl_->structure, impl_->physics->options().step, saved);
  if (wrong.empty() && !parent_changes(saved, *impl_->structure).empty()) wrong = "objects hang elsewhere";
  if (wrong.empty()) restore(saved);
  return wrong;
}

// Nothing here can fail: decode() has checked everything.
void LiveWorld::restore(const SavedState& saved) {
  Impl& live = *impl_;
  [[maybe_unused]] const bool fits = live.physics->restore_state(saved.physics);
  assert(fits);
  live.picks.end_all();
  live.effectors.end_all();
  live.commands.forget_all();
  live.laws.forget_shares();
  const double now_s = live.commands.watchdog_now_s();
  const auto put_in_force = [&](ObjectRef object, const std::vector<SavedCommand>& commands) {
    for (const SavedCommand& each : commands) {
      CommandSlot& slot = live.commands.slots(object)->find_or_make(each.source);
      slot.in_force = slot.from_snapshot = true;
      slot.order = each.order;
      slot.since_s = now_s - each.age_s;
      slot.restored = each.command;
    }
    if (!commands.empty()) live.commands.merge(object);
  };
  live.steps = saved.steps;  // before the kinds: what they log is of this step
  live.sim_time = saved.sim_time;
  for (const auto& kind : kinds()) {
    const auto& objects = saved.objects[static_cast<std::size_t>(kind->number())];
    for (std::uint32_t slot = 0; slot < objects.size(); ++slot) {
      put_in_force({kind->number(), slot}, objects[slot]->commands);
      kind->restore(live, slot, *objects[slot]);
    }
  }
  live.each_object(&Kind::all_placed);
  live.effectors.restore(saved.effectors, *live.structure);
  live.list_pushed();
  ++live.parameters_version;
  live.commands.set_last_order(saved.last_order);
  ++live.epoch;
  live.changed = true;
}

}  // namespace ambf::model
