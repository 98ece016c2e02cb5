// Where in tissue a place is: what a blade's edge needs in each step. Private to physics/soft/. Physics thread.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

constexpr double kNearWeight = 0.5;  // how far outside of an element tissue is near

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

// Of a place in an element with these corners.
std::array<double, 4> weights_in(const std::array<math::Vec3, 4>& corners, const math::Vec3& at);
std::array<math::Vec3, 4> shape_of(const TissueData& tissue, const std::vector<math::Vec3>& corners,
                                   std::uint32_t element);
TissuePoint point_of(const TissueData& tissue, std::uint32_t element, const std::array<double, 4>& weight);

// Of a saved number of an element and a place, which may be anything: whether it is in or near that element.
bool is_place_of(const TissueData& tissue, double element, const math::Vec3& rest);

// What locate() looks at for places in this box: `near_elements`.
void find_near(TissueData& tissue, const PlaceBox& box);
// The element that a place is in, the one that it was in before all others; or the one that it is least out of.
FoundPlace locate(const TissueData& tissue, const math::Vec3& at, std::uint32_t before);

}  // namespace ambf::physics::detail
