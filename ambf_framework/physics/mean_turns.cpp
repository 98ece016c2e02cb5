#include "physics/detail/mean_turns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/detail/lanes3.h"

namespace ambf::physics::detail {

namespace {

// Iterations for the mean velocity: three do up to 0.1 rad a step.
constexpr int kMaxIterations = 12;
constexpr double kPrecision = 1e-15;  // of the momentum
constexpr double kAcceptable = 1e-9;  // of the momentum: good enough if rounding allows no better
constexpr double kSmallSquare = 0.01;

// exp(angle) v = v + c1 angle x v + c2 angle x (angle x v).
template <class T>
AMBF_INLINED Lanes3<T> turned(const Lanes3<T>& angle, const Lanes3<T>& v) {
  T square, c1, c2;
  dot(angle, angle, square);
  bool all_small = true;
  for (std::size_t i = 0; i < kLanes<T>; ++i) all_small &= lane(square, i) < kSmallSquare;
  c1 = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)));
  c2 = 0.5 - square / 24.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0 * (1.0 - square / 90.0)));
  for (std::size_t i = 0; !all_small && i < kLanes<T>; ++i) {
    if (lane(square, i) < kSmallSquare) continue;
    const double size = std::sqrt(lane(square, i));
    set_lane(c1, i, std::sin(size) / size);
    set_lane(c2, i, (1.0 - std::cos(size)) / lane(square, i));
  }
  const Lanes3<T> across = cross(angle, v);
  return v + scaled(across, c1) + scaled(cross(angle, across), c2);
}

template <class T>
AMBF_INLINED Lanes3<T> momentum_of(const Lanes3<T>& omega, const Lanes3<T>& inertia, double h) {
  const Lanes3<T> momentum = inertia * omega;
  const Lanes3<T> rate = cross(momentum, omega);  // of the momentum, seen from the body
  const Lanes3<T> a = rate / inertia;
  const Lanes3<T> correction = (cross(rate, omega) + cross(momentum, a)) + scaled_by(inertia, 2.0) * cross(omega, a) +
                               scaled_by(cross(a, momentum), 3.0);
  return turned(scaled_by(omega, 0.5 * h), momentum - scaled_by(correction, h * h / 24.0));
}

// S^-1 v of the derivative S of exp(h/2 omega) I omega to first order in h.
template <class T>
AMBF_INLINED Lanes3<T> newton_step(const Lanes3<T>& omega, const Lanes3<T>& inertia, double h, const Lanes3<T>& v) {
  const double half = 0.5 * h;
  const T xy = (inertia.z * omega.z - omega.z * inertia.y) * half;
  const T xz = (omega.y * inertia.z - inertia.y * omega.y) * half;
  const T yx = (omega.z * inertia.x - inertia.z * omega.z) * half;
  const T yz = (inertia.x * omega.x - omega.x * inertia.z) * half;
  const T zx = (inertia.y * omega.y - omega.y * inertia.x) * half;
  const T zy = (omega.x * inertia.y - inertia.x * omega.x) * half;
  const T xx = inertia.x, yy = inertia.y, zz = inertia.z;
  const T cofactor_x = yy * zz - yz * zy, cofactor_y = yz * zx - yx * zz, cofactor_z = yx * zy - yy * zx;
  const T scale = 1.0 / (xx * cofactor_x + xy * cofactor_y + xz * cofactor_z);
  return {cofactor_x * scale * v.x + (xz * zy - xy * zz) * scale * v.y + (xy * yz - xz * yy) * scale * v.z,
          cofactor_y * scale * v.x + (xx * zz - xz * zx) * scale * v.y + (xz * yx - xx * yz) * scale * v.z,
          cofactor_z * scale * v.x + (xy * zx - xx * zy) * scale * v.y + (xx * yy - xy * yx) * scale * v.z};
}

// Newton's method for up to as many turns as T has lanes, each until it has converged.
template <class T>
AMBF_INLINED void find(std::span<Turn> turns, double h) {
  const auto gather = [turns](auto&& of_turn) AMBF_INLINED_LAMBDA {
    Lanes3<T> out;
    for (std::size_t i = 0; i < kLanes<T>; ++i) {
      const btVector3& v = of_turn(turns[std::min(i, turns.size() - 1)]);
      set_lane(out.x, i, v.x());
      set_lane(out.y, i, v.y());
      set_lane(out.z, i, v.z());
    }
    return out;
  };
  const Lanes3<T> momentum = gather([](const Turn& turn) -> const btVector3& { return turn.momentum; });
  const Lanes3<T> inertia = gather([](const Turn& turn) -> const btVector3& { return turn.inertia; });
  Lanes3<T> omega = gather([](const Turn& turn) -> const btVector3& { return turn.omega; });
  std::array<double, kTurnsAtOnce> size, error;
  std::array<bool, kTurnsAtOnce> moves{};  // is not where it belongs
  std::size_t moving = turns.size();
  for (std::size_t i = 0; i < turns.size(); ++i) {
    size[i] = turns[i].momentum.length();
    error[i] = SIMD_INFINITY;
    moves[i] = true;
  }
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Lanes3<T> residual = momentum - momentum_of(omega, inertia, h);
    T square;
    dot(residual, residual, square);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      if (!moves[i]) continue;
      const double last = error[i];
      error[i] = std::sqrt(lane(square, i));
      const bool arrived = error[i] <= kPrecision * size[i] || (error[i] >= last && error[i] <= kAcceptable * size[i]);
      if (!arrived && error[i] < 1e3 * size[i]) continue;
      if (!arrived) error[i] = SIMD_INFINITY;
      moves[i] = false;
      --moving;
    }
    if (moving == 0) break;
    const Lanes3<T> step = newton_step(omega, inertia, h, residual), next = omega + step;
    if (moving == turns.size()) {
      omega = next;
      continue;
    }
    for (std::size_t i = 0; i < turns.size(); ++i) {
      if (!moves[i]) continue;
      set_lane(omega.x, i, lane(next.x, i));
      set_lane(omega.y, i, lane(next.y, i));
      set_lane(omega.z, i, lane(next.z, i));
    }
  }
  for (std::size_t i = 0; i < turns.size(); ++i) {
    turns[i].found = error[i] <= kAcceptable * size[i];
    if (turns[i].found) turns[i].omega.setValue(lane(omega.x, i), lane(omega.y, i), lane(omega.z, i));
  }
}

AMBF_WIDE void find_four(std::span<Turn> turns, double h) { find<Quad>(turns, h); }

}  // namespace

btVector3 momentum_before(const btVector3& omega, const btVector3& inertia, double h) {
  const auto v = momentum_of<double>({omega.x(), omega.y(), omega.z()}, {inertia.x(), inertia.y(), inertia.z()}, h);
  return {v.x, v.y, v.z};
}

void find_mean_velocities(std::span<Turn> turns, double h, bool wide) {
  while (!turns.empty()) {
    const std::size_t count = std::min<std::size_t>(turns.size(), wide ? kTurnsAtOnce : 2);
    const std::span<Turn> now = turns.first(count);
    if (count == 1) {
      find<double>(now, h);
    } else if (count == 2) {
      find<Pair>(now, h);
    } else {
      find_four(now, h);
    }
    turns = turns.subspan(count);
  }
}

}  // namespace ambf::physics::detail
