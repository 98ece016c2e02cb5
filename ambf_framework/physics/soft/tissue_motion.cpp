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

using Inertia = std::array<std::array<double, 6>, 6>;  // what a unit of motion takes, three shifts and three turns

// What a spring takes: of the net force, and of the torque about the centre that r is from; of the first three or of
// all motions.
template <class Spring>
void add_rows(const Spring& spring, const Vec3& r, double share, std::size_t modes, Inertia& inertia) {
  const double v[3][6] = {{1, 0, 0, 0, r.z, -r.y}, {0, 1, 0, -r.z, 0, r.x}, {0, 0, 1, r.y, -r.x, 0}};
  const Vec3& n = spring.normal;
  const double side = spring.side_stiffness, more = spring.normal_stiffness - side;
  const auto add = [&](std::size_t count) {
    double f[3][6];
    for (std::size_t mode = 0; mode < count; ++mode) {
      const double along = more * (n.x * v[0][mode] + n.y * v[1][mode] + n.z * v[2][mode]);
      f[0][mode] = (v[0][mode] * side + n.x * along) * share;
      f[1][mode] = (v[1][mode] * side + n.y * along) * share;
      f[2][mode] = (v[2][mode] * side + n.z * along) * share;
    }
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t mode = 0; mode < count; ++mode) inertia[k][mode] += f[k][mode];
    if (count == 3) return;
    for (std::size_t mode = 0; mode < count; ++mode) {
      inertia[3][mode] += r.y * f[2][mode] - r.z * f[1][mode];
      inertia[4][mode] += r.z * f[0][mode] - r.x * f[2][mode];
      inertia[5][mode] += r.x * f[1][mode] - r.y * f[0][mode];
    }
  };
  modes == 6 ? add(6) : add(3);
}

}  // namespace

// What corners take when they turn about the centre, and by that shift.
void TissueSolid::add_masses(const Vec3& centre, std::array<std::array<double, 6>, 6>& inertia) const {
  Vec3 first{}, own{}, after{}, before{};
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const Vec3 r = x_[i] - centre, p = r * mass_[i];
    first += p;
    own += Vec3{r.y * p.y + r.z * p.z, r.z * p.z + r.x * p.x, r.x * p.x + r.y * p.y};
    after += Vec3{r.x * p.y, r.y * p.z, r.z * p.x};
    before += Vec3{r.y * p.x, r.z * p.y, r.x * p.z};
  }
  const double rows[3][3] = {{0, -first.z, first.y}, {first.z, 0, -first.x}, {-first.y, first.x, 0}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) inertia[3 + i][k] = inertia[k][3 + i] = rows[i][k];
  inertia[3][3] = own.x, inertia[4][4] = own.y, inertia[5][5] = own.z;
  inertia[4][3] = -after.x, inertia[5][4] = -after.y, inertia[3][5] = -after.z;
  inertia[3][4] = -before.x, inertia[4][5] = -before.y, inertia[5][3] = -before.z;
}

// What is left of the net force, and of the net torque about the centre, goes into a motion of the whole; with that the
// change of momentum is exactly what forces and springs gave.
void TissueSolid::remove_net(double h, const TissuePulls& pulls, bool rotates) {
  double all = 0.0;
  Vec3 centre{};
  for (std::size_t i = 0; i < x_.size(); ++i) all += mass_[i], centre += x_[i] * mass_[i];
  centre = centre / all;
  std::array<double, 6> net{};
  Inertia inertia{};
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const Vec3 r = x_[i] - centre, torque = math::cross(r, residual_[i]);
    net[0] += residual_[i].x, net[1] += residual_[i].y, net[2] += residual_[i].z;
    net[3] += torque.x, net[4] += torque.y, net[5] += torque.z;
  }
  for (std::size_t k = 0; k < 3; ++k) inertia[k][k] = all;
  if (rotates) add_masses(centre, inertia);
  const std::size_t modes = rotates ? 6 : 3;
  for (const TissueSpring& spring : pulls.springs) add_rows(spring, at(spring.at) - centre, h * h, modes, inertia);
  for (const TissueTouch& touch : pulls.touches)
    if (!touch.within) add_rows(touch, touch.place - centre, h * h, modes, inertia);
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
