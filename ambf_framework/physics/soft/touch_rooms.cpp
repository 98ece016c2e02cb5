// Rooms for the touches of one tissue, and what never changes of its surface: as it was loaded.
#include <algorithm>

#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kLone = 1e-9;      // of a weight
constexpr std::size_t kPairs = 16;  // room for pairs, of each point; with more, all are looked at in each step

}  // namespace

TouchRooms::TouchRooms(const TissueDefinition& given)
    : itself(given.touches_itself), others(given.touches_others), rims(given) {
  if (!itself && !others) return;
  const TissueGrid& grid = given.grid;
  for (const TissuePoint& point : grid.points) {
    lone.push_back(kNoLone);
    for (std::size_t k = 0; k < 4; ++k)
      if (point.weight[k] > 1.0 - kLone) lone.back() = static_cast<std::uint8_t>(k);
  }
  point_place.resize(grid.points.size());
  for (auto* room : {&face_middle, &face_normal}) room->resize(grid.faces.size());
  face_radius.resize(grid.faces.size());
  measure(grid);
  for (const TissueElement& element : grid.elements) {
    element_middle.push_back({});
    for (const std::uint32_t corner : element.corner) element_middle.back() += grid.corners[corner] * 0.25;
  }
  normal.resize(grid.points.size());
  area.resize(grid.points.size());
  at_corner.resize(std::max(grid.corners.size(), given.max_corners));
  cells.make_room(grid.points.size());
  behind.resize(grid.points.size());
  holds.resize(grid.points.size());
  if (itself && !grid.triangles.empty()) near_rims.resize(grid.points.size());
  paired_at.reserve(grid.points.size());
  is_paired.resize(grid.points.size());
  paired_points.reserve(grid.points.size());
  paired_faces.reserve(grid.faces.size());
  pairs.reserve(kPairs * grid.points.size());
  made.reserve(2 * grid.points.size() + Tissue::kFurtherTouches);
}

void TouchRooms::measure(const TissueGrid& grid) {
  if (!itself && !others) return;
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    const TissuePoint& point = grid.points[i];
    point_place[i] = {};
    for (std::size_t k = 0; k < 4; ++k) point_place[i] += grid.corners[point.corner[k]] * point.weight[k];
  }
  for (std::size_t f = 0; f < grid.faces.size(); ++f) {
    const auto& face = grid.faces[f];
    const Vec3 &a = point_place[face[0]], &b = point_place[face[1]], &c = point_place[face[2]];
    const Vec3 middle = (a + b + c) / 3.0, out = math::cross(b - a, c - a);
    const double size = math::norm(out);
    face_middle[f] = middle;
    face_normal[f] = size > 0.0 ? out / size : Vec3{};
    face_radius[f] = std::max({math::norm(a - middle), math::norm(b - middle), math::norm(c - middle)});
  }
}

void TouchRooms::let_go(const TissueData* tissue) {
  for (Hold& hold : holds)
    if (tissue == nullptr || hold.of == tissue) hold.of = nullptr;
}

void TouchRooms::stay(const TissueData& faces) {
  for (Hold& hold : holds) {
    if (hold.of != &faces) continue;
    btVector3 held(0, 0, 0), corner[3];
    bool went = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t point = faces.grid.faces[hold.face][k];
      held += faces.at[point] * hold.share[k];
      corner[k] = to_bullet(faces.solid.at(faces.grid.points[point]));
      went |= !(corner[k] - faces.at[point]).fuzzyZero();
    }
    if (!went) continue;
    const btVector3 ab = corner[1] - corner[0], ac = corner[2] - corner[0], off = held - corner[0];
    const btVector3 across = ab.cross(ac);
    if (!(across.length2() > 0.0)) {
      hold.of = nullptr;
      continue;
    }
    const double at_b = off.cross(ac).dot(across) / across.length2(),
                 at_c = ab.cross(off).dot(across) / across.length2();
    hold.share = {1.0 - at_b - at_c, at_b, at_c};
  }
}

}  // namespace ambf::physics::detail
