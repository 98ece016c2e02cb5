#include "physics/soft/detail/tissue_solid.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr int kRotationSweeps = 8;  // towards an element's rotation, from the one of the step before
constexpr double kRotated = 1e-5;   // rad: closer is close enough
constexpr int kMaxIterations = 100, kMaxWanted = 1000000;
constexpr double kSmallest = 1e-30;  // J: below it there is nothing to solve

// Most points are at one corner.
bool is_at_first(const TissuePoint& point) {
  return point.weight[1] == 0.0 && point.weight[2] == 0.0 && point.weight[3] == 0.0;
}

void pull_at(const TissuePoint& point, const Vec3& force, std::vector<Vec3>& to) {
  to[point.corner[0]] += force * point.weight[0];
  if (is_at_first(point)) return;
  for (int k = 1; k < 4; ++k) to[point.corner[k]] += force * point.weight[k];
}

// Adds a force to the first point of a link, and takes it from the second.
void pull_together(const TissueLink& link, const Vec3& force, std::vector<Vec3>& to) {
  for (int k = 0; k < 4; ++k) {
    to[link.first.corner[k]] += force * link.first.weight[k];
    to[link.second.corner[k]] -= force * link.second.weight[k];
  }
}

void push_apart(const TissueTouch& touch, const Vec3& on_point, std::vector<Vec3>& to) {
  for (std::size_t k = 0; k < touch.corners; ++k) to[touch.corner[k]] += on_point * touch.weight[k];
}

}  // namespace

// After Mueller and others, 2016.
math::Quat fit_rotation(math::Quat rotation, const Vec3 (&columns)[3], int sweeps) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const Vec3 a = math::rotate(rotation, {1, 0, 0}), b = math::rotate(rotation, {0, 1, 0}), c = math::cross(a, b);
    const double along = math::dot(a, columns[0]) + math::dot(b, columns[1]) + math::dot(c, columns[2]);
    const Vec3 across = math::cross(a, columns[0]) + math::cross(b, columns[1]) + math::cross(c, columns[2]);
    const Vec3 half = across / (2.0 * std::max(std::abs(along), 1e-30));
    rotation = math::Quat{half.x, half.y, half.z, 1.0} * rotation;
    const double size = 1.0 / math::norm(rotation);
    rotation = {rotation.x * size, rotation.y * size, rotation.z * size, rotation.w * size};
    if (math::dot(half, half) < kRotated * kRotated) break;
  }
  return rotation;
}

TissueSolid::TissueSolid(const TissueDefinition& given)
    : rest_(given.grid.corners),
      mass_(rest_.size(), 0.0),
      sheet_(given, mass_),
      share_(given.material.share),
      time_(given.material.time) {
  const TissueMaterial& material = given.material;
  mu_ = 0.5 * material.young / (1.0 + material.poisson);
  lambda_ = material.young * material.poisson / ((1.0 + material.poisson) * (1.0 - 2.0 * material.poisson));
  fixed_.assign(rest_.size(), 0);
  for (const std::uint32_t corner : given.fixed) fixed_[corner] = 1;
  any_fixed_ = !given.fixed.empty();
  for (const TissueElement& element : given.grid.elements) {
    Hot hot{};
    Cold cold{};
    std::copy(element.corner.begin(), element.corner.end(), hot.corner);
    const Vec3 o = rest_[hot.corner[0]];
    const Vec3 a = rest_[hot.corner[1]] - o, b = rest_[hot.corner[2]] - o, c = rest_[hot.corner[3]] - o;
    const double six = math::dot(a, math::cross(b, c));
    cold.gradient[0] = math::cross(b, c) / six;
    cold.gradient[1] = math::cross(c, a) / six;
    cold.gradient[2] = math::cross(a, b) / six;
    cold.volume = element.share * six / 6.0;
    cold.share = element.share;
    cold.stiffness = element.stiffness;
    cold.mass = cold.volume * material.density * element.density;
    for (const std::uint32_t corner : element.corner) mass_[corner] += 0.25 * cold.mass;
    hot_.push_back(hot);
    cold_.push_back(cold);
  }
  for (auto* room : {&x_, &v_, &force_, &change_, &residual_, &direction_, &product_}) room->resize(rest_.size());
  if (sheet_.triangle_count() > 0) lightness_.resize(rest_.size());
  x_ = rest_;
  choose_iterations(given.step_s);
  reset(given.T_world_body);
}

