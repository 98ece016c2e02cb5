// A task in the simulation: what its judge remembers from step to step. Physics thread. For use inside
// model/kinds/task* only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/detail/live_impl.h"
#include "state/tasks.h"

namespace ambf::model {

// Steps since something was last so, no further than it matters.
struct Since {
  static constexpr std::uint32_t kLong = UINT32_MAX;
  std::uint32_t steps = kLong;

  void pass(bool is_so) { steps = is_so ? 0 : std::max(steps, steps + 1); }
  bool within(std::uint32_t limit) const { return steps <= limit; }
};

struct WatchedPiece {
  std::vector<Since> gripped, touched;  // by holder
  Since avoided;                        // that it touched what it must not
  std::uint32_t held_by = 0, touched_by = 0;
  std::uint32_t alone = state::kNone;  // the holder that last held it alone, since it was grasped
  bool passed_in_air = false;          // while several held it, it touched nothing else
  std::uint32_t hand_overs = 0;        // since it was last grasped
  bool let_go = false;                 // and neither grasped again nor dropped since
  double height_m = 0.0;               // of its centre of mass when it was last gripped, along the world's z
  std::uint32_t drops = 0;

  // In this step: masks of holders, and whether it touches anything else.
  std::uint32_t gripping = 0, touching = 0;
  bool supported = false, touches_avoided = false;
};

struct WatchedGoal {
  std::uint64_t held_steps = 0;  // for which it has been met; of a listed one that is done, no longer counted
  bool done = false;
  bool armed = false;         // listed: it was seen unmet since its turn came
  bool strayed = false;       // listed: it was met out of turn, and is counted
  bool unmet_before = false;  // listed: it was seen unmet while others had their turn
  double distance_m = 0.0, angle_rad = 0.0;
};

// What a holder's body does to a piece in this step.
struct Press {
  std::uint32_t piece = 0, holder = 0, body = 0;
  math::Vec3 towards_piece;  // unit
};

struct LiveTask final : LivePlaced {
  std::vector<WatchedPiece> pieces;
  std::vector<WatchedGoal> goals;
  std::uint32_t drops = 0, touches = 0, hand_overs = 0, wrong_order = 0;
  bool success = false, completed = false;  // now; and ever
  double success_since_s = 0.0;
  std::uint64_t steps = 0;  // judged, until it was completed

  // By slot of bodies, for the present structure; kNone: none.
  std::vector<std::uint32_t> piece_of, holder_of;
  std::vector<bool> avoided;
  std::vector<Press> presses;  // room for those of a step

  void forget() {
    for (WatchedPiece& piece : pieces) {
      const std::size_t holders = piece.gripped.size();
      piece = {};
      piece.gripped.resize(holders);
      piece.touched.resize(holders);
    }
    for (WatchedGoal& goal : goals) goal = {};
    drops = touches = hand_overs = wrong_order = 0;
    success = completed = false;
    success_since_s = 0.0;
    steps = 0;
  }
};

LiveTask& task_at(const LiveWorld::Impl& live, std::uint32_t slot);

// After a swap: which bodies are what.
void find_bodies(const LiveWorld::Impl& live, std::uint32_t slot);
// How far pieces are from their places, on the present poses.
void measure(const LiveWorld::Impl& live, std::uint32_t slot);
// After each step, of all tasks.
void judge_tasks(LiveWorld::Impl& live);

}  // namespace ambf::model
