#include "physics/soft/detail/tissue_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/rotation.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kFlat = 1e-18;  // m^2: the area below which a triangle has no plane

}  // namespace

TissueSheet::TissueSheet(const TissueDefinition& given, std::vector<double>& mass)
    : share_(given.material.share), time_(given.material.time) {
  if (given.grid.triangles.empty()) return;
  const TissueMaterial& material = given.material;
  const std::vector<Vec3>& at = given.grid.corners;
  modulus_ = material.young / (1.0 - material.poisson * material.poisson);
  for (const TissueTriangle& each : given.grid.triangles) {
    Triangle made{};
    Rest rest;
    std::copy(each.corner.begin(), each.corner.end(), made.corner);
    const Vec3 d1 = at[each.corner[1]] - at[each.corner[0]], d2 = at[each.corner[2]] - at[each.corner[0]];
    const Vec3 out = math::cross(d1, d2);
    made.normal = math::normalized(out);
    made.along = math::normalized(d1);
    made.across = math::cross(made.normal, made.along);
    const double ax = math::norm(d1), bx = math::dot(made.along, d2), by = math::dot(made.across, d2);
    made.ax = 1.0 / ax, made.ay = -bx / (ax * by), made.by = 1.0 / by;
    rest.area = 0.5 * math::norm(out);
    rest.thickness = given.grid.thickness;
    const double volume = rest.area * rest.thickness;
    made.shear = material.young / (1.0 + material.poisson) * volume * each.stiffness;
    made.even = material.poisson * modulus_ * volume * each.stiffness;
    rest.mass = volume * material.density * each.density;
    for (const std::uint32_t corner : each.corner) mass[corner] += rest.mass / 3.0;
    triangles_.push_back(made);
    rests_.push_back(rest);
  }
  bending_.assign(triangles_.size(), Bending{{kNone, kNone, kNone}, {}});
  add_hinges(given);
  set_bending(given);
  bends_.resize(hinges_.size());
  moments_.resize(hinges_.size());
  first_ = frame_of_first(at);
}

// Where two triangles meet along an edge they are hinged; seen by the way round of the first.
void TissueSheet::add_hinges(const TissueDefinition& given) {
  struct Side {
    std::uint32_t triangle, corner;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles_[t].corner[(k + 1) % 3], b = triangles_[t].corner[(k + 2) % 3];
      edges[std::minmax(a, b)].push_back({t, k});
    }
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2) continue;
    const auto [first, second] = std::pair(sides[0], sides[1]);
    Hinge hinge{};
    const std::uint32_t* corner = triangles_[first.triangle].corner;
    hinge.corner[0] = corner[(first.corner + 1) % 3], hinge.corner[1] = corner[(first.corner + 2) % 3];
    hinge.corner[2] = corner[first.corner], hinge.corner[3] = triangles_[second.triangle].corner[second.corner];
    for (std::uint32_t k = 0; k < 3; ++k) hinge.slot[k] = 3 * first.triangle + (first.corner + 1 + k) % 3;
    hinge.slot[3] = 3 * second.triangle + second.corner;
    const auto number = static_cast<std::uint32_t>(hinges_.size());
    bending_[first.triangle].hinge[first.corner] = bending_[second.triangle].hinge[second.corner] = number;
    // Along their edge, neighbours run opposite ways; a triangle that is turned over sees the bend from behind.
    const bool turned = triangles_[second.triangle].corner[(second.corner + 1) % 3] == hinge.corner[0];
    rests_[second.triangle].side[second.corner] = turned ? -1.0 : 1.0;
    measure(given.grid.corners, hinge, hinge.angle);
    hinges_.push_back(hinge);
  }
}

