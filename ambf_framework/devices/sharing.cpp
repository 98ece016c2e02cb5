#include "devices/detail/sharing.h"

namespace ambf::devices {

using math::Vec3;
using state::SharingScheme;

namespace {

constexpr Vec3 kAll{1.0, 1.0, 1.0}, kNone{};
constexpr SharedAxes kBoth{kAll, kAll}, kPosition{kAll, kNone}, kRotation{kNone, kAll}, kNothing{};
// Of asymmetric output under symmetric input.
constexpr SharedAxes kPlane{{1.0, 1.0, 0.0}, kNone}, kHeightAndRotation{{0.0, 0.0, 1.0}, kAll};

Vec3 product(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

void complete(Vec3& stiffness, Vec3& damping, const Vec3& other_stiffness, const Vec3& other_damping) {
  const auto axis = [](double& k, double& b, double other_k, double other_b) {
    if (k > 0.0) return;
    k = other_k;
    b = other_b;
  };
  axis(stiffness.x, damping.x, other_stiffness.x, other_damping.x);
  axis(stiffness.y, damping.y, other_stiffness.y, other_damping.y);
  axis(stiffness.z, damping.z, other_stiffness.z, other_damping.z);
}

}  // namespace

UserShare share_of(SharingScheme scheme, bool second) {
  const SharedAxes& own = second ? kRotation : kPosition;
  switch (scheme) {
    case SharingScheme::siao: return {kBoth, second ? kHeightAndRotation : kPlane};
    case SharingScheme::aiso: return {own, kBoth};
    case SharingScheme::aiao: return {own, own};
    case SharingScheme::sino: return {kBoth, kNothing};
    case SharingScheme::aino: return {own, kNothing};
    case SharingScheme::siso:
    case SharingScheme::as_in_files:
    case SharingScheme::count: break;
  }
  return {kBoth, kBoth};
}

state::EffectorGains on_axes(const state::EffectorGains& gains, const SharedAxes& axes) {
  return {product(gains.linear_stiffness, axes.linear), product(gains.linear_damping, axes.linear),
          product(gains.angular_stiffness, axes.angular), product(gains.angular_damping, axes.angular)};
}

state::EffectorGains completed(const state::EffectorGains& gains, const state::EffectorGains& others) {
  state::EffectorGains out = gains;
  complete(out.linear_stiffness, out.linear_damping, others.linear_stiffness, others.linear_damping);
  complete(out.angular_stiffness, out.angular_damping, others.angular_stiffness, others.angular_damping);
  return out;
}

}  // namespace ambf::devices
