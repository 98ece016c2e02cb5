// Rims of one sheet that meet in its plane: the lips of a cut, or its border. A point that came over a rim from beside
// it is pushed back in the plane, one that came over it from above, or beneath, stays there (tissue_touch.cpp).
#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "physics/soft/detail/tip_faces.h"
#include "physics/soft/detail/touch_search.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kSame = 1e-9;        // elements: two rims that are as near, at their corner
constexpr double kComesAbove = 0.9;   // of what two sheets keep apart: at a rim, one that is higher came from above
constexpr double kComesBeside = 0.5;  // likewise, and one that is lower came in the plane
constexpr double kThere = 0.25;       // of a rim's length, beyond its ends: what was no further is beside it as loaded
constexpr double kDeepest = 0.5;      // elements, that it was within it then

// Of the triangle's corners: its points may be on one line.
btVector3 normal_of(const TissueData& sheet, std::uint32_t face) {
  const std::uint32_t* corner = sheet.solid.corners_of(face);
  const std::vector<Vec3>& x = sheet.solid.positions();
  return to_bullet(math::normalized(math::cross(x[corner[1]] - x[corner[0]], x[corner[2]] - x[corner[0]])));
}

struct Rim {
  btVector3 from, along, out, normal;  // the last three of length 1
  double length;                       // m
  std::size_t first, second;           // of the face's corners

  Rim(const TissueData& sheet, std::uint32_t face, std::size_t opposite)
      : normal(normal_of(sheet, face)), first((opposite + 1) % 3), second((opposite + 2) % 3) {
    const auto& corner = sheet.grid.faces[face];
    from = sheet.at[corner[first]];
    along = sheet.at[corner[second]] - from;
    length = along.length();
    along /= length;
    out = along.cross(normal).normalized();
  }
};

// How far a point was within a rim as loaded: along a round stroke, rims that run from corner to corner overlap. What
// is no deeper does not press, or a fresh cut would push its lips apart.
double overlap_of(const TissueData& sheet, std::uint32_t face, const Rim& rim, std::uint32_t point) {
  const std::vector<Vec3>& corners = sheet.grid.corners;
  const std::vector<Vec3>& places = sheet.touch.point_place;
  const std::uint32_t* corner = sheet.solid.corners_of(face);
  const Vec3 &o = corners[corner[0]], &from = places[sheet.grid.faces[face][rim.first]];
  const Vec3 normal = math::cross(corners[corner[1]] - o, corners[corner[2]] - o);
  const Vec3 along = places[sheet.grid.faces[face][rim.second]] - from, off = places[point] - from;
  const double share = math::dot(along, off) / math::dot(along, along);
  if (!(share > -kThere && share < 1.0 + kThere)) return 0.0;
  const double depth = -math::dot(math::normalized(math::cross(along, normal)), off);
  return depth < kDeepest * sheet.grid.element_size ? std::max(depth, 0.0) : 0.0;
}

}  // namespace

void look_at_rims(TissueData& sheet, std::uint32_t face, std::uint32_t point, const Reach& reach) {
  TouchRooms& rooms = sheet.touch;
  TouchRooms::NearRim& best = rooms.near_rims[point];
  for (std::size_t k = 0; k < 3; ++k) {
    if (!rooms.rims.faces_out(face, k)) continue;
    const Rim rim(sheet, face, k);
    const btVector3 off = sheet.at[point] - rim.from;
    const double above = rim.normal.dot(off);
    if (!(rim.length > 0.0 && std::abs(above) < reach.away)) continue;
    const double depth = -rim.out.dot(off), at = rim.along.dot(off), on = std::clamp(at, 0.0, rim.length);
    const double distance = std::hypot(depth, at - on), same = kSame * sheet.grid.element_size;
    if (!(distance < reach.deepest)) continue;
    const bool is_better = best.distance < 0.0 || distance < best.distance - same ||
                           (distance < best.distance + same && std::abs(depth) > best.across);
    if (!is_better) continue;
    const double pressed = depth > 0.0 ? std::max(0.0, depth - overlap_of(sheet, face, rim, point)) : depth;
    best = {distance, pressed, std::abs(depth), above, face, static_cast<std::uint8_t>(k), {}, rim.out};
    best.share[rim.second] = on / rim.length;
    best.share[rim.first] = 1.0 - best.share[rim.second];
  }
}

void choose_rim(TissueData& sheet, std::uint32_t point, const Reach& reach) {
  TouchRooms& rooms = sheet.touch;
  const TouchRooms::NearRim& near = rooms.near_rims[point];
  if (near.distance < 0.0 || !(near.depth > 0.0) || !rooms.rims.has_corner(corner_at(sheet, point))) return;
  // Out by the shorter way, or as it touched it before.
  const TouchRooms::Hold& hold = rooms.holds[point];
  const bool is_known = hold.of == &sheet;
  if (is_known ? !hold.rim : !(near.depth < reach.away - std::abs(near.above))) return;
  TouchRooms::Behind& behind = rooms.behind[point];
  behind = {};
  behind.face = near.face;
  behind.depth = near.depth;
  behind.full = 1.0;
  behind.share = near.share;
  behind.normal = near.out;
  behind.rim = true;
}

bool is_beside(const TissueData& sheet, std::uint32_t face, std::uint32_t point, double above, const Reach& reach) {
  const TouchRooms& rooms = sheet.touch;
  const TouchRooms::Hold& hold = rooms.holds[point];
  const bool is_over = hold.of == &sheet && !hold.rim && !hold.entering;
  if (is_over || !(above < kComesAbove * reach.away)) return false;
  const std::uint32_t* corner = sheet.solid.corners_of(face);
  return std::any_of(corner, corner + 3, [&](std::uint32_t each) { return rooms.rims.has_corner(each); });
}

bool comes_over(const TissueData& sheet, std::uint32_t face, std::uint32_t point, double behind,
                const std::array<double, 3>& share, const Reach& reach, double& least) {
  const TouchRooms& rooms = sheet.touch;
  const TouchRooms::Hold& hold = rooms.holds[point];
  const TouchRooms::NearRim& near = rooms.near_rims[point];
  const std::uint32_t* corner = sheet.solid.corners_of(face);
  for (std::size_t k = 0; k < 3; ++k) {
    if (rooms.rims.is_rim(face, k)) least = std::min(least, share[k] - Reach::kBeside);
    if (rooms.rims.has_corner(corner[k])) least = std::min(least, 1.0 - share[k] - Reach::kBeside);
  }
  if ((hold.of == &sheet && !hold.rim) || behind < (1.0 - kComesBeside) * reach.away) return true;
  return near.distance < 0.0 ? least > 0.0 && !were_near(sheet, face, point) : near.depth > behind;
}

TouchRooms::Hold hold_at_rim(const TissueData& sheet, std::uint32_t point, const btVector3& at) {
  const TouchRooms::NearRim& near = sheet.touch.near_rims[point];
  const Rim rim(sheet, near.face, near.opposite);
  const btVector3 off = at - rim.from;
  TouchRooms::Hold hold;
  hold.of = &sheet;
  hold.face = near.face;
  hold.share[rim.second] = rim.along.dot(off) / rim.length;
  hold.share[rim.first] = 1.0 - hold.share[rim.second];
  hold.rim = true;
  hold.above = rim.normal.dot(off);
  return hold;
}

btVector3 place_of(const TissueData& sheet, const TouchRooms::Hold& hold) {
  const btVector3 on = place_of(sheet, hold.face, hold.share);
  return hold.rim ? btVector3(on + normal_of(sheet, hold.face) * hold.above) : on;
}

}  // namespace ambf::physics::detail
