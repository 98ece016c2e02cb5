// Who commands what, as far as frames tell: each body, camera and light whose command is in force, since when, and how long ago what it
// tells the joints below it last changed. Frames do not say from which client a command came, nor when one that changes nothing was
// repeated. Main thread.
#pragma once

#include <map>
#include <vector>

#include "state/frame.h"

namespace ambf::render {

// Whether something wants the joint anywhere; without, it has a command of no effort.
inline bool is_commanded(const state::JointState& joint) {
  return joint.commanded_type != state::JointCommandType::none &&
         !(joint.commanded_type == state::JointCommandType::effort && joint.commanded == 0.0);
}

class CommandWatch {
 public:
  struct Commanded {
    state::ObjectId object;
    std::vector<std::uint32_t> joints;  // slots, of those below it that are commanded
    double for_s = 0.0;                 // in force, without a pause
    double unchanged_s = 0.0;           // since what its joints are told last changed; as for_s when it tells none
  };

  // Once a picture; wall time.
  void take(const state::Frame& frame, std::int64_t now_ns);
  const std::vector<Commanded>& list() const { return list_; }  // in the order of the structure

 private:
  struct Known {
    std::int64_t since_ns = 0, changed_ns = 0;
    std::vector<double> told;
    bool seen = false;
  };
  void note(const state::Frame& frame, state::ObjectId object, std::vector<std::uint32_t> joints, std::int64_t now_ns);

  std::map<std::uint64_t, Known> known_;
  std::vector<Commanded> list_;
};

}  // namespace ambf::render
