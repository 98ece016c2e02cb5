// The physics thread's side of the CommandTable: takes news, merges the sources of each object, ends what expired, and
// has the commands act in every step (command_actions.cpp). Allocates nothing (room is made at each swap). For use
// inside model/ only.
#pragma once

#include <cstdint>
#include <vector>

#include "model/command_table.h"
#include "model/detail/live_objects.h"
#include "model/live_world.h"
#include "state/frame.h"
#include "state/structure.h"

namespace ambf::inputs {
class Channel;  // inputs/recorder.h
}

namespace ambf::model {

class LiveCommands {
 public:
  LiveCommands(CommandTable& table, LiveWorld::Impl& live);
  void record_to(inputs::Channel* channel) { record_ = channel; }

  // After a swap: makes room for `objects` objects. Loses nothing.
  void reserve(std::size_t objects);

  // Takes the news and ends what has expired by `watchdog_s`. Returns whether a frame would show it: an active flag
  // changed, a camera moved.
  bool take(const state::Structure& structure, double watchdog_s);
  // Takes the news of every object, whether marked or not.
  void look_at_all(const state::Structure& structure);

  // Before the physics step: joint drives, wrenches, Cartesian control, each within its CommandBound.
  void act(double h_s);

  // Ends all that is in force for one object, as if every source had let go.
  void end_object(const state::Structure& structure, ObjectRef object);
  // A joint that was held, or a body's pose, is let go.
  void end_hold(const state::Structure& structure, ObjectRef object);
  // Forgets all commands at once, without their expiry's effects.
  void forget_all();
  // The same without those that outlive a reset of the world.
  void forget_for_reset();

  // The slot in force whose post has this number; null for none (0 too).
  CommandSlot* leading_slot(std::uint64_t order) const;
  std::uint64_t last_order() const { return last_order_; }
  void set_last_order(std::uint64_t order) { last_order_ = order; }
  double watchdog_now_s() const { return watchdog_now_s_; }
  CommandSlots* slots(ObjectRef object) const;
  // How commands to the n-th of LiveTables::noted fare.
  void fill(std::size_t noted, const state::Structure& structure, state::CommandState& out) const;
  double watchdog_s() const { return table_.watchdog_s(); }
  // Recomputes an object's merged command, its active flag and its place among the commanded.
  void merge(ObjectRef object);

 private:
  template <class Spared>
  void forget(Spared&& spared);
  struct News {
    ObjectRef object;
    CommandSlot* slot;
    std::int64_t time_ns;
  };
  void look_at(const state::Structure& structure, ObjectRef object);
  void take_news(const state::Structure& structure);
  void act_on_joints(double h_s);
  void act_on_static(LiveBody& live, CommandSlots& all, double h_s);
  void act_on_body(LiveBody& live, CommandSlots& all, double h_s);
  // Counts a cut; the first one of each source is logged.
  void count_cut(CommandSlot& slot, std::uint32_t body);
  // A new command within its bounds has what it commands move again.
  void release_frozen(const state::Structure& structure, ObjectRef object, const CommandSlot& slot);
  void apply_joints(const state::Structure& structure, ObjectRef object, CommandSlot& slot);
  // What happens to a source's share: it goes, or, where `hold` says so, position targets of joints stay.
  void end(const state::Structure& structure, CommandSlot& slot);
  void end_joints(const state::Structure& structure, const CommandSlot& ended, bool expired, bool hold);
  void expire(const state::Structure& structure, ObjectRef object, CommandSlot& slot);
  void note(ObjectRef object, CommandSlots& slots);
  void note_command(const CommandSlots& slots, const CommandSlot& slot, std::int64_t posted_ns);
  void obey_waiting();
  bool any_in_force(ObjectRef object) const;
  // Another master holds the object: what this source posts now has no effect, later either.
  bool is_excluded(ObjectRef object, const CommandSlot& slot) const;

  CommandTable& table_;
  LiveWorld::Impl& live_;
  LiveTables& tables_;
  std::vector<News> news_;
  std::uint64_t last_order_ = 0;
  double watchdog_now_s_ = 0.0;
  bool changed_ = false;
  bool some_wait_ = false;  // commands that no step has obeyed yet
  inputs::Channel* record_ = nullptr;
  std::vector<std::uint8_t> recorded_bytes_;  // of a kind's own command
};

}  // namespace ambf::model
