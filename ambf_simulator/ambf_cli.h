// Where our command line program is, which does beside the simulator what is easier done in Python. Any thread.
#pragma once

#include <string>
#include <vector>

namespace ambf::simulator {

// Where ambf-cli may be, in this order: on the PATH, then in the source tree.
std::vector<std::string> ambf_cli_places();
// The first of these that can be run; empty: none, which ambf_cli_is_missing() says in words.
std::string find_ambf_cli(const std::vector<std::string>& places);
std::string ambf_cli_is_missing(const std::vector<std::string>& places);

}  // namespace ambf::simulator