// Conjugate gradients need as many iterations as the root of the largest eigenvalue, which is found by powers.
void TissueSolid::choose_iterations(double h) {
  begin(h);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const auto wave = static_cast<double>(i % 7) - 3.0;
    direction_[i] = Vec3{1.0 + wave, 2.0 - wave, (i % 2 == 0 ? 1.0 : -1.0) * (wave + 0.5)};
  }
  double largest = 0.0;
  for (int power = 0; power < 20; ++power) {
    add_stiffness_force(direction_, product_);
    double size = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      product_[i] = fixed_[i] != 0 ? Vec3{} : product_[i] / -mass_[i];
      size += math::dot(product_[i], product_[i]);
    }
    size = std::sqrt(size);
    if (!(size > 0.0)) break;
    for (std::size_t i = 0; i < x_.size(); ++i) direction_[i] = product_[i] / size;
    largest = power == 0 ? 0.0 : size;
  }
  const double wanted = std::ceil(1.5 * std::sqrt(1.0 + h * h * largest));
  wanted_iterations_ = wanted < kMaxWanted ? static_cast<int>(wanted) : kMaxWanted;
  iterations_ = std::clamp(wanted_iterations_, 6, kMaxIterations);
}

Vec3 TissueSolid::sum(const std::vector<Vec3>& of, const TissuePoint& p) {
  if (is_at_first(p)) return of[p.corner[0]] * p.weight[0];
  return of[p.corner[0]] * p.weight[0] + of[p.corner[1]] * p.weight[1] + of[p.corner[2]] * p.weight[2] +
         of[p.corner[3]] * p.weight[3];
}

Vec3 TissueSolid::sum(const std::vector<Vec3>& of, const TissueTouch& touch) {
  Vec3 all{};
  for (std::size_t k = 0; k < touch.corners; ++k) all += of[touch.corner[k]] * touch.weight[k];
  return all;
}

// The symmetric part of the sum of d_i times the gradients: the strain of displacements d, in world axes.
TissueSolid::Symmetric TissueSolid::strain(const Hot& e, const Vec3& d1, const Vec3& d2, const Vec3& d3) {
  const Vec3 &a = e.gradient[0], &b = e.gradient[1], &c = e.gradient[2];
  return {d1.x * a.x + d2.x * b.x + d3.x * c.x,
          d1.y * a.y + d2.y * b.y + d3.y * c.y,
          d1.z * a.z + d2.z * b.z + d3.z * c.z,
          0.5 * (d1.y * a.z + d2.y * b.z + d3.y * c.z + d1.z * a.y + d2.z * b.y + d3.z * c.y),
          0.5 * (d1.z * a.x + d2.z * b.x + d3.z * c.x + d1.x * a.z + d2.x * b.z + d3.x * c.z),
          0.5 * (d1.x * a.y + d2.x * b.y + d3.x * c.y + d1.y * a.x + d2.y * b.x + d3.y * c.x)};
}