// The curvature of a triangle is the mean of n n^T times what each edge bends by, its length over twice the area: that
// of the plane's gradients over its edges, as the divergence theorem has it (Onate and Zarate, 2000). At an edge of the
// sheet no moment acts: the angle there is whichever costs nothing.
void TissueSheet::set_bending(const TissueDefinition& given) {
  const double nu = given.material.poisson;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& triangle = triangles_[t];
    const double h = rests_[t].thickness, area = rests_[t].area;
    const double rigidity = modulus_ * given.grid.triangles[t].stiffness * h * h * h / 12.0;
    Vec3 out[3];
    double length[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge =
          given.grid.corners[triangle.corner[(k + 2) % 3]] - given.grid.corners[triangle.corner[(k + 1) % 3]];
      length[k] = math::norm(edge);
      out[k] = math::cross(edge / length[k], triangle.normal);
    }
    std::array<std::array<double, 3>, 3> b{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double cosine = math::dot(out[i], out[k]);
        b[i][k] = rigidity * length[i] * length[k] / (4.0 * area) * ((1.0 - nu) * cosine * cosine + nu);
      }
    for (std::size_t i = 0; i < 3; ++i)  // as the hinges see it
      for (std::size_t k = 0; k < 3; ++k) b[i][k] *= rests_[t].side[i] * rests_[t].side[k];
    const double moment[6] = {b[0][0], b[1][1], b[2][2], b[0][1], b[1][2], b[2][0]};
    std::copy(std::begin(moment), std::end(moment), rests_[t].moment);
    free_edges(t);
  }
}

// Of the edges that do not bend, those of the sheet and of cuts, the angles are solved for.
void TissueSheet::free_edges(std::size_t t) {
  const double* m = rests_[t].moment;
  double b[3][3] = {{m[0], m[3], m[5]}, {m[3], m[1], m[4]}, {m[5], m[4], m[2]}};
  const double least = 1e-9 * (m[0] + m[1] + m[2]);
  for (std::size_t free = 0; free < 3; ++free) {
    const std::uint32_t hinge = bending_[t].hinge[free];
    if (hinge != kNone && !hinges_[hinge].open) continue;
    const double row[3] = {b[free][0], b[free][1], b[free][2]};
    if (row[free] > least)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) b[i][k] -= row[i] * row[k] / row[free];
    for (std::size_t i = 0; i < 3; ++i) b[free][i] = b[i][free] = 0.0;
  }
  const double moment[6] = {b[0][0], b[1][1], b[2][2], b[0][1], b[1][2], b[2][0]};
  std::copy(std::begin(moment), std::end(moment), bending_[t].moment);
}

void TissueSheet::part_at(const std::vector<TissueSeam>& seams, const std::vector<std::uint8_t>& open) {
  if (triangles_.empty()) return;
  for (std::size_t s = 0; s < seams.size(); ++s) {
    const auto& corner = seams[s].corner[0];
    hinges_[bending_[seams[s].element[0]].hinge[3 - corner[0] - corner[1]]].open = open[s] != 0;
  }
  for (Hinge& hinge : hinges_)
    for (int k = 0; k < 4; ++k) hinge.corner[k] = triangles_[hinge.slot[k] / 3].corner[hinge.slot[k] % 3];
  for (std::size_t t = 0; t < triangles_.size(); ++t) free_edges(t);
}

// The angle between the triangles of a hinge, 0 where they are in one plane, and how it grows as corners move. One
// without an area has no say.
void TissueSheet::measure(const std::vector<Vec3>& x, Hinge& hinge, double& angle) const {
  const Vec3 &a = x[hinge.corner[0]], &b = x[hinge.corner[1]], &c = x[hinge.corner[2]], &d = x[hinge.corner[3]];
  const Vec3 edge = b - a;
  const Vec3 n = math::cross(edge, c - a), m = math::cross(d - a, edge);
  const double nn = math::dot(n, n), mm = math::dot(m, m), length = math::norm(edge);
  if (!(nn > kFlat * kFlat && mm > kFlat * kFlat)) {
    std::fill(std::begin(hinge.gradient), std::end(hinge.gradient), Vec3{});
    angle = hinge.angle;
    return;
  }
  angle = std::atan2(math::dot(math::cross(m, n), edge) / length, math::dot(n, m));
  const Vec3 up = n / nn, over = m / mm;
  hinge.gradient[2] = up * length;
  hinge.gradient[3] = over * length;
  hinge.gradient[0] = up * (math::dot(c - b, edge) / length) + over * (math::dot(d - b, edge) / length);
  hinge.gradient[1] = -(up * (math::dot(c - a, edge) / length) + over * (math::dot(d - a, edge) / length));
}

