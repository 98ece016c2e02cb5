// How what touches is found among the points, faces and rims of tissue. Private to physics/soft/. Physics thread.
#pragma once

#include <algorithm>
#include <limits>

#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

// Sorts points where they are now, and finds which way they face.
void count(TissueData& tissue);
// The corner that a point is at; kNoCorner: at none.
constexpr auto kNoCorner = std::numeric_limits<std::uint32_t>::max();
std::uint32_t corner_at(const TissueData& tissue, std::uint32_t point);
// The point that stands for all at its corner.
std::uint32_t stands_for(const TissueData& tissue, std::uint32_t point);

// Which faces and points of one tissue may touch (touch_pairs.cpp): `paired`, `pairs`, `paired_points`, and which way
// these face. False: there are too many.
bool pair_up(TissueData& tissue, double reach);
// Of a sheet, as loaded.
bool were_near(const TissueData& sheet, std::uint32_t face, std::uint32_t point);
// Whether a face and a point of one tissue never touch: they are of elements that hang together there, or the point, or
// its element, is behind the face as loaded, with tissue between them.
bool hang_together(TissueData& tissue, std::uint32_t face, std::uint32_t point);

// How far around a face what touches it is. Of sheets, their middle keeps `away` from others.
struct Reach {
  Reach(const TissueData& points, const TissueData& faces)
      : behind(kReach * std::min(points.grid.element_size, faces.grid.element_size)),
        away(0.5 * (points.grid.thickness + faces.grid.thickness)),
        deepest(faces.is_sheet() ? kThroughSheet * behind + away : behind + away) {}

  static constexpr double kReach = 0.6;         // elements: what is further behind a face does not touch it
  static constexpr double kThroughSheet = 0.5;  // of that: what came through a sheet further does not touch it
  // Of a share: beside a face its push fades, so that points at a rim do not tremble.
  static constexpr double kBeside = 0.25;
  double behind, away, deepest;  // m
};

// Of a sheet, the rims of its own that points of rims are in or beside (rim_touch.cpp).
void look_at_rims(TissueData& sheet, std::uint32_t face, std::uint32_t point, const Reach& reach);
// Then those that push them out, in the plane: as the face that they are behind.
void choose_rim(TissueData& sheet, std::uint32_t point, const Reach& reach);
// Whether a point and a face at a rim of one sheet may just as well lie beside each other in one plane.
bool is_beside(const TissueData& sheet, std::uint32_t face, std::uint32_t point, double above, const Reach& reach);
// Then it comes over the face from its rim: none of the push there, all of it well within. `least`: of its shares.
bool comes_over(const TissueData& sheet, std::uint32_t face, std::uint32_t point, double behind,
                const std::array<double, 3>& share, const Reach& reach, double& least);
// Of a point that touches a rim, what friction pulls it back to, with it `at` that place.
TouchRooms::Hold hold_at_rim(const TissueData& sheet, std::uint32_t point, const btVector3& at);
btVector3 place_of(const TissueData& faces, const TouchRooms::Hold& hold);

}  // namespace ambf::physics::detail
