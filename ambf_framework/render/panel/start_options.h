// What of physics is decided when the program starts: shown, with how it is set, since nothing changes it while it
// runs. A frame has what came of it. Pure functions, any thread.
#pragma once

#include <string>
#include <vector>

#include "state/frame.h"

namespace ambf::render {

struct StartOption {
  const char* label;
  std::string value;  // in force
  const char* set_by;
  const char* text;  // for a tool tip
};

std::vector<StartOption> start_options(const state::RunState& run);

}  // namespace ambf::render