void TissueSheet::add_stress(const Triangle& t, const Plane& strain, std::vector<Vec3>& to) {
  const double even = t.even * (strain.xx + strain.yy);
  const double xx = t.shear * strain.xx + even, yy = t.shear * strain.yy + even, xy = t.shear * strain.xy;
  const Vec3 first = t.along * (xx * t.ax + xy * t.ay) + t.across * (xy * t.ax + yy * t.ay);
  const Vec3 second = t.along * (xy * t.by) + t.across * (yy * t.by);
  to[t.corner[1]] -= first;
  to[t.corner[2]] -= second;
  to[t.corner[0]] += first + second;
}

void TissueSheet::begin(const std::vector<Vec3>& x, double h, std::vector<Vec3>& forces) {
  const bool relaxes = share_ < 1.0;
  const double pace = h / (time_ + h), memory = relaxes ? 1.0 - share_ : 0.0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    Triangle& t = triangles_[i];
    const Vec3 d1 = x[t.corner[1]] - x[t.corner[0]], d2 = x[t.corner[2]] - x[t.corner[0]];
    const Vec3 out = math::cross(d1, d2);
    if (math::dot(out, out) > kFlat * kFlat) {  // else as it was: it has no plane of its own
      t.normal = math::normalized(out);
      // In the plane, from axes that follow its first edge, by the angle that makes the deformation symmetric.
      const Vec3 first = math::normalized(d1, t.along), second = math::cross(t.normal, first);
      const double p = math::norm(d1), q = math::dot(first, d2), r = math::dot(second, d2);
      const double even = p * t.ax + r * t.by, turn = -(p * t.ay + q * t.by);
      const double size = std::sqrt(even * even + turn * turn);
      const double c = size > 0.0 ? even / size : 1.0, s = size > 0.0 ? turn / size : 0.0;
      t.along = first * c + second * s;
      t.across = second * c - first * s;
    }
    const double u1 = math::dot(t.along, d1), v1 = math::dot(t.across, d1), u2 = math::dot(t.along, d2),
                 v2 = math::dot(t.across, d2);
    Plane now{u1 * t.ax - 1.0, v1 * t.ay + v2 * t.by - 1.0, 0.5 * (u1 * t.ay + u2 * t.by + v1 * t.ax)};
    if (relaxes) {
      Plane& q = rests_[i].relaxed;
      q = {q.xx + pace * (now.xx - q.xx), q.yy + pace * (now.yy - q.yy), q.xy + pace * (now.xy - q.xy)};
      now = {now.xx - memory * q.xx, now.yy - memory * q.yy, now.xy - memory * q.xy};
    }
    add_stress(t, now, forces);
    // Of the stress, what pulls: without it in the solver, a taut sheet would tremble like an explicit string.
    const double even = t.even * (now.xx + now.yy);
    const double xx = t.shear * now.xx + even, yy = t.shear * now.yy + even, xy = t.shear * now.xy;
    const double middle = 0.5 * (xx + yy), half = 0.5 * (xx - yy), radius = std::sqrt(half * half + xy * xy);
    const double high = std::max(middle + radius, 0.0), low = std::max(middle - radius, 0.0);
    // The tensor with these eigenvalues along the same axes: a sum of it and of the identity.
    const double slope = radius > 0.0 ? (high - low) / (2.0 * radius) : 0.0, base = 0.5 * (high + low);
    const Plane pull{base + slope * (xx - middle), base + slope * (yy - middle), slope * xy};
    const double across = pull.xy * t.ax + pull.yy * t.ay;
    t.taut[0] = t.ax * (pull.xx * t.ax + pull.xy * t.ay) + t.ay * across;
    t.taut[1] = t.by * across, t.taut[2] = t.by * pull.yy * t.by;
  }
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    Hinge& hinge = hinges_[i];
    if (hinge.open) {
      std::fill(std::begin(hinge.gradient), std::end(hinge.gradient), Vec3{});
      bends_[i] = 0.0;
      continue;
    }
    double angle = 0.0;
    measure(x, hinge, angle);
    bends_[i] = angle - hinge.angle;
    if (relaxes) {
      hinge.relaxed += pace * (bends_[i] - hinge.relaxed);
      bends_[i] -= memory * hinge.relaxed;
    }
  }
  pull_hinges(forces);
}