// Hooke's stress of that strain, as forces on the corners.
void TissueSolid::add_stress(const Hot& e, const Symmetric& s, std::vector<Vec3>& forces) {
  const double even = e.pressure * (s.xx + s.yy + s.zz);
  const double xx = e.shear * s.xx + even, yy = e.shear * s.yy + even, zz = e.shear * s.zz + even;
  const double yz = e.shear * s.yz, zx = e.shear * s.zx, xy = e.shear * s.xy;
  Vec3 all{};
  for (int k = 0; k < 3; ++k) {
    const Vec3& g = e.gradient[k];
    const Vec3 force{xx * g.x + xy * g.y + zx * g.z, xy * g.x + yy * g.y + yz * g.z, zx * g.x + yz * g.y + zz * g.z};
    forces[e.corner[k + 1]] -= force;
    all += force;
  }
  forces[e.corner[0]] += all;
}

// Rotations, gradients, what relaxed, and the forces of the elements as they are: added to residual_.
void TissueSolid::begin(double h) {
  const bool relaxes = share_ < 1.0;
  const double pace = h / (time_ + h), memory = relaxes ? 1.0 - share_ : 0.0;
  for (std::size_t i = 0; i < hot_.size(); ++i) {
    Hot& hot = hot_[i];
    Cold& cold = cold_[i];
    const Vec3 o = x_[hot.corner[0]];
    const Vec3 d1 = x_[hot.corner[1]] - o, d2 = x_[hot.corner[2]] - o, d3 = x_[hot.corner[3]] - o;
    const Vec3 &a = cold.gradient[0], &b = cold.gradient[1], &c = cold.gradient[2];
    const Vec3 columns[3] = {d1 * a.x + d2 * b.x + d3 * c.x, d1 * a.y + d2 * b.y + d3 * c.y,
                             d1 * a.z + d2 * b.z + d3 * c.z};
    cold.rotation = fit_rotation(cold.rotation, columns, kRotationSweeps);
    for (int k = 0; k < 3; ++k) hot.gradient[k] = math::rotate(cold.rotation, cold.gradient[k]);
    const double scale = cold.stiffness * cold.volume;
    hot.shear = 2.0 * mu_ * scale, hot.pressure = lambda_ * scale;
    Symmetric now = strain(hot, d1, d2, d3);
    now.xx -= 1.0, now.yy -= 1.0, now.zz -= 1.0;
    if (relaxes) {
      // In the element's axes, so that a turn leaves it as it is.
      const math::Quat back = math::inverse(cold.rotation);
      const auto turned = [](const math::Quat& q, const Symmetric& s) {
        const Vec3 ex = math::rotate(math::inverse(q), {1, 0, 0}), ey = math::rotate(math::inverse(q), {0, 1, 0}),
                   ez = math::rotate(math::inverse(q), {0, 0, 1});
        const auto times = [&](const Vec3& v) {
          return Vec3{s.xx * v.x + s.xy * v.y + s.zx * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
                      s.zx * v.x + s.yz * v.y + s.zz * v.z};
        };
        const Vec3 tx = times(ex), ty = times(ey), tz = times(ez);
        return Symmetric{math::dot(ex, tx), math::dot(ey, ty), math::dot(ez, tz),
                         math::dot(ey, tz), math::dot(ez, tx), math::dot(ex, ty)};
      };
      const Symmetric own = turned(back, now);
      Symmetric& q = cold.relaxed;
      q = {q.xx + pace * (own.xx - q.xx), q.yy + pace * (own.yy - q.yy), q.zz + pace * (own.zz - q.zz),
           q.yz + pace * (own.yz - q.yz), q.zx + pace * (own.zx - q.zx), q.xy + pace * (own.xy - q.xy)};
      const Symmetric lost = turned(cold.rotation, q);
      now = {now.xx - memory * lost.xx, now.yy - memory * lost.yy, now.zz - memory * lost.zz,
             now.yz - memory * lost.yz, now.zx - memory * lost.zx, now.xy - memory * lost.xy};
    }
    add_stress(hot, now, residual_);
  }
  sheet_.begin(x_, h, residual_);
}

