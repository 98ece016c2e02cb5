// Gives an arm's model another instrument while all runs: Remove and Load, as programs do it. Waits for the loader, so
// it is not for a thread that has other things to do. C++17.
#pragma once

#include <atomic>
#include <string>

#include "adf/crtk_arms.h"
#include "state/abilities/abilities.h"

namespace ambf::crtk {

struct ExchangeResult {
  std::string problem;   // empty: the model has the instrument
  bool removed = false;  // the old one is gone
};

// `base`: the body that the arm's joints hang on. What can be known before the old instrument goes is checked first:
// the file, and whether it can be loaded. Joints keep their positions, within the new limits. `stopping` ends it early.
ExchangeResult exchange_tool(const state::Abilities& simulation, const adf::CrtkArm& arm, state::ObjectId base,
                             const adf::CrtkInstrument& instrument, const std::atomic<bool>& stopping);

}  // namespace ambf::crtk
