// All bounds of the program, by their numbers in the code: for `ambf_simulator --limits` and docs/limits.md. Pure
// functions.
#pragma once

#include <string>

namespace ambf::simulator {

// One bound a line, for terminals.
std::string limits_as_text();
// docs/limits.md.
std::string limits_as_markdown();

}  // namespace ambf::simulator
