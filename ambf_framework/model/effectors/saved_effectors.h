// What input devices hold, as part of a saved state. Any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "model/effectors/effector_law.h"
#include "state/set_point.h"
#include "state/structure.h"

namespace ambf::model {

class StateArchive;  // model/detail/state_bytes.h

struct SavedEffector {
  std::uint64_t body = 0;  // slot
  state::Source source = state::Source::device_0;
  double age_s = 0.0;         // since its last set-point
  state::SetPoint set_point;  // the newest one
  EffectorLaw::State law;
  bool bounded = false;
  bool leads_jaw = false;
  double jaw_in_force = 0.0;         // opening, moves to the set-point's
  std::uint64_t jaw_steps_left = 0;  // until it is there
  double jaw_seen = 0.0;             // the hand's opening at the sample before
  double jaw_mark = 0.0;             // and when another one took the lead, or it came
};

// Writes, or reads and checks.
void transfer_effectors(StateArchive& archive, std::vector<SavedEffector>& effectors,
                        const state::Structure& structure);

}  // namespace ambf::model
