// Faces of tissue as tips of bodies meet them. Private to physics/soft/. Physics thread.
#pragma once

#include <array>
#include <cmath>

#include "physics/soft/detail/tissue_tips.h"

namespace ambf::physics::detail {

struct Facet {
  btVector3 a, ab, ac, area, normal;
  double square;

  Facet(const btVector3& first, const btVector3& second, const btVector3& third)
      : a(first), ab(second - first), ac(third - first), area(ab.cross(ac)), square(area.length2()) {
    normal = square > 0.0 ? area / std::sqrt(square) : btVector3(0, 0, 0);
  }
  // Of a place in its plane, from its first corner.
  std::array<double, 3> shares(const btVector3& off) const {
    const double at_b = off.cross(ac).dot(area) / square, at_c = ab.cross(off).dot(area) / square;
    return {1.0 - at_b - at_c, at_b, at_c};
  }
};

Facet facet_of(const TissueData& tissue, std::uint32_t face);
btVector3 place_of(const TissueData& tissue, std::uint32_t face, const std::array<double, 3>& share);
// 0 to 1: less beside the face.
double fullness(const std::array<double, 3>& share);
// A face with points that are held by the body, or by what is jointed to it, does not meet it.
bool passes(const TissueData& tissue, std::uint32_t face, const BodyData& body);
// False: there is no room.
bool touch_first(TipRooms& rooms, const TipRooms::Place& place, const btVector3& normal,
                 const std::array<double, 3>& share);

}  // namespace ambf::physics::detail