void TissueSolid::add_stiffness_force(const std::vector<Vec3>& u, std::vector<Vec3>& to, double taut) {
  std::fill(to.begin(), to.end(), Vec3{});
  for (const Hot& e : hot_) {
    const Vec3 o = u[e.corner[0]];
    add_stress(e, strain(e, u[e.corner[1]] - o, u[e.corner[2]] - o, u[e.corner[3]] - o), to);
  }
  sheet_.add_stiffness_force(u, to, taut);
}

double TissueSolid::multiply(const std::vector<Vec3>& u, std::vector<Vec3>& to, double h, const TissuePulls& pulls) {
  add_stiffness_force(u, to);
  for (const TissueSpring& spring : pulls.springs) pull_at(spring.at, -spring.holding_back(sum(u, spring.at)), to);
  for (const TissueLink& link : pulls.links)
    pull_together(link, -link.holding_back(sum(u, link.first) - sum(u, link.second)), to);
  for (const TissueTouch& touch : pulls.touches) push_apart(touch, -touch.holding_back(sum(u, touch)), to);
  double along = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    to[i] = fixed_[i] != 0 ? Vec3{} : u[i] * mass_[i] - to[i] * (h * h);
    along += math::dot(u[i], to[i]);
  }
  return along;
}

// A sheet is light beside what holds and touches it: by mass alone, many more iterations would be needed.
void TissueSolid::find_lightness(double h, const TissuePulls& pulls) {
  if (lightness_.empty()) return;
  std::fill(lightness_.begin(), lightness_.end(), Symmetric{});
  const auto add = [&](const auto& spring, std::uint32_t corner, double weight) {
    const double share = h * h * weight * weight;
    if (!(share > 0.0)) return;
    Symmetric& heavy = lightness_[corner];
    const Vec3& n = spring.normal;
    const double side = share * spring.side_stiffness, more = share * spring.normal_stiffness - side;
    heavy.xx += side + more * n.x * n.x, heavy.yy += side + more * n.y * n.y, heavy.zz += side + more * n.z * n.z;
    heavy.yz += more * n.y * n.z, heavy.zx += more * n.z * n.x, heavy.xy += more * n.x * n.y;
  };
  for (const TissueSpring& spring : pulls.springs)
    for (std::size_t k = 0; k < 4; ++k) add(spring, spring.at.corner[k], spring.at.weight[k]);
  for (const TissueTouch& touch : pulls.touches)
    for (std::size_t k = 0; k < touch.corners; ++k) add(touch, touch.corner[k], touch.weight[k]);
  for (std::size_t i = 0; i < lightness_.size(); ++i) {
    Symmetric& a = lightness_[i];
    a.xx += mass_[i], a.yy += mass_[i], a.zz += mass_[i];
    const double xx = a.yy * a.zz - a.yz * a.yz, xy = a.yz * a.zx - a.xy * a.zz, zx = a.xy * a.yz - a.yy * a.zx;
    const double size = a.xx * xx + a.xy * xy + a.zx * zx;
    a = {xx / size,
         (a.xx * a.zz - a.zx * a.zx) / size,
         (a.xx * a.yy - a.xy * a.xy) / size,
         (a.xy * a.zx - a.xx * a.yz) / size,
         zx / size,
         xy / size};
  }
}

Vec3 TissueSolid::moved(std::size_t i, const Vec3& by) const {
  if (lightness_.empty()) return by / mass_[i];
  const Symmetric& a = lightness_[i];
  return {a.xx * by.x + a.xy * by.y + a.zx * by.z, a.xy * by.x + a.yy * by.y + a.yz * by.z,
          a.zx * by.x + a.yz * by.y + a.zz * by.z};
}

