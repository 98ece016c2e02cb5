// Which points and faces of one tissue may touch: those that are near each other and do not hang together there. They
// are found anew only when something has moved by some of an element since, so that tissue which is neither cut nor
// folded costs next to nothing.
#include <algorithm>
#include <cmath>

#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/touch_search.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kSlack = 0.12;    // elements: what has moved by that is looked at anew
constexpr double kAside = 2.0;     // elements, beyond a face: what is behind it there as loaded never touches it
constexpr double kBehind = 0.001;  // elements: as loaded, what is no further behind a face is on it
// Elements: what was no further from a triangle of its sheet touches it only beyond a cut.
constexpr double kBesideSheet = 1.0;

bool has_moved(const TissueData& tissue) {
  const double slack = kSlack * tissue.grid.element_size;
  return std::any_of(tissue.touch.paired_at.begin(), tissue.touch.paired_at.end(), [&](const PointCells::Sorted& each) {
    const Vec3 way = from_bullet(tissue.at[each.point]) - each.at;
    return !(math::dot(way, way) <= slack * slack);
  });
}

bool find_pairs(TissueData& tissue, double reach) {
  TouchRooms& rooms = tissue.touch;
  count(tissue);
  rooms.pairs.clear();
  std::fill(rooms.is_paired.begin(), rooms.is_paired.end(), std::uint8_t{0});
  rooms.paired_at.assign(rooms.cells.sorted.begin(), rooms.cells.sorted.begin() + rooms.cells.count());
  const double near = reach + 2.0 * kSlack * tissue.grid.element_size;  // both may move
  const btVector3 around(near, near, near);
  for (std::uint32_t f = 0; f < tissue.grid.faces.size(); ++f) {
    if (!tissue.cuts.shows_face(f)) continue;
    const auto& face = tissue.grid.faces[f];
    btVector3 from = tissue.at[face[0]], to = from;
    for (std::size_t k = 1; k < 3; ++k) from.setMin(tissue.at[face[k]]), to.setMax(tissue.at[face[k]]);
    const Box box{from - around, to + around};
    rooms.cells.each_near(box.low, box.high, [&](const PointCells::Sorted& each) {
      if (!box.contains(to_bullet(each.at)) || hang_together(tissue, f, each.point)) return;
      if (rooms.pairs.size() < rooms.pairs.capacity()) rooms.pairs.push_back({f, each.point});
      rooms.is_paired[each.point] = 1;
    });
    if (rooms.pairs.size() == rooms.pairs.capacity()) return false;
  }
  rooms.paired_points.clear();
  for (std::uint32_t i = 0; i < rooms.is_paired.size(); ++i) {
    if (rooms.is_paired[i] != 0)
      rooms.paired_points.push_back(i);
    else if (rooms.holds[i].of == &tissue)
      rooms.holds[i].of = nullptr;
  }
  rooms.paired_faces.clear();
  for (std::uint32_t f = 0; f < tissue.grid.faces.size() && !rooms.paired_points.empty(); ++f) {
    const auto& face = tissue.grid.faces[f];
    if (tissue.cuts.shows_face(f) && std::any_of(face.begin(), face.end(), [&](std::uint32_t point) {
          return rooms.is_paired[stands_for(tissue, point)] != 0;
        }))
      rooms.paired_faces.push_back(f);
  }
  return true;
}

}  // namespace

bool were_near(const TissueData& sheet, std::uint32_t f, std::uint32_t point) {
  const TouchRooms& rooms = sheet.touch;
  return math::norm(rooms.point_place[point] - rooms.face_middle[f]) <
         rooms.face_radius[f] + kBesideSheet * sheet.grid.element_size;
}

bool hang_together(TissueData& tissue, std::uint32_t f, std::uint32_t point) {
  TouchRooms& rooms = tissue.touch;
  if (tissue.is_sheet())
    return were_near(tissue, f, point) && rooms.rims.joins(tissue.solid, f, corner_at(tissue, point));
  const std::uint32_t element = tissue.grid.points[point].element;
  const double aside = rooms.face_radius[f] + kAside * tissue.grid.element_size;
  const auto is_behind = [&](const Vec3& place, double beyond) {
    const Vec3 way = place - rooms.face_middle[f];
    const double along = math::dot(way, rooms.face_normal[f]);
    return along < beyond && math::dot(way, way) - along * along < aside * aside;
  };
  if (is_behind(rooms.element_middle[element], 0.0)) return true;
  if (is_behind(rooms.point_place[point], -kBehind * tissue.grid.element_size)) return true;
  const std::uint32_t* own = tissue.solid.corners_of(element);
  for (const std::uint32_t each : tissue.grid.faces[f]) {
    const std::uint32_t* other = tissue.solid.corners_of(tissue.grid.points[each].element);
    for (int i = 0; i < 4; ++i)
      if (std::find(other, other + 4, own[i]) != other + 4) return true;
  }
  return false;
}

bool pair_up(TissueData& tissue, double reach) {
  TouchRooms& rooms = tissue.touch;
  if (!rooms.paired || has_moved(tissue)) rooms.paired = find_pairs(tissue, reach);
  if (!rooms.paired) return false;
  for (const std::uint32_t point : rooms.paired_points) rooms.normal[point].setZero(), rooms.area[point] = 0.0;
  for (const std::uint32_t f : rooms.paired_faces) {
    const auto& face = tissue.grid.faces[f];
    const btVector3& a = tissue.at[face[0]];
    const btVector3 normal = (tissue.at[face[1]] - a).cross(tissue.at[face[2]] - a);
    const double share = normal.length() / 6.0;
    for (const std::uint32_t point : face) {
      const std::uint32_t first = stands_for(tissue, point);
      if (rooms.is_paired[first] == 0) continue;
      rooms.normal[first] += normal;
      rooms.area[first] += share;
    }
  }
  for (const std::uint32_t point : rooms.paired_points)
    if (const double length = rooms.normal[point].length(); length > 0.0) rooms.normal[point] /= length;
  return true;
}

}  // namespace ambf::physics::detail
