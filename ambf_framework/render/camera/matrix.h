// 4x4 matrices as OpenGL takes them (column-major, applied to columns). Pure functions, any thread. Private to render/.
#pragma once

#include <array>

#include "math/types.h"

namespace ambf::render {

struct Mat4 {
  std::array<float, 16> m{};  // m[4 * column + row]
};

Mat4 operator*(const Mat4& a, const Mat4& b);
Mat4 to_matrix(const math::Pose& T_A_B, double scale = 1.0);
Mat4 inverse(const Mat4& matrix);  // all zero for a singular one
// (x, y, z, w) of M (p, 1).
std::array<double, 4> transform(const Mat4& matrix, const math::Vec3& p);

// OpenGL clip space. `field_of_view_rad` is vertical, `width_m` horizontal.
Mat4 perspective(double field_of_view_rad, double aspect, double near_m, double far_m);
Mat4 orthographic(double width_m, double aspect, double near_m, double far_m);

}  // namespace ambf::render
