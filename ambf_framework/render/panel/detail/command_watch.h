// Command statistics for the panel: each object whose command is active or was until recently, by model, with age,
// regularity and fate of its commands as frames report them. Main thread.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "render/panel/plots/spread_history.h"
#include "state/frame.h"

namespace ambf::render {

// Whether any source commands the joint; an idle joint has a command of zero effort.
inline bool is_commanded(const state::JointState& joint) {
  return joint.commanded_type != state::JointCommandType::none &&
         !(joint.commanded_type == state::JointCommandType::effort && joint.commanded == 0.0);
}

class CommandWatch {
 public:
  struct Commanded {
    state::ObjectId object;
    state::ModelId model = state::kWorldModel;
    state::CommandState status;         // of this frame
    std::vector<std::uint32_t> joints;  // slots, of those below it that are commanded
    double for_s = 0.0;                 // in force, without a pause; or, when it is not, ended that long ago
    double unchanged_s = 0.0;           // since its joints' commands last changed; as for_s when it commands none
    double age_s = -1.0;                // when the frame was made, since it was received; negative: unknown
    double silence = 0.0;               // of the watchdog's time, how much has gone: 1 ends it
    double received_hz = 0.0, applied_hz = 0.0;  // over the last two seconds
    state::Spread period, delay;                 // over the last half minute
  };
  // The objects of one model file, mostly an arm.
  struct Arm {
    state::ModelId model = state::kWorldModel;
    std::size_t first = 0, count = 0;  // in list()
    std::size_t in_force = 0;
    double received_hz = 0.0;
    const Commanded* oldest = nullptr;  // of those in force, the one nearest to its end; null: none is
  };
  static constexpr double kShownAfter_s = 10.0;  // ended commands stay in the list so long
  static constexpr double kNear = 0.5;           // share of the watchdog's time that deserves a warning

  // Once a picture; wall time.
  void take(const state::Frame& frame, std::int64_t now_ns);
  const std::vector<Commanded>& list() const { return list_; }  // by model, then as they were loaded
  const std::vector<Arm>& arms() const { return arms_; }

 private:
  struct Counts {
    std::int64_t ns = 0;
    std::uint64_t received = 0, applied = 0;
  };
  struct Known {
    bool in_force = false;
    std::int64_t since_ns = 0, changed_ns = 0, shown_until_ns = 0;
    std::uint64_t refused = 0;
    std::vector<double> joint_commands;
    state::Source source = state::Source::ros;
    SpreadHistory period, delay;
    std::deque<Counts> counts;
    bool seen = false;
  };
  void take(const state::Frame& frame, const state::CommandState& status, std::int64_t now_ns);
  static void measure(Known& known, const state::CommandState& status, std::int64_t frame_ns, Commanded& out);
  void group();

  std::map<std::uint64_t, Known> known_;  // by object
  std::vector<Commanded> list_;
  std::vector<Arm> arms_;
};

}  // namespace ambf::render
