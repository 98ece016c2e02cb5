// The room of a world file that names no environment: a floor and four low walls around the origin (ADF: `enclosure`).
#pragma once

#include "scene/description.h"

namespace ambf::runtime {

// Static bodies without topics; the floor's top is at z = 0. `size`: inner length (x), width (y) and height (z), m.
scene::Model make_enclosure(const math::Vec3& size);

}  // namespace ambf::runtime
