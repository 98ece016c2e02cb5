#include "model/detail/stable_gains.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/rotation.h"

namespace ambf::model {
namespace {

double inverse_of(double value) { return value > 0.0 ? 1.0 / value : 0.0; }

// Diagonal of the inverse inertia in body axes: 1 / (what one must turn to turn about that axis alone).
math::Vec3 inverse_inertia_about_body_axes(const math::Vec3& inertia, const math::Quat& R_body_com) {
  const math::Vec3 inverse_principal{inverse_of(inertia.x), inverse_of(inertia.y), inverse_of(inertia.z)};
  const math::Quat R_com_body = math::inverse(R_body_com);
  const auto about = [&](const math::Vec3& axis_body) {
    const math::Vec3 axis_com = math::rotate(R_com_body, axis_body);
    return math::dot(math::scaled(axis_com, inverse_principal), axis_com);
  };
  return {about({1, 0, 0}), about({0, 1, 0}), about({0, 0, 1})};
}

// The most that a force of 1 N in any direction, at r from the centre of mass, accelerates its point by turning the
// body: the largest eigenvalue of [r]^T I^-1 [r] (all in the principal frame), of which r itself is a null vector, so a
// quadratic equation.
double max_by_rotation(const math::Vec3& r, const math::Vec3& inertia) {
  const double a = inverse_of(inertia.x), b = inverse_of(inertia.y), c = inverse_of(inertia.z);
  const double xx = b * r.z * r.z + c * r.y * r.y, yy = a * r.z * r.z + c * r.x * r.x,
               zz = a * r.y * r.y + b * r.x * r.x;
  const double xy = -c * r.x * r.y, xz = -b * r.x * r.z, yz = -a * r.y * r.z;
  const double half = 0.5 * (xx + yy + zz);
  const double minors = xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz;
  return half + std::sqrt(std::max(0.0, half * half - minors));
}

}  // namespace

EffectiveMass effective_mass(const physics::Body& body) {
  const auto inertia_of = [](double inverse) {
    return inverse > 0.0 ? 1.0 / inverse : std::numeric_limits<double>::infinity();
  };
  const math::Vec3 inverse = inverse_inertia_about_body_axes(body.inertia(), body.T_body_com().orientation);
  // A force at the mesh origin also turns the body. Gains act along world axes, so the softest direction counts.
  const math::Vec3 arm = math::rotate(math::inverse(body.T_body_com().orientation), body.T_body_com().position);
  return {1.0 / (1.0 / body.mass() + max_by_rotation(arm, body.inertia())),
          {inertia_of(inverse.x), inertia_of(inverse.y), inertia_of(inverse.z)}};
}

}  // namespace ambf::model
