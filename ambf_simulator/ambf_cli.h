// Where our command line program is, which does beside the simulator what is easier done in Python. Any thread.
#pragma once

#include <string>
#include <vector>

namespace ambf::simulator {

// Where ambf-cli may be, in this order: on the PATH, then in the source tree.
std::vector<std::string> ambf_cli_places();
// Why there is none at any of these (base::first_program), and what to do.
std::string ambf_cli_is_missing(const std::vector<std::string>& places);

}  // namespace ambf::simulator