void TissueSheet::pull_hinges(std::vector<Vec3>& to) {
  std::fill(moments_.begin(), moments_.end(), 0.0);
  for (const Bending& t : bending_) {
    double bend[3];
    for (int k = 0; k < 3; ++k) bend[k] = t.hinge[k] == kNone ? 0.0 : bends_[t.hinge[k]];
    const double* b = t.moment;
    const double moment[3] = {b[0] * bend[0] + b[3] * bend[1] + b[5] * bend[2],
                              b[3] * bend[0] + b[1] * bend[1] + b[4] * bend[2],
                              b[5] * bend[0] + b[4] * bend[1] + b[2] * bend[2]};
    for (int k = 0; k < 3; ++k)
      if (t.hinge[k] != kNone) moments_[t.hinge[k]] += moment[k];
  }
  for (std::size_t i = 0; i < hinges_.size(); ++i)
    for (int k = 0; k < 4; ++k) to[hinges_[i].corner[k]] -= hinges_[i].gradient[k] * moments_[i];
}

void TissueSheet::add_stiffness_force(const std::vector<Vec3>& u, std::vector<Vec3>& to, double taut) {
  for (const Triangle& t : triangles_) {
    const Vec3 d1 = u[t.corner[1]] - u[t.corner[0]], d2 = u[t.corner[2]] - u[t.corner[0]];
    const double u1 = math::dot(t.along, d1), v1 = math::dot(t.across, d1), w1 = taut * math::dot(t.normal, d1);
    const double u2 = math::dot(t.along, d2), v2 = math::dot(t.across, d2), w2 = taut * math::dot(t.normal, d2);
    const double ex = u1 * t.ax, ey = v1 * t.ay + v2 * t.by;
    const double even = t.even * (ex + ey), xx = t.shear * ex + even, yy = t.shear * ey + even;
    const double xy = 0.5 * t.shear * (u1 * t.ay + u2 * t.by + v1 * t.ax);
    const Vec3 first = t.along * (xx * t.ax + xy * t.ay) + t.across * (xy * t.ax + yy * t.ay) +
                       t.normal * (t.taut[0] * w1 + t.taut[1] * w2);
    const Vec3 second = t.along * (xy * t.by) + t.across * (yy * t.by) + t.normal * (t.taut[1] * w1 + t.taut[2] * w2);
    to[t.corner[1]] -= first;
    to[t.corner[2]] -= second;
    to[t.corner[0]] += first + second;
  }
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    const Hinge& hinge = hinges_[i];
    bends_[i] = 0.0;
    for (int k = 0; k < 4; ++k) bends_[i] += math::dot(hinge.gradient[k], u[hinge.corner[k]]);
  }
  pull_hinges(to);
}

double TissueSheet::volume(const std::vector<Vec3>& x) const {
  double all = 0.0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const std::uint32_t* c = triangles_[i].corner;
    all += 0.5 * rests_[i].thickness * math::norm(math::cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]));
  }
  return all;
}

math::Quat TissueSheet::frame_of_first(const std::vector<Vec3>& x) const {
  const std::uint32_t* c = triangles_.front().corner;
  const Vec3 e = math::normalized(x[c[1]] - x[c[0]], {1, 0, 0});
  const Vec3 n = math::normalized(math::cross(e, x[c[2]] - x[c[0]]));
  const Vec3 f = math::cross(n, e);
  const double rows[9] = {e.x, f.x, n.x, e.y, f.y, n.y, e.z, f.z, n.z};
  return math::from_matrix(rows);
}

math::Quat TissueSheet::rotation_of_first(const std::vector<Vec3>& x) const {
  return frame_of_first(x) * math::inverse(first_);
}

void TissueSheet::get_state(std::vector<double>& out) const {
  for (const Rest& rest : rests_) out.insert(out.end(), {rest.relaxed.xx, rest.relaxed.yy, rest.relaxed.xy});
  for (const Hinge& hinge : hinges_) out.push_back(hinge.relaxed);
}

void TissueSheet::set_state(const double* from) {
  for (Rest& rest : rests_) {
    rest.relaxed = {from[0], from[1], from[2]};
    from += 3;
  }
  for (Hinge& hinge : hinges_) hinge.relaxed = *from++;
}

void TissueSheet::reset() {
  for (Rest& rest : rests_) rest.relaxed = {};
  for (Hinge& hinge : hinges_) hinge.relaxed = 0.0;
}

}  // namespace ambf::physics::detail
