// LiveWorld::save and restore: between live objects and a SavedState.
#include <cassert>

#include "model/detail/live_impl.h"
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
  for (const auto& body : live.tables.bodies)
    saved.bodies.push_back({parameters_of(*body), body->push, body->push_steps, body->controller.state(),
                            commands_of(*body->slots, now_s)});
  for (const auto& joint : live.tables.joints)
    saved.joints.push_back({parameters_of(*joint), joint->controller.state(), joint->order.type, joint->order.value,
                            joint->order.led == nullptr ? 0 : joint->order.order});
  const auto save_placed = [&](const auto& table, const auto& infos, std::vector<SavedPlaced>& to) {
    for (std::size_t slot = 0; slot < table.size(); ++slot) {
      const LivePlaced& placed = *table[slot];
      to.push_back({infos[slot].parent_object, infos[slot].parent_name, placed.T_parent_initial, placed.T_parent,
                    placed.orphaned, placed.lens, placed.beam, commands_of(*placed.slots, now_s)});
    }
  };
  save_placed(live.tables.cameras, live.structure->cameras, saved.cameras);
  save_placed(live.tables.lights, live.structure->lights, saved.lights);
  live.changed = true;
  return encode(std::move(saved), *live.structure);
}

std::string LiveWorld::restore(const std::vector<std::uint8_t>& bytes) {
  SavedState saved;
  std::string wrong = decode(bytes, *impl_->structure, impl_->physics->options().step, saved);
  if (wrong.empty() && !parent_changes(saved, *impl_->structure).empty()) wrong = "cameras or lights hang elsewhere";
  if (wrong.empty()) restore(saved);
  return wrong;
}

// Nothing here can fail: decode() has looked at everything.
void LiveWorld::restore(const SavedState& saved) {
  Impl& live = *impl_;
  [[maybe_unused]] const bool fits = live.physics->restore_state(saved.physics);
  assert(fits);
  live.picks.end_all();
  live.commands.forget_all();
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
  for (std::uint32_t slot = 0; slot < live.tables.bodies.size(); ++slot) {
    put_in_force({state::ObjectKind::rigid_body, slot}, saved.bodies[slot].commands);
    LiveBody& body = *live.tables.bodies[slot];
    set_parameters(body, saved.bodies[slot].parameters, live.physics->options().step);
    body.push = saved.bodies[slot].push;
    body.push_steps = saved.bodies[slot].push_steps;
    body.controller.set_state(saved.bodies[slot].controller);  // merge() began afresh
  }
  live.list_pushed();
  ++live.parameters_version;
  for (std::size_t slot = 0; slot < live.tables.joints.size(); ++slot) {
    LiveJoint& joint = *live.tables.joints[slot];
    const SavedJoint& from = saved.joints[slot];
    set_parameters(joint, from.parameters);
    joint.controller.set_state(from.controller);
    joint.order = {from.type, from.value, from.order, live.commands.leading_slot(from.order)};
  }
  const auto restore_placed = [&](auto& table, state::ObjectKind kind, const std::vector<SavedPlaced>& from) {
    for (std::uint32_t slot = 0; slot < table.size(); ++slot) {
      put_in_force({kind, slot}, from[slot].commands);
      LivePlaced& placed = *table[slot];
      placed.T_parent_initial = from[slot].T_parent_initial;
      placed.T_parent = from[slot].T_parent;
      placed.orphaned = from[slot].orphaned;
      placed.lens = from[slot].lens;
      placed.beam = from[slot].beam;
    }
  };
  restore_placed(live.tables.cameras, state::ObjectKind::camera, saved.cameras);
  restore_placed(live.tables.lights, state::ObjectKind::light, saved.lights);
  live.commands.set_last_order(saved.last_order);
  live.steps = saved.steps;
  live.sim_time = saved.sim_time;
  ++live.epoch;
  live.changed = true;
}

}  // namespace ambf::model
