#include "physics/soft/detail/tissue_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/rotation.h"

namespace ambf::physics::detail {

using math::Vec3;

TissueSheet::TissueSheet(const TissueDefinition& given, std::vector<double>& mass)
    : share_(given.material.share), time_(given.material.time) {
  if (given.grid.triangles.empty()) return;
  const TissueMaterial& material = given.material;
  const std::vector<Vec3>& at = given.grid.corners;
  modulus_ = material.young / (1.0 - material.poisson * material.poisson);
  lanes_.resize(given.grid.triangles.size());
  for (std::size_t i = 0; i < given.grid.triangles.size(); ++i) {
    const TissueTriangle& each = given.grid.triangles[i];
    Triangle made;
    std::copy(each.corner.begin(), each.corner.end(), made.corner);
    const Vec3 d1 = at[each.corner[1]] - at[each.corner[0]], d2 = at[each.corner[2]] - at[each.corner[0]];
    const Vec3 out = math::cross(d1, d2), along = math::normalized(d1), normal = math::normalized(out),
               across = math::cross(normal, along);
    SheetLanes::Hot& hot = lanes_.hot[i / SheetLanes::kCount];
    const std::size_t lane = i % SheetLanes::kCount;
    const auto set = [&](SheetLanes::Four3& to, const Vec3& v) {
      to[0][lane] = v.x, to[1][lane] = v.y, to[2][lane] = v.z;
    };
    set(hot.along, along), set(hot.across, across), set(hot.normal, normal);
    const double ax = math::norm(d1), bx = math::dot(along, d2), by = math::dot(across, d2);
    hot.ax[lane] = 1.0 / ax, hot.ay[lane] = -bx / (ax * by), hot.by[lane] = 1.0 / by;
    made.area = 0.5 * math::norm(out);
    made.thickness = given.grid.thickness;
    const double volume = made.area * made.thickness;
    hot.shear[lane] = material.young / (1.0 + material.poisson) * volume * each.stiffness;
    hot.even[lane] = material.poisson * modulus_ * volume * each.stiffness;
    made.mass = volume * material.density * each.density;
    for (const std::uint32_t corner : each.corner) mass[corner] += made.mass / 3.0;
    triangles_.push_back(made);
  }
  add_hinges();
  number_lanes();
  set_bending(given);
  lanes_.set_rest_angles(at.data());
  first_ = frame_of_first(at);
}

// Where two triangles meet along an edge they are hinged.
void TissueSheet::add_hinges() {
  struct Side {
    std::uint32_t triangle, edge;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles_[t].corner[(k + 1) % 3], b = triangles_[t].corner[(k + 2) % 3];
      edges[std::minmax(a, b)].push_back({t, k});
    }
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2) continue;
    for (const Side& side : sides)
      triangles_[side.triangle].hinge[side.edge] = static_cast<std::uint32_t>(lanes_.hinge_count);
    // Along their edge, neighbours run opposite ways; a triangle that is turned over sees the bend from behind.
    const auto begin_of = [&](const Side& side) { return triangles_[side.triangle].corner[(side.edge + 1) % 3]; };
    lanes_.add_hinge({sides[0].triangle, sides[1].triangle}, {sides[0].edge, sides[1].edge},
                     begin_of(sides[1]) == begin_of(sides[0]) ? -1.0 : 1.0);
  }
}

// Once corners have other numbers.
void TissueSheet::number_lanes() {
  constexpr std::size_t kCount = SheetLanes::kCount;
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) lanes_.hot[i / kCount].corner[k][i % kCount] = triangles_[i].corner[k];
  for (std::size_t i = 0; i < lanes_.hinge_count; ++i) {
    SheetLanes::Hinges& four = lanes_.hinges[i / kCount];
    const Triangle& first = triangles_[four.triangle[0][i % kCount]];
    const std::size_t edge = four.slot[0][i % kCount] / kCount % 3;
    for (std::size_t k = 0; k < 2; ++k) four.corner[k][i % kCount] = first.corner[(edge + 1 + k) % 3];
  }
}

