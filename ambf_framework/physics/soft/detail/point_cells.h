// Points of tissue sorted by cells (TouchRooms::sorted): those that may be within a box. Private to physics/soft/.
// Physics thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

inline int cell_of(double value, double size) {
  constexpr double kFar = 1e9;
  const double cell = std::floor(value / size);
  return cell > -kFar && cell < kFar ? static_cast<int>(cell) : 0;  // what is not finite has diverged
}

// Slots of a row of cells along x follow each other.
inline std::size_t slot_of(int x, int y, int z, std::size_t slots) {
  const auto part = [](int value, std::uint32_t prime) { return static_cast<std::uint32_t>(value) * prime; };
  return ((part(y, 19349663U) ^ part(z, 83492791U)) + part(x, 1U)) & (slots - 1);
}

// All points in the box, and some others.
template <class Look>
void each_near(const TissueData& points, const btVector3& from, const btVector3& to, const Look& look) {
  if (!(from.x() <= to.x() && from.y() <= to.y() && from.z() <= to.z())) return;
  const TouchRooms& rooms = points.touch;
  const double size = points.grid.element_size;
  const std::size_t slots = rooms.first.size() - 1;
  const int x0 = cell_of(from.x(), size), x1 = cell_of(to.x(), size), y0 = cell_of(from.y(), size),
            y1 = cell_of(to.y(), size), z0 = cell_of(from.z(), size), z1 = cell_of(to.z(), size);
  const std::uint32_t count = rooms.first.back();
  // A box that is very large: all of them.
  if (static_cast<double>(x1 - x0 + 1) * (y1 - y0 + 1) * (z1 - z0 + 1) > static_cast<double>(count)) {
    for (std::uint32_t k = 0; k < count; ++k) look(rooms.sorted[k]);
    return;
  }
  for (int z = z0; z <= z1; ++z)
    for (int y = y0; y <= y1; ++y) {
      const std::size_t begin = slot_of(x0, y, z, slots), end = begin + static_cast<std::size_t>(x1 - x0) + 1;
      for (std::uint32_t k = rooms.first[begin]; k < rooms.first[std::min(end, slots)]; ++k) look(rooms.sorted[k]);
      // A row that goes on at the first slot.
      for (std::uint32_t k = 0; end > slots && k < rooms.first[end - slots]; ++k) look(rooms.sorted[k]);
    }
}

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
