#include "tests/benchmarks/accuracy_reference.h"

#include <cmath>

#include "math/rotation.h"

namespace ambf::accuracy {

namespace {

using Real = long double;
constexpr Real kStep = 2e-5L;  // s

template <std::size_t n, class Rate>
void advance(std::array<Real, n>& y, Real h, const Rate& rate) {
  const auto plus = [](std::array<Real, n> a, Real s, const std::array<Real, n>& b) {
    for (std::size_t i = 0; i < n; ++i) a[i] += s * b[i];
    return a;
  };
  const auto k1 = rate(y), k2 = rate(plus(y, h / 2, k1)), k3 = rate(plus(y, h / 2, k2)), k4 = rate(plus(y, h, k3));
  for (std::size_t i = 0; i < n; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
}

template <std::size_t n, class Rate>
void advance_for(std::array<Real, n>& y, double seconds, const Rate& rate) {
  const long steps = std::lround(static_cast<Real>(seconds) / kStep);
  for (long i = 0; i < steps; ++i) advance(y, static_cast<Real>(seconds) / static_cast<Real>(steps), rate);
}

}  // namespace

math::Quat tumbled(const math::Vec3& inertia, const math::Vec3& omega, double seconds) {
  const Real ix = inertia.x, iy = inertia.y, iz = inertia.z;
  std::array<Real, 7> y{omega.x, omega.y, omega.z, 0, 0, 0, 1};  // rate in body axes; attitude x y z w
  advance_for(y, seconds, [&](const std::array<Real, 7>& s) -> std::array<Real, 7> {
    const auto& [a, b, c, qx, qy, qz, qw] = s;
    return {(iy - iz) * b * c / ix,         (iz - ix) * c * a / iy,         (ix - iy) * a * b / iz,
            (qw * a + qy * c - qz * b) / 2, (qw * b + qz * a - qx * c) / 2, (qw * c + qx * b - qy * a) / 2,
            -(qx * a + qy * b + qz * c) / 2};
  });
  return math::normalized(math::Quat{static_cast<double>(y[3]), static_cast<double>(y[4]), static_cast<double>(y[5]),
                                     static_cast<double>(y[6])});
}

std::vector<TopAngles> top_angles(const Top& top, double every, int samples) {
  const Real across = top.across + top.mass * top.lever * top.lever, spin = top.along * top.spin;
  const Real moment = top.mass * top.g * top.lever, momentum = spin * std::cos(static_cast<Real>(top.tilt));
  const auto precession_rate = [&](Real tilt) {
    return (momentum - spin * std::cos(tilt)) / (across * std::sin(tilt) * std::sin(tilt));
  };
  const auto rate = [&](const std::array<Real, 3>& s) -> std::array<Real, 3> {
    const auto& [tilt, tilt_rate, precession] = s;
    const Real turning = precession_rate(tilt), sine = std::sin(tilt);
    return {tilt_rate,
            (turning * turning * across * sine * std::cos(tilt) - spin * turning * sine + moment * sine) / across,
            turning};
  };
  std::array<Real, 3> y{top.tilt, 0, 0};
  std::vector<TopAngles> angles;
  for (int i = 0; i < samples; ++i) {
    angles.push_back({static_cast<double>(y[0]), static_cast<double>(y[2])});
    advance_for(y, every, rate);
  }
  return angles;
}

std::vector<double> swing(double inertia, double weight, double angle, double rate, double every, int samples) {
  std::array<Real, 2> y{angle, rate};
  const Real ratio = static_cast<Real>(weight) / inertia;
  std::vector<double> angles;
  for (int i = 0; i < samples; ++i) {
    angles.push_back(static_cast<double>(y[0]));
    advance_for(y, every, [&](const std::array<Real, 2>& s) -> std::array<Real, 2> {
      return {s[1], -ratio * std::cos(s[0])};
    });
  }
  return angles;
}

}  // namespace ambf::accuracy
