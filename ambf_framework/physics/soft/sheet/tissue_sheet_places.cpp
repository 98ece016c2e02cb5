// Where a place is that lies on or beside a sheet: what a blade's edge and a needle need of it.
#include <algorithm>
#include <cmath>

#include "physics/soft/detail/tissue_places.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TissueData& sheet, const std::vector<Vec3>& at, std::uint32_t triangle) {
  const std::uint32_t* c = sheet.solid.corners_of(triangle);
  return {at[c[0]], at[c[1]], at[c[2]]};
}

Vec3 normal_of(const Corners& t) {
  const Vec3 area = math::cross(t[1] - t[0], t[2] - t[0]);
  const double size = math::norm(area);
  return size > 0.0 ? area / size : Vec3{};
}

Vec3 sum(const Corners& t, const std::array<double, 3>& weight) {
  return t[0] * weight[0] + t[1] * weight[1] + t[2] * weight[2];
}

// The nearest place of a triangle, by the regions around its corners and edges (Ericson 2005, 5.1.5).
std::array<double, 3> nearest_on(const Corners& t, const Vec3& p) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = math::dot(ab, ap), d2 = math::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = math::dot(ab, bp), d4 = math::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double c = d1 * d4 - d3 * d2;
  if (c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double share = d1 / (d1 - d3);
    return {1.0 - share, share, 0.0};
  }
  const double d5 = math::dot(ab, cp), d6 = math::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double b = d5 * d2 - d1 * d6;
  if (b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double share = d2 / (d2 - d6);
    return {1.0 - share, 0.0, share};
  }
  const double a = d3 * d6 - d5 * d4;
  if (a <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - share, share};
  }
  const double all = a + b + c;
  return {a / all, b / all, c / all};
}

}  // namespace

Vec3 rest_of(const TissueData& sheet, const SheetPlace& place) {
  const Corners t = corners_of(sheet, sheet.grid.corners, place.triangle);
  return sum(t, place.weight) + normal_of(t) * place.height;
}

Vec3 rest_normal(const TissueData& sheet, std::uint32_t triangle) {
  return normal_of(corners_of(sheet, sheet.grid.corners, triangle));
}

SheetPlace from_rest(const TissueData& sheet, std::uint32_t triangle, const Vec3& rest) {
  const Corners t = corners_of(sheet, sheet.grid.corners, triangle);
  const Vec3 normal = normal_of(t), ab = t[1] - t[0], ac = t[2] - t[0], off = rest - t[0];
  const double size = math::dot(math::cross(ab, ac), normal);
  SheetPlace place;
  place.near = true;
  place.triangle = triangle;
  place.height = math::dot(normal, off);
  place.weight[1] = math::dot(math::cross(off, ac), normal) / size;
  place.weight[2] = math::dot(math::cross(ab, off), normal) / size;
  place.weight[0] = 1.0 - place.weight[1] - place.weight[2];
  place.normal = normal_of(corners_of(sheet, sheet.solid.positions(), triangle));
  return place;
}

TissuePoint point_of(const TissueData& sheet, const SheetPlace& place) {
  const std::uint32_t* c = sheet.solid.corners_of(place.triangle);
  return {{c[0], c[1], c[2], c[0]}, {place.weight[0], place.weight[1], place.weight[2], 0.0}, place.triangle};
}

Vec3 now(const TissueData& sheet, const SheetPlace& place) {
  return sum(corners_of(sheet, sheet.solid.positions(), place.triangle), place.weight) + place.normal * place.height;
}

void find_near_triangles(TissueData& sheet, const PlaceBox& box, double reach) {
  sheet.near_elements.clear();
  if (box.empty()) return;
  for (std::uint32_t t = 0; t < sheet.solid.triangle_count(); ++t) {
    PlaceBox around;
    for (const Vec3& corner : corners_of(sheet, sheet.solid.positions(), t)) around.add(corner);
    if (!box.is_near(around, reach)) continue;
    const Vec3 middle = (around.low + around.high) * 0.5;
    sheet.near_elements.push_back({t, middle, middle, around.low - middle, around.high - middle});
  }
}

SheetPlace locate_on_sheet(const TissueData& sheet, const Vec3& at, double reach) {
  SheetPlace found;
  double least = reach * reach;
  for (const NearElement& each : sheet.near_elements) {
    const Vec3 way = at - each.middle;
    if (way.x < each.least.x - reach || way.x > each.most.x + reach || way.y < each.least.y - reach ||
        way.y > each.most.y + reach || way.z < each.least.z - reach || way.z > each.most.z + reach)
      continue;
    const Corners t = corners_of(sheet, sheet.solid.positions(), each.element);
    const std::array<double, 3> weight = nearest_on(t, at);
    const Vec3 off = at - sum(t, weight);
    const double square = math::dot(off, off);
    if (!(square < least)) continue;
    least = square;
    found = {true, each.element, weight, 0.0, {}, 1.0};
  }
  if (!found.near) return found;
  const Corners t = corners_of(sheet, sheet.solid.positions(), found.triangle);
  found.normal = normal_of(t);
  const double along = math::dot(found.normal, at - sum(t, found.weight)), distance = std::sqrt(least);
  found.height = std::copysign(distance, along);
  if (distance > 0.0) found.lean = std::min(1.0, std::abs(along) / distance);
  return found;
}

}  // namespace ambf::physics::detail
