// Colours that files name without giving numbers. Pure; any thread.
#pragma once

#include <string>

#include "scene/colors.h"

namespace ambf::adf {

// What `color: random` gives: drawn from the object's identifier, so that it is the same at each start.
scene::NamedColor random_color(const std::string& seed);

}  // namespace ambf::adf
