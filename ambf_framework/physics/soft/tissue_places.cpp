#include "physics/soft/detail/tissue_places.h"

#include <cmath>

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kOnSheet = 1e-6;   // of a weight: places of sheets are on their triangles, but for rounding
constexpr double kFarCorner = 2.5;  // elements: none that is near has its first corner further away

// Whether a place may have no weight below `least` in this element: those are the places within the element scaled
// about its middle.
bool may_be_in(const NearElement& each, const Vec3& at, double least) {
  const double scale = (1.0 - 4.0 * least) * (1.0 + 1e-6);
  const Vec3 way = at - each.middle;
  return way.x >= scale * each.least.x && way.x <= scale * each.most.x && way.y >= scale * each.least.y &&
         way.y <= scale * each.most.y && way.z >= scale * each.least.z && way.z <= scale * each.most.z;
}

}  // namespace

std::array<Vec3, 4> shape_of(const TissueData& tissue, const std::vector<Vec3>& corners, std::uint32_t element) {
  const std::uint32_t* c = tissue.solid.corners_of(element);
  return {corners[c[0]], corners[c[1]], corners[c[2]], corners[c[3]]};
}

TissuePoint point_of(const TissueData& tissue, std::uint32_t element, const std::array<double, 4>& weight) {
  const std::uint32_t* c = tissue.solid.corners_of(element);
  return {{c[0], c[1], c[2], c[3]}, weight, element};
}

bool is_place_of(const TissueData& tissue, double element, const Vec3& rest) {
  const std::size_t count = tissue.is_sheet() ? tissue.solid.triangle_count() : tissue.solid.element_count();
  if (!(element >= 0.0 && element < static_cast<double>(count))) return false;
  if (tissue.is_sheet()) {
    const SheetPlace place = from_rest(tissue, static_cast<std::uint32_t>(element), rest);
    return std::abs(place.height) <= kNearSheet * tissue.grid.element_size &&
           std::all_of(place.weight.begin(), place.weight.end(), [](double w) { return w > -kOnSheet; });
  }
  const auto weight = weights_in(shape_of(tissue, tissue.grid.corners, static_cast<std::uint32_t>(element)), rest);
  return std::all_of(weight.begin(), weight.end(), [](double w) { return w > -2.0 * kNearWeight; });
}

void find_near(TissueData& tissue, const PlaceBox& box) {
  const std::vector<Vec3>& corners = tissue.solid.positions();
  const double near = kFarCorner * tissue.grid.element_size;
  tissue.near_elements.clear();
  if (box.empty()) return;
  for (std::uint32_t e = 0; e < tissue.solid.element_count(); ++e) {
    const Vec3& corner = corners[tissue.solid.corners_of(e)[0]];
    if (!box.is_near({corner, corner}, near)) continue;
    NearElement found{e, corner, {}, {}, {}};
    const auto shape = shape_of(tissue, corners, e);
    PlaceBox around;
    for (const Vec3& each : shape) {
      found.middle += each * 0.25;
      around.add(each);
    }
    found.least = around.low - found.middle;
    found.most = around.high - found.middle;
    tissue.near_elements.push_back(found);
  }
}

FoundPlace locate(const TissueData& tissue, const Vec3& at, std::uint32_t before) {
  FoundPlace found;
  found.least = -kNearWeight;
  const std::vector<Vec3>& corners = tissue.solid.positions();
  const double near = kFarCorner * tissue.grid.element_size;
  const auto consider = [&](std::uint32_t e) {
    const auto weight = weights_in(shape_of(tissue, corners, e), at);
    const double least = *std::min_element(weight.begin(), weight.end());
    if (!(least > found.least)) return;
    found.least = least;
    found.point = point_of(tissue, e, weight);
  };
  consider(before);
  for (std::size_t i = 0; found.least < 0.0 && i < tissue.near_elements.size(); ++i) {
    const NearElement& each = tissue.near_elements[i];
    if (!may_be_in(each, at, found.least)) continue;
    const Vec3 way = each.corner - at;
    if (math::dot(way, way) < near * near) consider(each.element);
  }
  for (std::size_t k = 0; found.least > -kNearWeight && k < 4; ++k)
    found.rest += tissue.grid.corners[found.point.corner[k]] * found.point.weight[k];
  return found;
}

}  // namespace ambf::physics::detail
