// Private to mesh/: weld() of points that lie in memory in whatever way.
#pragma once

#include <functional>

#include "mesh/weld.h"

namespace ambf::mesh {

Weld weld_points(std::size_t count, const std::function<math::Vec3(std::size_t)>& point, double epsilon);

}  // namespace ambf::mesh
