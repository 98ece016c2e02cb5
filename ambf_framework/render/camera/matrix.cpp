#include "render/camera/matrix.h"

#include <cmath>

#include "math/rotation.h"

namespace ambf::render {

namespace {
float f(double x) { return static_cast<float>(x); }
}  // namespace

Mat4 operator*(const Mat4& a, const Mat4& b) {
  Mat4 out;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k) sum += static_cast<double>(a.m[4 * k + row]) * b.m[4 * column + k];
      out.m[4 * column + row] = f(sum);
    }
  }
  return out;
}

Mat4 to_matrix(const math::Pose& T_A_B, double scale) {
  double R[9];
  math::to_matrix(T_A_B.orientation, R);
  Mat4 out;
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t row = 0; row < 3; ++row) out.m[4 * column + row] = f(scale * R[3 * row + column]);
  }
  out.m[12] = f(T_A_B.position.x);
  out.m[13] = f(T_A_B.position.y);
  out.m[14] = f(T_A_B.position.z);
  out.m[15] = 1.0F;
  return out;
}

// By cofactors (2 x 2 minors of the upper and lower halves).
Mat4 inverse(const Mat4& matrix) {
  const auto a = [&](std::size_t row, std::size_t column) { return static_cast<double>(matrix.m[4 * column + row]); };
  const auto minor = [&](std::size_t top, std::size_t i, std::size_t j) {
    return a(top, i) * a(top + 1, j) - a(top, j) * a(top + 1, i);
  };
  const double s0 = minor(0, 0, 1), s1 = minor(0, 0, 2), s2 = minor(0, 0, 3), s3 = minor(0, 1, 2), s4 = minor(0, 1, 3),
               s5 = minor(0, 2, 3);
  const double c0 = minor(2, 0, 1), c1 = minor(2, 0, 2), c2 = minor(2, 0, 3), c3 = minor(2, 1, 2), c4 = minor(2, 1, 3),
               c5 = minor(2, 2, 3);
  const double determinant = s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0;
  Mat4 result;
  if (determinant == 0.0) return result;
  const double rows[4][4] = {{a(1, 1) * c5 - a(1, 2) * c4 + a(1, 3) * c3, -a(0, 1) * c5 + a(0, 2) * c4 - a(0, 3) * c3,
                              a(3, 1) * s5 - a(3, 2) * s4 + a(3, 3) * s3, -a(2, 1) * s5 + a(2, 2) * s4 - a(2, 3) * s3},
                             {-a(1, 0) * c5 + a(1, 2) * c2 - a(1, 3) * c1, a(0, 0) * c5 - a(0, 2) * c2 + a(0, 3) * c1,
                              -a(3, 0) * s5 + a(3, 2) * s2 - a(3, 3) * s1, a(2, 0) * s5 - a(2, 2) * s2 + a(2, 3) * s1},
                             {a(1, 0) * c4 - a(1, 1) * c2 + a(1, 3) * c0, -a(0, 0) * c4 + a(0, 1) * c2 - a(0, 3) * c0,
                              a(3, 0) * s4 - a(3, 1) * s2 + a(3, 3) * s0, -a(2, 0) * s4 + a(2, 1) * s2 - a(2, 3) * s0},
                             {-a(1, 0) * c3 + a(1, 1) * c1 - a(1, 2) * c0, a(0, 0) * c3 - a(0, 1) * c1 + a(0, 2) * c0,
                              -a(3, 0) * s3 + a(3, 1) * s1 - a(3, 2) * s0, a(2, 0) * s3 - a(2, 1) * s1 + a(2, 2) * s0}};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      result.m[4 * column + row] = static_cast<float>(rows[row][column] / determinant);
    }
  }
  return result;
}

std::array<double, 4> transform(const Mat4& matrix, const math::Vec3& p) {
  std::array<double, 4> out{};
  for (std::size_t row = 0; row < 4; ++row) {
    out[row] = matrix.m[row] * p.x + matrix.m[4 + row] * p.y + matrix.m[8 + row] * p.z + matrix.m[12 + row];
  }
  return out;
}

Mat4 perspective(double field_of_view_rad, double aspect, double near_m, double far_m) {
  const double s = 1.0 / std::tan(field_of_view_rad / 2.0);
  Mat4 out;
  out.m[0] = f(s / aspect);
  out.m[5] = f(s);
  out.m[10] = f((far_m + near_m) / (near_m - far_m));
  out.m[11] = -1.0F;
  out.m[14] = f(2.0 * far_m * near_m / (near_m - far_m));
  return out;
}

Mat4 orthographic(double width_m, double aspect, double near_m, double far_m) {
  Mat4 out;
  out.m[0] = f(2.0 / width_m);
  out.m[5] = f(2.0 * aspect / width_m);
  out.m[10] = f(2.0 / (near_m - far_m));
  out.m[14] = f((far_m + near_m) / (near_m - far_m));
  out.m[15] = 1.0F;
  return out;
}

}  // namespace ambf::render
