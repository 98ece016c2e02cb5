// Tissue as a whole: its net motion, its volume and its state.
#include <algorithm>
#include <array>

#include "physics/soft/detail/tissue_solid.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

// Solves a x = b, a symmetric and positive; rows without a pivot give 0.
template <std::size_t N>
std::array<double, N> solve(std::array<std::array<double, N>, N> a, std::array<double, N> b) {
  for (std::size_t k = 0; k < N; ++k) {
    if (!(a[k][k] > 0.0)) {
      for (std::size_t i = 0; i < N; ++i) a[k][i] = a[i][k] = 0.0;
      a[k][k] = 1.0, b[k] = 0.0;
      continue;
    }
    for (std::size_t i = k + 1; i < N; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < N; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  std::array<double, N> x{};
  for (std::size_t k = N; k-- > 0;) {
    double left = b[k];
    for (std::size_t j = k + 1; j < N; ++j) left -= a[k][j] * x[j];
    x[k] = left / a[k][k];
  }
  return x;
}

}  // namespace

// What is left of the net force, and of the net torque about the centre, goes into a motion of the whole; with that the
// change of momentum is exactly what forces and springs gave.
void TissueSolid::remove_net(double h, const TissuePulls& pulls, bool rotates) {
  double all = 0.0;
  Vec3 centre{};
  for (std::size_t i = 0; i < x_.size(); ++i) all += mass_[i], centre += x_[i] * mass_[i];
  centre = centre / all;
  std::array<double, 6> net{};
  std::array<std::array<double, 6>, 6> inertia{};
  const auto add = [&](const Vec3& r, const Vec3& to) {
    const Vec3 torque = math::cross(r, to);
    const double values[6] = {to.x, to.y, to.z, torque.x, torque.y, torque.z};
    return std::array<double, 6>{values[0], values[1], values[2], values[3], values[4], values[5]};
  };
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto motion = [&](std::size_t mode, const Vec3& r) {
    return mode < 3 ? axes[mode] : math::cross(axes[mode - 3], r);
  };
  const auto add_rows = [&](const Vec3& r, const auto& force_of_motion) {
    for (std::size_t mode = 0; mode < 6; ++mode) {
      const std::array<double, 6> row = add(r, force_of_motion(motion(mode, r)));
      for (std::size_t k = 0; k < 6; ++k) inertia[k][mode] += row[k];
    }
  };
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const Vec3 r = x_[i] - centre;
    const std::array<double, 6> one = add(r, residual_[i]);
    for (std::size_t k = 0; k < 6; ++k) net[k] += one[k];
    add_rows(r, [&](const Vec3& v) { return v * mass_[i]; });
  }
  for (const TissueSpring& spring : pulls.springs)
    add_rows(at(spring.at) - centre, [&](const Vec3& v) { return spring.holding_back(v) * (h * h); });
  for (const TissueTouch& touch : pulls.touches) {
    if (!touch.within) add_rows(touch.place - centre, [&](const Vec3& v) { return touch.holding_back(v) * (h * h); });
  }
  std::array<double, 6> moved{};
  if (rotates) {
    moved = solve<6>(inertia, net);
  } else {
    std::array<std::array<double, 3>, 3> linear{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) linear[i][k] = inertia[i][k];
    const std::array<double, 3> shift = solve<3>(linear, {net[0], net[1], net[2]});
    std::copy(shift.begin(), shift.end(), moved.begin());
  }
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const Vec3 r = x_[i] - centre;
    direction_[i] = Vec3{moved[0], moved[1], moved[2]} + math::cross({moved[3], moved[4], moved[5]}, r);
    change_[i] += direction_[i];
  }
}

// A light sheet may end up elsewhere than its touches expected as the step began: what rubs more than the friction of
// what presses then is held to that. False: there is none.
bool TissueSolid::undo_touches(double h, std::span<TissueTouch> touches) {
  if (lightness_.empty()) return false;
  bool any = false;
  for (TissueTouch& touch : touches) {
    const Vec3 force = touch.pull - touch.holding_back(sum(v_, touch) + sum(change_, touch)) * h;
    const double along = math::dot(force, touch.normal);
    const double limit = touch.friction * std::clamp(along, 0.0, touch.push);
    const Vec3 side = force - touch.normal * along;
    const double rubs = math::norm(side);
    if (!(rubs > limit)) continue;
    any = true;
    const Vec3 left = side * (limit / rubs);
    for (std::size_t k = 0; k < touch.corners; ++k)
      if (fixed_[touch.corner[k]] == 0) residual_[touch.corner[k]] += (left - side) * (h * touch.weight[k]);
    touch.pull = touch.normal * math::dot(touch.pull, touch.normal) + left;
    touch.side_stiffness = 0.0;
  }
  return any;
}

double TissueSolid::volume() const {
  double all = 0.0;
  for (std::size_t i = 0; i < hot_.size(); ++i) {
    const std::uint32_t* c = hot_[i].corner;
    const Vec3 o = x_[c[0]];
    all += cold_[i].share * math::dot(x_[c[1]] - o, math::cross(x_[c[2]] - o, x_[c[3]] - o)) / 6.0;
  }
  return all + sheet_.volume(x_);
}

void TissueSolid::put(const std::vector<Vec3>& positions) {
  x_ = positions;
  std::fill(v_.begin(), v_.end(), Vec3{});
  std::fill(force_.begin(), force_.end(), Vec3{});
}

void TissueSolid::stop() { std::fill(v_.begin(), v_.end(), Vec3{}); }

std::size_t TissueSolid::state_size() const { return 6 * x_.size() + 10 * cold_.size() + sheet_.state_size(); }

void TissueSolid::get_state(std::vector<double>& out) const {
  out.clear();
  for (std::size_t i = 0; i < x_.size(); ++i)
    out.insert(out.end(), {x_[i].x, x_[i].y, x_[i].z, v_[i].x, v_[i].y, v_[i].z});
  for (const Cold& e : cold_)
    out.insert(out.end(), {e.rotation.x, e.rotation.y, e.rotation.z, e.rotation.w, e.relaxed.xx, e.relaxed.yy,
                           e.relaxed.zz, e.relaxed.yz, e.relaxed.zx, e.relaxed.xy});
  sheet_.get_state(out);
}

void TissueSolid::set_state(std::span<const double> state) {
  const double* from = state.data();
  for (std::size_t i = 0; i < x_.size(); ++i, from += 6) {
    x_[i] = {from[0], from[1], from[2]};
    v_[i] = {from[3], from[4], from[5]};
    force_[i] = {};
  }
  for (Cold& e : cold_) {
    e.rotation = {from[0], from[1], from[2], from[3]};
    e.relaxed = {from[4], from[5], from[6], from[7], from[8], from[9]};
    from += 10;
  }
  sheet_.set_state(from);
}

void TissueSolid::reset(const math::Pose& T_world_body) {
  for (std::size_t i = 0; i < x_.size(); ++i) {
    x_[i] = T_world_body * rest_[i];
    v_[i] = force_[i] = {};
  }
  for (Cold& e : cold_) {
    e.rotation = T_world_body.orientation;
    e.relaxed = {};
  }
  sheet_.reset();
}

}  // namespace ambf::physics::detail
