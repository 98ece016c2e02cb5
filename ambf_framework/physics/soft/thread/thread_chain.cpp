// Implicit Euler: (x - x0) / h = v, M (v - v0) / h = F(x). Newton's method finds v; each of its linear systems has
// three rows a node and couples nodes up to two apart, and is solved by Cholesky's factors of the band.
//
// The stiffness across a stretched segment is its tension by its length. Of a thread that hardly stretches a turn
// within the step looks, to the first order, like a stretch, and its tension would stiffen the thread against the very
// turn. So tension is an unknown of its own: what the last linear system says of it, not what the strain of the guess
// does (Tournier et al., Stable Constrained Dynamics, 2015). Where a round would turn a segment too far for its linear
// system to mean anything, it is made again with more tension in all segments: it moves less, and no momentum is lost.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "physics/soft/detail/thread_chain.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kMaxRotation = 0.5;  // rad, of a segment in a round
constexpr double kTouching = 1e-5;    // m, outside a body: it counts as touching
constexpr double kShortest = 1e-3;    // of a segment's length: shorter ones have no direction
constexpr double kMinPivot = 1e-9;    // of a pivot by its mass: below it the system is not positive

}  // namespace

ThreadChain::ThreadChain(const ThreadDefinition& given) {
  const std::size_t n = given.nodes.size();
  const ThreadMaterial& of = given.material;
  const double area = std::numbers::pi * of.radius * of.radius;
  stretching_ = std::max(of.young * area, of.min_stretching);
  const double bending = of.young * area * of.radius * of.radius / 4.0;
  for (std::size_t i = 0; i + 1 < n; ++i) length_.push_back(math::norm(given.nodes[i + 1] - given.nodes[i]));
  mass_.assign(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (const std::size_t node : {i, i + 1}) mass_[node] += 0.5 * of.density * area * length_[i];
  bending_.assign(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) bending_[i] = bending / (0.5 * (length_[i - 1] + length_[i]));
  fixed_.assign(n, 0);
  for (const std::uint32_t node : given.fixed) fixed_[node] = 1;
  any_fixed_ = !given.fixed.empty();
  for (const Vec3& node : given.nodes) x_.push_back(given.T_world_body * node);
  v_.assign(n, {});
  force_ = from_ = before_ = residual_ = v_;
  tension_.assign(n - 1, 0.0);
  band_.resize(3 * n);
  right_.resize(3 * n);
}

ThreadPoint ThreadChain::point_at(double s) const {
  double left = std::max(s, 0.0);
  for (std::uint32_t i = 0; i < length_.size(); ++i) {
    if (left <= length_[i]) return {i, left / length_[i]};
    left -= length_[i];
  }
  return {static_cast<std::uint32_t>(length_.size() - 1), 1.0};
}

Vec3 ThreadChain::tangent(std::size_t segment) const {
  const Vec3 along = x_[segment + 1] - x_[segment];
  const double size = math::norm(along);
  return size > kShortest * length_[segment] ? along / size : Vec3{0, 0, 1};
}

void ThreadChain::put(std::size_t node, const Vec3& x, const Vec3& v) {
  x_[node] = x;
  v_[node] = v;
}

void ThreadChain::forget_tension() { std::fill(tension_.begin(), tension_.end(), 0.0); }
void ThreadChain::forget_forces() { std::fill(force_.begin(), force_.end(), Vec3{}); }

void ThreadChain::add_block(std::size_t a, std::size_t b, double scale, double along, double across, const Vec3& n) {
  const double axis[3] = {n.x, n.y, n.z};
  const std::size_t low = std::max(a, b), high = std::min(a, b);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t row = 3 * low + i, column = 3 * high + k;
      if (column > row) continue;
      const double value = (along - across) * axis[i] * axis[k] + (i == k ? across : 0.0);
      band_[row][kBand + column - row] += scale * value;
    }
}

// Bends by the difference of its segments' directions, each its difference of nodes by its length at rest: with that
// the force is linear in positions, and turns of the whole cost nothing.
void ThreadChain::add_bending(double h) {
  for (std::size_t i = 1; i + 1 < x_.size(); ++i) {
    if (!(bending_[i] > 0.0)) continue;
    const double before = 1.0 / length_[i - 1], after = 1.0 / length_[i];
    const double share[3] = {before, -before - after, after};
    const Vec3 bend = x_[i - 1] * share[0] + x_[i] * share[1] + x_[i + 1] * share[2];
    for (std::size_t a = 0; a < 3; ++a) {
      residual_[i - 1 + a] -= bend * (share[a] * bending_[i] * h);
      for (std::size_t b = 0; b <= a; ++b)
        add_block(i - 1 + a, i - 1 + b, share[a] * share[b] * bending_[i] * h * h, 1.0, 1.0, {});
    }
  }
}

