// Where in tissue a place is: what a blade's edge needs in each step. Private to physics/soft/. Physics thread.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "physics/soft/detail/tissue_data.h"
#include "physics/soft/detail/weights.h"

namespace ambf::physics::detail {

constexpr double kNearWeight = 0.5;  // how far outside of an element tissue is near
constexpr double kNearSheet = 1.0;   // elements: what is no further from a sheet is near it

struct PlaceBox {
  math::Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

  static constexpr double kFar = std::numeric_limits<double>::max();

  void add(const math::Vec3& at) {
    low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
  }
  bool empty() const { return low.x > high.x; }
  // Another is less than `reach` away along each axis.
  bool is_near(const PlaceBox& other, double reach) const {
    return other.low.x - high.x < reach && other.low.y - high.y < reach && other.low.z - high.z < reach &&
           low.x - other.high.x < reach && low.y - other.high.y < reach && low.z - other.high.z < reach;
  }
};

struct FoundPlace {
  double least = -1.0;  // weight; below 0, but for rounding: outside
  math::Vec3 rest;      // m, where that was as loaded
  TissuePoint point;
};

std::array<math::Vec3, 4> shape_of(const TissueData& tissue, const std::vector<math::Vec3>& corners,
                                   std::uint32_t element);
TissuePoint point_of(const TissueData& tissue, std::uint32_t element, const std::array<double, 4>& weight);

// Of a saved number of an element and a place, which may be anything: whether it is in or near that element.
bool is_place_of(const TissueData& tissue, double element, const math::Vec3& rest);

// A place on or beside a sheet: the nearest one on a triangle, and how far away from that it is.
struct SheetPlace {
  bool near = false;
  std::uint32_t triangle = 0;
  std::array<double, 3> weight{};  // of the corners: of the nearest place
  double height = 0.0;             // m, the way from there; above 0: on the side that the normal points to
  math::Vec3 normal;               // of the triangle
  double lean = 1.0;               // cosine of the way to the normal
};
// Where that was as loaded, in the sheet's rest shape with what is around it.
math::Vec3 rest_of(const TissueData& sheet, const SheetPlace& place);
// The same back, with the triangle as it is now.
SheetPlace from_rest(const TissueData& sheet, std::uint32_t triangle, const math::Vec3& rest);
math::Vec3 rest_normal(const TissueData& sheet, std::uint32_t triangle);
TissuePoint point_of(const TissueData& sheet, const SheetPlace& place);
math::Vec3 now(const TissueData& sheet, const SheetPlace& place);
// Of the triangles that find_near_triangles() found the nearest, no further than `reach` m; of several the first.
void find_near_triangles(TissueData& sheet, const PlaceBox& box, double reach);
SheetPlace locate_on_sheet(const TissueData& sheet, const math::Vec3& at, double reach);

// What locate() looks at for places in this box: `near_elements`.
void find_near(TissueData& tissue, const PlaceBox& box);
// The element that a place is in, the one that it was in before all others; or the one that it is least out of.
FoundPlace locate(const TissueData& tissue, const math::Vec3& at, std::uint32_t before);

}  // namespace ambf::physics::detail
