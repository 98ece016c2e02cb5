// The flags about screenshots, videos and their renderer: --screenshot, --video, --fps, --seconds, --at,
// --picture_size, --quality, --offscreen.
#pragma once

#include <boost/program_options/variables_map.hpp>
#include <string>

#include "command_line.h"

namespace ambf::simulator {

// Copies these flags from `map` to `options`. Returns the error, or an empty text.
std::string read_picture_options(const boost::program_options::variables_map& map, CommandLine& options);

}  // namespace ambf::simulator