void ThreadChain::add_stretching(double h, double stiffened) {
  for (std::size_t i = 0; i < length_.size(); ++i) {
    const Vec3 along = x_[i + 1] - x_[i];
    const double size = math::norm(along);
    if (!(size > kShortest * length_[i])) continue;
    const Vec3 n = along / size;
    const double stiffness = stretching_ / length_[i];
    const Vec3 force = n * (stiffness * (size - length_[i]) * h);
    residual_[i] += force;
    residual_[i + 1] -= force;
    const double across = (std::max(tension_[i], 0.0) + stiffened) / size;
    add_block(i, i, h * h, stiffness, across, n);
    add_block(i + 1, i + 1, h * h, stiffness, across, n);
    add_block(i + 1, i, -h * h, stiffness, across, n);
  }
}

void ThreadChain::hold_fixed() {
  if (!any_fixed_) return;
  for (std::size_t node = 0; node < fixed_.size(); ++node) {
    if (fixed_[node] == 0) continue;
    residual_[node] = {};
    for (std::size_t row = 3 * node; row < 3 * node + 3; ++row) {
      band_[row].fill(0.0);
      band_[row][kBand] = 1.0;
      for (std::size_t below = row + 1; below <= row + kBand && below < band_.size(); ++below)
        band_[below][kBand + row - below] = 0.0;
    }
  }
}

// `right_` becomes the solution.
bool ThreadChain::solve() {
  hold_fixed();
  for (std::size_t i = 0; i < x_.size(); ++i)
    right_[3 * i] = residual_[i].x, right_[3 * i + 1] = residual_[i].y, right_[3 * i + 2] = residual_[i].z;
  const std::size_t n = band_.size();
  for (std::size_t r = 0; r < n; ++r) {
    Row& row = band_[r];
    const std::size_t first = r > kBand ? r - kBand : 0;
    double right = right_[r];
    for (std::size_t c = first; c < r; ++c) {
      const Row& above = band_[c];
      const std::size_t from = std::max(first, c > kBand ? c - kBand : 0);
      double value = row[kBand + c - r];
      for (std::size_t k = from; k < c; ++k) value -= row[kBand + k - r] * above[kBand + k - c];
      value *= above[kBand];  // the inverse of its pivot
      row[kBand + c - r] = value;
      right -= value * right_[c];
    }
    double pivot = row[kBand];
    for (std::size_t k = first; k < r; ++k) pivot -= row[kBand + k - r] * row[kBand + k - r];
    if (!(pivot > kMinPivot * mass_[r / 3])) return false;
    row[kBand] = 1.0 / std::sqrt(pivot);
    right_[r] = right * row[kBand];
  }
  for (std::size_t r = n; r-- > 0;) {
    double value = right_[r];
    for (std::size_t below = r + 1; below <= r + kBand && below < n; ++below)
      value -= band_[below][kBand + r - below] * right_[below];
    right_[r] = value * band_[r][kBand];
  }
  return true;
}

// In the first round all that touches holds: a thread is so light that without it its tension would straighten it
// through the body.
void touch(ThreadPull& pull, const Vec3& u, double h, bool first) {
  const double along = math::dot(pull.normal, u), pressed = pull.stiffness * (pull.depth - h * along);
  const double stiffness = pull.depth > 0.0 ? pull.stiffness * (1.0 + pull.calming / h) : pull.stiffness;
  const double force = pull.stiffness * pull.depth - stiffness * h * along;
  pull.pull = {};
  pull.normal_stiffness = pull.side_stiffness = 0.0;
  if (!(force > 0.0) && !(first && pull.depth > -kTouching)) return;
  pull.normal_stiffness = stiffness;
  const Vec3 after = pull.away + pull.across(u) * h;
  const double limit = pull.friction * std::max(pressed, 0.0), held = pull.stiffness * math::norm(after);
  pull.side_stiffness = held > limit ? pull.stiffness * (limit / held) : pull.stiffness;
  pull.pull = pull.normal * (pull.stiffness * pull.depth + stiffness * h * math::dot(pull.normal, pull.carried)) +
              (pull.across(pull.carried) * h - pull.away) * pull.side_stiffness;
}

void ThreadChain::add_pulls(double h, std::span<ThreadPull> pulls, bool first) {
  for (ThreadPull& pull : pulls) {
    if (pull.touches) touch(pull, velocity(pull.at) - pull.carried, h, first);
    const Vec3 force = force_of(pull, h) * h;
    const std::size_t a = pull.at.segment, b = a + 1;
    const double of_b = pull.at.share, of_a = 1.0 - of_b;
    residual_[a] += force * of_a;
    residual_[b] += force * of_b;
    const double along = pull.normal_stiffness, across = pull.side_stiffness;
    add_block(a, a, h * h * of_a * of_a, along, across, pull.normal);
    add_block(b, b, h * h * of_b * of_b, along, across, pull.normal);
    add_block(b, a, h * h * of_a * of_b, along, across, pull.normal);
  }
}

