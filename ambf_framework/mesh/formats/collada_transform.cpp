#include "mesh/formats/detail/collada_transform.h"

#include <cmath>
#include <numbers>

#include "math/rotation.h"

namespace ambf::mesh {

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) c[4 * i + j] += a[4 * i + k] * b[4 * k + j];
    }
  }
  return c;
}

double determinant(const Matrix& m) {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
}

math::Vec3 turn_normal(const Matrix& m, double x, double y, double z) {
  return {(m[5] * m[10] - m[6] * m[9]) * x + (m[6] * m[8] - m[4] * m[10]) * y + (m[4] * m[9] - m[5] * m[8]) * z,
          (m[2] * m[9] - m[1] * m[10]) * x + (m[0] * m[10] - m[2] * m[8]) * y + (m[1] * m[8] - m[0] * m[9]) * z,
          (m[1] * m[6] - m[2] * m[5]) * x + (m[2] * m[4] - m[0] * m[6]) * y + (m[0] * m[5] - m[1] * m[4]) * z};
}

Matrix transform_of(std::string_view name, const std::array<double, 16>& values) {
  if (name == "matrix") return values;
  Matrix m = kIdentity;
  if (name == "rotate") {
    const math::Vec3 axis{values[0], values[1], values[2]};
    if (math::norm(axis) < 1e-12) return m;
    double r[9];
    math::to_matrix(math::from_axis_angle(math::normalized(axis), values[3] * std::numbers::pi / 180.0), r);
    for (std::size_t i = 0; i < 9; ++i) m[4 * (i / 3) + i % 3] = r[i];
    return m;
  }
  for (std::size_t i = 0; i < 3; ++i) m[name == "scale" ? 5 * i : 4 * i + 3] = values[i];
  return m;
}

}  // namespace ambf::mesh
