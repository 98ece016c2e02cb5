// Private to mesh/: 4x4 transforms of COLLADA nodes. Pure functions.
#pragma once

#include <array>
#include <string_view>

#include "math/types.h"

namespace ambf::mesh {

using Matrix = std::array<double, 16>;  // row-major, applied to columns

constexpr Matrix kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix operator*(const Matrix& a, const Matrix& b);
// Of the upper left 3x3: negative for a mirror image.
double determinant(const Matrix& m);
// How normals turn: the cofactors of the upper left 3x3 (the inverse transpose but for its length).
math::Vec3 turn_normal(const Matrix& m, double x, double y, double z);

// The transform element `name` with its numbers: "matrix" (16), "translate" (3), "scale" (3), "rotate" (axis, degrees).
Matrix transform_of(std::string_view name, const std::array<double, 16>& values);

}  // namespace ambf::mesh