void ThreadChain::assemble(double h, const Vec3& gravity, double stiffened, std::span<ThreadPull> pulls, bool first) {
  for (Row& row : band_) row.fill(0.0);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    residual_[i] = (before_[i] - v_[i]) * mass_[i] + (force_[i] + gravity * mass_[i]) * h;
    for (std::size_t k = 0; k < 3; ++k) band_[3 * i + k][kBand] += mass_[i];
  }
  add_bending(h);
  add_stretching(h, stiffened);
  add_pulls(h, pulls, first);
}

void ThreadChain::push(const ThreadPoint& at, const Vec3& impulse) {
  residual_[at.segment] += impulse * (1.0 - at.share);
  residual_[at.segment + 1] += impulse * at.share;
}

// The tension (N) that would keep every segment from turning by more than kMaxRotation in the round that was just
// solved; 0: none does.
double ThreadChain::too_wild(double h) const {
  double needed = 0.0;
  for (std::size_t i = 0; i < length_.size(); ++i) {
    const Vec3 n = tangent(i), move = (change(i + 1) - change(i)) * h;
    const double turn = math::norm(move - n * math::dot(n, move)) / length_[i];
    if (turn <= kMaxRotation) continue;
    const double own = std::max(tension_[i], 0.0) + mass_[i] * length_[i] / (h * h);
    needed = std::max(needed, own * turn / kMaxRotation);
  }
  return needed;
}

void ThreadChain::solve_more(Columns& at, std::size_t first, std::size_t last) const {
  constexpr std::size_t kColumns = std::tuple_size_v<Columns::value_type>;
  const std::size_t n = band_.size();
  for (std::size_t r = first; r < n; ++r) {
    std::array<double, kColumns> value = at[r];
    for (std::size_t c = std::max(first, r > kBand ? r - kBand : 0); c < r; ++c)
      for (std::size_t k = 0; k < kColumns; ++k) value[k] -= band_[r][kBand + c - r] * at[c][k];
    for (std::size_t k = 0; k < kColumns; ++k) at[r][k] = fixed_[r / 3] != 0 ? 0.0 : value[k] * band_[r][kBand];
  }
  for (std::size_t r = n; r-- > last;) {
    std::array<double, kColumns> value = at[r];
    for (std::size_t below = r + 1; below <= r + kBand && below < n; ++below)
      for (std::size_t k = 0; k < kColumns; ++k) value[k] -= band_[below][kBand + r - below] * at[below][k];
    for (std::size_t k = 0; k < kColumns; ++k) at[r][k] = value[k] * band_[r][kBand];
  }
}

void ThreadChain::add_change(const Columns& columns) {
  for (std::size_t r = 0; r < right_.size(); ++r) right_[r] += columns[r][0];
}

void ThreadChain::begin() {
  from_ = x_;
  before_ = v_;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    right_[3 * i] = v_[i].x, right_[3 * i + 1] = v_[i].y, right_[3 * i + 2] = v_[i].z;
    v_[i] = {};
  }
}

void ThreadChain::follow_tension(double h) {
  for (std::size_t i = 0; i < length_.size(); ++i) {
    const Vec3 along = x_[i + 1] - x_[i];
    const double size = math::norm(along);
    if (!(size > kShortest * length_[i])) continue;
    const double longer = math::dot(along, change(i + 1) - change(i)) * (h / size);
    tension_[i] = stretching_ / length_[i] * (size - length_[i] + longer);
  }
}

void ThreadChain::keep_within(double slack, double h) {
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const Vec3 wanted = v_[i] + change(i);
    const double speed = math::norm(wanted), most = slack / h + math::norm(before_[i]);
    if (!(speed > most)) continue;
    const Vec3 kept = wanted * (most / speed) - v_[i];
    right_[3 * i] = kept.x, right_[3 * i + 1] = kept.y, right_[3 * i + 2] = kept.z;
  }
}

double ThreadChain::farthest(double h) const {
  double most = 0.0;
  for (std::size_t i = 0; i < x_.size(); ++i) most = std::max(most, math::norm(change(i)) * h);
  return most;
}

void ThreadChain::move(double h, double share) {
  for (std::size_t i = 0; i < x_.size(); ++i) {
    v_[i] += change(i) * share;
    x_[i] = from_[i] + v_[i] * h;
  }
}

Vec3 ThreadChain::force_of(const ThreadPull& pull, double h) const {
  return pull.pull - pull.holding_back(velocity(pull.at)) * h;
}

}  // namespace ambf::physics::detail
