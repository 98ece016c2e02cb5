// IFToMM A04, Bricard's mechanism: six rods of 1 m and 1 kg along the edges of a cube, one of them fixed, each joint's
// axis across both of its rods. By counting it has no freedom; by its geometry it has one.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/benchmarks/accuracy_cases.h"

namespace ambf::accuracy {

namespace {

using physics::testing::mass_only;

using Real = long double;
using Vector = std::array<Real, 3>;
constexpr Real kGravity = 9.81L;
constexpr int kJoints = 6;
constexpr double kAlongInertia = 1e-4;  // kg m^2, of a rod about itself

// Of rod k, from joint k to joint k + 1 (the last one is the fixed one), and the axis of joint k, in the rod's frame.
constexpr int kAlong[kJoints] = {0, 1, 2, 0, 1, 2}, kAxis[kJoints] = {1, 2, 0, 1, 2, 0};
constexpr double kSense[kJoints] = {1.0, -1.0, 1.0, -1.0, 1.0, -1.0};

struct Chain {
  std::array<Vector, kJoints> joints{};
  std::array<Vector, kJoints> left{}, up{};  // of rod k: across it, up = along x left
  Real open = 0.0L;  // what is left to the point where the last rod begins, along that rod's own direction
};

// Every other joint is turned by `angle`, the ones between by `other`: the motion keeps the threefold symmetry.
Chain chain(Real angle, Real other) {
  std::array<Vector, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Chain result;
  Vector at{};
  for (int k = 0; k < kJoints; ++k) {
    const Real c = std::cos(k % 2 == 0 ? angle : other), s = std::sin(k % 2 == 0 ? angle : other);
    const auto u = static_cast<std::size_t>((kAxis[k] + 1) % 3), v = static_cast<std::size_t>((kAxis[k] + 2) % 3);
    const Vector first = columns[u], second = columns[v];
    for (std::size_t i = 0; i < 3; ++i) {
      columns[u][i] = c * first[i] + s * second[i];
      columns[v][i] = c * second[i] - s * first[i];
    }
    result.joints[static_cast<std::size_t>(k)] = at;
    const auto along = static_cast<std::size_t>(kAlong[k]);
    result.left[static_cast<std::size_t>(k)] = columns[(along + 1) % 3];
    result.up[static_cast<std::size_t>(k)] = columns[(along + 2) % 3];
    if (k == kJoints - 1) break;
    const Vector& rod = columns[along];
    for (std::size_t i = 0; i < 3; ++i) at[i] += static_cast<Real>(kSense[k]) * rod[i];
  }
  result.open = at[0] * at[0] + at[1] * at[1] + (at[2] - 1) * (at[2] - 1);
  return result;
}

// The angle of the joints between at which the loop closes: the double root of the squared gap next to `guess`.
Real closing(Real angle, Real guess) {
  constexpr Real kStep = 1e-4L;
  for (int i = 0; i < 60; ++i) {
    const Real low = chain(angle, guess - kStep).open, mid = chain(angle, guess).open,
               high = chain(angle, guess + kStep).open;
    const Real change = -kStep * (high - low) / (2 * (high - 2 * mid + low));
    guess += change;
    if (std::abs(change) < 1e-15L) break;
  }
  return guess;
}

// Fourth-order difference of f about x.
template <class Function>
auto slope(const Function& f, Real x) {
  constexpr Real d = 1e-3L;
  const auto a = f(x - 2 * d), b = f(x - d), c = f(x + d), e = f(x + 2 * d);
  auto result = a;
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = (a[i] - 8 * b[i] + 8 * c[i] - e[i]) / (12 * d);
  return result;
}

// Its motion in `angle`: {effective inertia, potential energy}.
std::array<Real, 2> inertia_and_height(Real angle, Real guess) {
  const auto coordinates = [guess](Real q) {
    const Chain at = chain(q, closing(q, guess));
    std::array<Real, 9 * kJoints> all{};
    for (std::size_t k = 0; k < 3 * kJoints; ++k) {
      all[k] = at.joints[k / 3][k % 3];
      all[3 * kJoints + k] = at.left[k / 3][k % 3];
      all[6 * kJoints + k] = at.up[k / 3][k % 3];
    }
    return all;
  };
  const auto here = coordinates(angle), rate = slope(coordinates, angle);
  std::array<Real, 2> result{};
  for (std::size_t rod = 0; rod + 1 < kJoints; ++rod) {
    Real spin = 0;
    for (std::size_t i = 3 * rod; i < 3 * rod + 3; ++i) {
      result[0] += (rate[i] * rate[i] + rate[i] * rate[i + 3] + rate[i + 3] * rate[i + 3]) / 3;
      spin += rate[3 * kJoints + i] * here[6 * kJoints + i];
    }
    result[0] += kAlongInertia * spin * spin;
    result[1] += kGravity * (here[3 * rod + 1] + here[3 * rod + 4]) / 2;
  }
  return result;
}

// Where joint 3 is at 0, every, 2 every, ... s.
std::vector<math::Vec3> bricard(double every, int samples) {
  constexpr int kParts = 5;  // steps of the fourth-order method in a sample
  const Real h = static_cast<Real>(every) / kParts;
  Real angle = 0, rate = 0, other = 0;
  const auto acceleration = [&](Real q, Real w) {
    const auto change = slope([&](Real x) { return inertia_and_height(x, other); }, q);
    return -(change[0] * w * w / 2 + change[1]) / inertia_and_height(q, other)[0];
  };
  std::vector<math::Vec3> path;
  for (int sample = 0; sample < samples; ++sample) {
    const Vector at = chain(angle, other).joints[3];
    path.push_back({static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
    for (int i = 0; i < kParts; ++i) {
      const Real a1 = acceleration(angle, rate), w2 = rate + h / 2 * a1;
      const Real a2 = acceleration(angle + h / 2 * rate, w2), w3 = rate + h / 2 * a2;
      const Real a3 = acceleration(angle + h / 2 * w2, w3), w4 = rate + h * a3;
      const Real a4 = acceleration(angle + h * w3, w4);
      angle += h / 6 * (rate + 2 * w2 + 2 * w3 + w4);
      rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      other = closing(angle, other);
    }
  }
  return path;
}

}  // namespace

Figures bricard_mechanism(double h) {
  physics::World world(options(h, {0.0, -static_cast<double>(kGravity), 0.0}));
  std::vector<std::unique_ptr<physics::Body>> rods;
  std::vector<std::unique_ptr<physics::Joint>> joints;
  std::vector<math::Vec3> half;
  math::Vec3 at;
  for (int k = 0; k < kJoints; ++k) {
    const double sense = 0.5 * kSense[k];
    half.push_back(sense *
                   math::Vec3{kAlong[k] == 0 ? 1.0 : 0.0, kAlong[k] == 1 ? 1.0 : 0.0, kAlong[k] == 2 ? 1.0 : 0.0});
    const auto across = [&](int axis) { return kAlong[k] == axis ? kAlongInertia : 1.0 / 12.0; };
    const bool fixed = k == kJoints - 1;
    rods.push_back(std::make_unique<physics::Body>(
        mass_only(fixed ? 0.0 : 1.0, {across(0), across(1), across(2)}, {at + half.back(), {}})));
    world.add(*rods.back());
    at = at + 2.0 * half.back();
  }
  for (std::size_t k = 0; k < kJoints; ++k) {
    const std::size_t before = (k + kJoints - 1) % kJoints;
    const math::Vec3 axis{kAxis[k] == 0 ? 1.0 : 0.0, kAxis[k] == 1 ? 1.0 : 0.0, kAxis[k] == 2 ? 1.0 : 0.0};
    joints.push_back(std::make_unique<physics::Joint>(
        joint_of(state::JointType::revolute, half[before], -half[k], axis), *rods[before], *rods[k]));
    world.add(*joints.back());
  }
  const double every = 0.02, seconds = 10.0;
  static const auto wanted = bricard(every, steps_in(seconds, every) + 1);
  double error = 0.0, gap = 0.0, turned = 0.0;
  for (std::size_t sample = 1; sample < wanted.size(); ++sample) {
    for (int i = steps_in(every, h); i > 0; --i) world.step();
    const math::Pose rod = rods[3]->com_pose();
    error = std::max(error, math::norm(rod.position - math::rotate(rod.orientation, half[3]) - wanted[sample]));
  }
  for (const auto& joint : joints) {
    gap = std::max(gap, joint->gap().position);
    turned = std::max(turned, joint->gap().angle);
  }
  return {{"position, m", error}, {"gap, m", gap}, {"gap, rad", turned}};
}

}  // namespace ambf::accuracy