// The curvature of a triangle is the mean of n n^T times what each edge bends by, its length over twice the area: that
// of the plane's gradients over its edges, as the divergence theorem has it (Onate and Zarate, 2000). At an edge of the
// sheet no moment acts: the angle there is whichever costs nothing.
void TissueSheet::set_bending(const TissueDefinition& given) {
  const double nu = given.material.poisson;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    Triangle& triangle = triangles_[t];
    const double h = triangle.thickness;
    const double rigidity = modulus_ * given.grid.triangles[t].stiffness * h * h * h / 12.0;
    const Vec3 normal = lanes_.normal_of(t);
    Vec3 out[3];
    double length[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge =
          given.grid.corners[triangle.corner[(k + 2) % 3]] - given.grid.corners[triangle.corner[(k + 1) % 3]];
      length[k] = math::norm(edge);
      out[k] = math::cross(edge / length[k], normal);
    }
    const SheetLanes::Four3& sides = lanes_.cold[t / SheetLanes::kCount].side;
    const auto side = [&](std::size_t k) { return sides[k][t % SheetLanes::kCount]; };
    std::array<std::array<double, 3>, 3> b{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double cosine = math::dot(out[i], out[k]);
        b[i][k] = rigidity * length[i] * length[k] / (4.0 * triangle.area) * ((1.0 - nu) * cosine * cosine + nu);
        b[i][k] *= side(i) * side(k);  // as the hinges see it
      }
    const double moment[6] = {b[0][0], b[1][1], b[2][2], b[0][1], b[1][2], b[2][0]};
    std::copy(std::begin(moment), std::end(moment), triangle.moment);
    free_edges(t);
  }
}

// Of the edges that do not bend, those of the sheet and of cuts, the angles are solved for.
void TissueSheet::free_edges(std::size_t t) {
  const double* m = triangles_[t].moment;
  double b[3][3] = {{m[0], m[3], m[5]}, {m[3], m[1], m[4]}, {m[5], m[4], m[2]}};
  const double least = 1e-9 * (m[0] + m[1] + m[2]);
  for (std::size_t free = 0; free < 3; ++free) {
    const std::uint32_t hinge = triangles_[t].hinge[free];
    if (hinge != kNone && closed(hinge) > 0.0) continue;
    const double row[3] = {b[free][0], b[free][1], b[free][2]};
    if (row[free] > least)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) b[i][k] -= row[i] * row[k] / row[free];
    for (std::size_t i = 0; i < 3; ++i) b[free][i] = b[i][free] = 0.0;
  }
  const double moment[6] = {b[0][0], b[1][1], b[2][2], b[0][1], b[1][2], b[2][0]};
  for (std::size_t i = 0; i < 6; ++i) lanes_.hot[t / SheetLanes::kCount].moment[i][t % SheetLanes::kCount] = moment[i];
}

void TissueSheet::part_at(const std::vector<TissueSeam>& seams, const std::vector<std::uint8_t>& open) {
  if (triangles_.empty()) return;
  for (std::size_t s = 0; s < seams.size(); ++s) {
    const auto& corner = seams[s].corner[0];
    closed(triangles_[seams[s].element[0]].hinge[3 - corner[0] - corner[1]]) = open[s] != 0 ? 0.0 : 1.0;
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) free_edges(t);
}

void TissueSheet::begin(const std::vector<Vec3>& x, double h, std::vector<Vec3>& forces) {
  if (triangles_.empty()) return;
  const SheetLanes::Relaxing relaxing{h / (time_ + h), share_ < 1.0 ? 1.0 - share_ : 0.0};
  lanes_.turn_to(x.data(), relaxing);
  lanes_.pull(forces.data());
}

void TissueSheet::add_stiffness_force(const std::vector<Vec3>& u, std::vector<Vec3>& to, double taut) {
  if (triangles_.empty()) return;
  lanes_.stretch(u.data(), taut, to.data());
}

double TissueSheet::volume(const std::vector<Vec3>& x) const {
  double all = 0.0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const std::uint32_t* c = triangles_[i].corner;
    all += 0.5 * triangles_[i].thickness * math::norm(math::cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]));
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
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (const SheetLanes::Four& each : lanes_.cold[i / SheetLanes::kCount].relaxed)
      out.push_back(each[i % SheetLanes::kCount]);
  for (std::size_t i = 0; i < lanes_.hinge_count; ++i)
    out.push_back(lanes_.hinges[i / SheetLanes::kCount].relaxed[i % SheetLanes::kCount]);
}

void TissueSheet::set_state(const double* from) {
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (SheetLanes::Four& each : lanes_.cold[i / SheetLanes::kCount].relaxed) each[i % SheetLanes::kCount] = *from++;
  for (std::size_t i = 0; i < lanes_.hinge_count; ++i)
    lanes_.hinges[i / SheetLanes::kCount].relaxed[i % SheetLanes::kCount] = *from++;
}

void TissueSheet::reset() {
  for (SheetLanes::Cold& each : lanes_.cold) each.relaxed = {};
  for (SheetLanes::Hinges& each : lanes_.hinges) each.relaxed = {};
}

}  // namespace ambf::physics::detail
