// LiveWorld::fill: from live objects to a frame.
#include "model/detail/live_impl.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "model/live_world.h"

namespace ambf::model {

void LiveWorld::fill(state::Frame& frame) const {
  const Impl& live = *impl_;
  const LiveTables& tables = live.tables;
  frame.sim_step = static_cast<std::uint32_t>(live.steps);
  frame.sim_time = live.sim_time;
  frame.epoch = live.epoch;

  const std::size_t total = live.physics->contacts(live.contacts);
  const std::size_t shown = std::min(total, live.contacts.size());
  frame.contacts_total = static_cast<std::uint32_t>(total);
  frame.contacts.resize(shown);  // within what make_frame reserved
  for (std::size_t i = 0; i < shown; ++i) {
    const physics::Contact& contact = live.contacts[i];
    frame.contacts[i] = {contact.body_a->user_index(),
                         contact.body_b->user_index(),
                         contact.point_on_b,
                         contact.normal_on_b,
                         contact.distance,
                         contact.normal_impulse,
                         contact.friction_impulse};
  }
  for (const auto& kind : kinds()) kind->fill(live, frame);  // contact sensors read the contacts

  live.picks.fill(frame);
  live.effectors.fill(frame.effectors);
  frame.commands.resize(tables.noted.size());
  for (std::size_t i = 0; i < tables.noted.size(); ++i) live.commands.fill(i, *live.structure, frame.commands[i]);
  frame.run.watchdog_s = live.commands.watchdog_s();
  live.changed = false;
}

}  // namespace ambf::model