// Goes on from change_, of which residual_ is what is missing.
void TissueSolid::converge(double h, const TissuePulls& pulls, int iterations) {
  const std::size_t n = x_.size();
  find_lightness(h, pulls);
  double size = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    direction_[i] = moved(i, residual_[i]);
    size += math::dot(residual_[i], direction_[i]);
  }
  for (int k = 0; k < iterations && size > kSmallest; ++k) {
    const double share = size / multiply(direction_, product_, h, pulls);
    double left = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      change_[i] += direction_[i] * share;
      residual_[i] -= product_[i] * share;
      product_[i] = moved(i, residual_[i]);
      left +=
          lightness_.empty() ? math::dot(residual_[i], residual_[i]) / mass_[i] : math::dot(residual_[i], product_[i]);
    }
    const double keep = left / size;
    size = left;
    for (std::size_t i = 0; i < n; ++i) direction_[i] = product_[i] + direction_[i] * keep;
  }
}

// False: there is none that pulls.
bool TissueSolid::undo_pulling(double h, std::span<TissueSpring> springs) {
  bool any = false;
  for (TissueSpring& spring : springs) {
    if (!spring.pushes) continue;
    const Vec3 force = spring.pull - spring.holding_back(sum(v_, spring.at) + sum(change_, spring.at)) * h;
    if (!(math::dot(force, spring.normal) < 0.0)) continue;
    any = true;
    for (std::size_t k = 0; k < 4; ++k)
      if (fixed_[spring.at.corner[k]] == 0) residual_[spring.at.corner[k]] -= force * (h * spring.at.weight[k]);
    spring.pull = {};
    spring.normal_stiffness = spring.side_stiffness = 0.0;
  }
  return any;
}

void TissueSolid::step(double h, const Vec3& gravity, const TissuePulls& pulls) {
  const std::size_t n = x_.size();
  for (std::size_t i = 0; i < n; ++i) residual_[i] = force_[i] + gravity * mass_[i];
  begin(h);
  // A free sheet that turns is taut all over: there tension must not hold back what turns as a whole.
  const bool is_free = !any_fixed_ && pulls.springs.empty() && pulls.touches.empty();
  add_stiffness_force(v_, product_, is_free ? 0.0 : 1.0);
  for (std::size_t i = 0; i < n; ++i) residual_[i] = (residual_[i] + product_[i] * h) * h;
  for (const TissueSpring& spring : pulls.springs)
    pull_at(spring.at, (spring.pull - spring.holding_back(sum(v_, spring.at)) * h) * h, residual_);
  for (const TissueLink& link : pulls.links) pull_together(link, force_of(link, h) * h, residual_);
  for (const TissueTouch& touch : pulls.touches) push_apart(touch, force_of(touch, h) * h, residual_);
  for (std::size_t i = 0; i < n; ++i)
    if (fixed_[i] != 0) residual_[i] = {};
  std::fill(change_.begin(), change_.end(), Vec3{});
  if (!any_fixed_) {
    remove_net(h, pulls, true);
    multiply(direction_, product_, h, pulls);
    for (std::size_t i = 0; i < n; ++i) residual_[i] -= product_[i];
  }
  converge(h, pulls, iterations_);
  const bool pulled = undo_pulling(h, pulls.springs), rubbed = undo_touches(h, pulls.touches);
  if (pulled || rubbed) converge(h, pulls, iterations_ / 2);
  if (!any_fixed_) remove_net(h, pulls, false);
  for (std::size_t i = 0; i < n; ++i) {
    v_[i] += change_[i];
    x_[i] += v_[i] * h;
    force_[i] = {};
  }
  pushed_ = false;
}

Vec3 TissueSolid::force_of(const TissueSpring& spring, double h) const {
  return spring.pull - spring.holding_back(sum(v_, spring.at)) * h;
}

Vec3 TissueSolid::force_of(const TissueLink& link, double h) const {
  return link.pull - link.holding_back(sum(v_, link.first) - sum(v_, link.second)) * h;
}

Vec3 TissueSolid::force_of(const TissueTouch& touch, double h) const {
  return touch.pull - touch.holding_back(sum(v_, touch)) * h;
}

}  // namespace ambf::physics::detail
