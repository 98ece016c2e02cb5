// A URDF robot as bodies and joints that can be simulated: links without mass folded away, every body placed in the
// world at joint values of zero. Pure functions.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "adf/detail/urdf_answer.h"

namespace ambf::adf::urdf {

struct Treatment {
  bool free_base = false;    // the root moves; else it is static
  bool merge_fixed = false;  // what fixed joints connect becomes one body
};

struct PlannedBody {
  Link link;  // its poses are in the link's frame
  math::Pose T_world_link;
  bool is_static = false;
};

struct Plan {
  std::vector<PlannedBody> bodies;  // parents before children
  std::vector<Joint> joints;        // between bodies; none floating
};

using Warn = std::function<void(int line, const std::string& message, const std::string& hint)>;

Plan plan_of(Robot robot, const Treatment& treatment, const Warn& warn);

// Principal moments of a symmetric tensor (xx, xy, xz, yy, yz, zz), and the rotation U of their axes, det U = 1:
// I = U diag(moments) U^T.
math::Vec3 principal_moments(const std::array<double, 6>& tensor, math::Quat& out_axes);

}  // namespace ambf::adf::urdf
