// Rooms for the touches of one tissue, and what never changes of its surface: as it was loaded.
#include <algorithm>

#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kLone = 1e-9;      // of a weight
constexpr std::size_t kPairs = 16;  // room for pairs, of each point; with more, all are looked at in each step

}  // namespace

TouchRooms::TouchRooms(const TissueDefinition& given) : itself(given.touches_itself), others(given.touches_others) {
  if (!itself && !others) return;
  const TissueGrid& grid = given.grid;
  std::vector<Vec3>& at = point_place;
  for (const TissuePoint& point : grid.points) {
    at.push_back({});
    lone.push_back(kNoLone);
    for (std::size_t k = 0; k < 4; ++k) {
      at.back() += grid.corners[point.corner[k]] * point.weight[k];
      if (point.weight[k] > 1.0 - kLone) lone.back() = static_cast<std::uint8_t>(k);
    }
  }
  for (const auto& face : grid.faces) {
    const Vec3 &a = at[face[0]], &b = at[face[1]], &c = at[face[2]], middle = (a + b + c) / 3.0;
    const Vec3 out = math::cross(b - a, c - a);
    const double size = math::norm(out);
    face_middle.push_back(middle);
    face_normal.push_back(size > 0.0 ? out / size : Vec3{});
    face_radius.push_back(std::max({math::norm(a - middle), math::norm(b - middle), math::norm(c - middle)}));
  }
  for (const TissueElement& element : grid.elements) {
    element_middle.push_back({});
    for (const std::uint32_t corner : element.corner) element_middle.back() += grid.corners[corner] * 0.25;
  }
  std::size_t slots = 64;
  while (slots < 2 * grid.points.size()) slots *= 2;
  normal.resize(grid.points.size());
  area.resize(grid.points.size());
  at_corner.resize(std::max(grid.corners.size(), given.max_corners));
  first.resize(slots + 1);
  sorted.resize(grid.points.size());
  behind.resize(grid.points.size());
  holds.resize(grid.points.size());
  paired_at.reserve(grid.points.size());
  is_paired.resize(grid.points.size());
  paired_points.reserve(grid.points.size());
  paired_faces.reserve(grid.faces.size());
  pairs.reserve(kPairs * grid.points.size());
  made.reserve(2 * grid.points.size() + Tissue::kFurtherTouches);
}

void TouchRooms::let_go(const TissueData* tissue) {
  for (Hold& hold : holds)
    if (tissue == nullptr || hold.of == tissue) hold.of = nullptr;
}

}  // namespace ambf::physics::detail
