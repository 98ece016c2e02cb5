#include "physics/soft/detail/sheet_rims.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kNear = 1.5;   // elements, between triangles as loaded: cuts move corners by up to half of one
constexpr double kShort = 0.2;  // of what an edge was: it hardly runs along the rim
constexpr double kFlat = 0.05;  // of what a triangle's area was

}  // namespace

SheetRims::SheetRims(const TissueDefinition& given) {
  const TissueGrid& grid = given.grid;
  if (grid.triangles.empty()) return;
  const std::size_t count = grid.triangles.size();
  border_.assign(count, 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  const auto each_edge = [&](const auto& use) {
    for (std::size_t t = 0; t < count; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& corner = grid.triangles[t].corner;
        use(t, k, sides[std::minmax(corner[(k + 1) % 3], corner[(k + 2) % 3])]);
      }
  };
  each_edge([](std::size_t, std::size_t, int& of) { ++of; });
  each_edge([&](std::size_t t, std::size_t k, int of) {
    if (of == 1) border_[t] = static_cast<std::uint8_t>(border_[t] | 1U << k);
  });
  edges_ = border_;
  out_.assign(count, 0);
  flat_.assign(count, 0);
  corner_.resize(std::max(grid.corners.size(), given.max_corners));
  near_cut_.assign(count, 0);
  if (grid.seams.empty()) return;
  std::vector<Vec3> middle;
  std::vector<double> radius;
  for (const TissueTriangle& triangle : grid.triangles) {
    Vec3 sum{};
    double most = 0.0;
    for (const std::uint32_t corner : triangle.corner) sum += grid.corners[corner] / 3.0;
    for (const std::uint32_t corner : triangle.corner) most = std::max(most, math::norm(grid.corners[corner] - sum));
    middle.push_back(sum);
    radius.push_back(most);
  }
  for (std::uint32_t t = 0; t < count; ++t) {
    first_near_.push_back(static_cast<std::uint32_t>(near_.size()));
    for (std::uint32_t other = 0; other < count; ++other)
      if (math::norm(middle[other] - middle[t]) < radius[other] + radius[t] + kNear * grid.element_size)
        near_.push_back(other);
  }
  first_near_.push_back(static_cast<std::uint32_t>(near_.size()));
  joined_.assign(corner_.size(), 0);
  joined_round_.assign(count, 0);
}

void SheetRims::follow(const TissueGrid& grid, const TissueCuts& cuts, const TissueSolid& solid,
                       const std::vector<Vec3>& places) {
  if (edges_.empty() || places.empty()) return;
  edges_ = border_;
  joined_of_ = kNone;
  std::fill(near_cut_.begin(), near_cut_.end(), std::uint8_t{0});
  for (std::size_t s = 0; cuts.possible() && s < grid.seams.size(); ++s) {
    if (!cuts.open(s)) continue;
    const TissueSeam& seam = grid.seams[s];
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t t = seam.element[side];
      const unsigned opposite = 3U - seam.corner[side][0] - seam.corner[side][1];
      edges_[t] = static_cast<std::uint8_t>(edges_[t] | 1U << opposite);
      for (std::uint32_t i = first_near_[t]; i < first_near_[t + 1]; ++i) near_cut_[near_[i]] = 1;
    }
  }
  std::fill(corner_.begin(), corner_.end(), std::uint8_t{0});
  for (std::size_t t = 0; t < edges_.size(); ++t) {
    const std::uint32_t* corner = solid.corners_of(t);
    Vec3 at[3], was[3];
    for (std::size_t k = 0; k < 3; ++k) at[k] = places[grid.faces[t][k]], was[k] = grid.corners[corner[k]];
    const Vec3 middle = (was[0] + was[1] + was[2]) / 3.0, normal = math::cross(was[1] - was[0], was[2] - was[0]);
    const double left = math::dot(math::cross(at[1] - at[0], at[2] - at[0]), normal);
    flat_[t] = left > kFlat * math::dot(normal, normal) ? 0 : 1;
    out_[t] = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_rim(t, k)) continue;
      const std::size_t from = (k + 1) % 3, to = (k + 2) % 3;
      corner_[corner[from]] = corner_[corner[to]] = 1;
      const Vec3 along = at[to] - at[from], out = math::cross(along, normal);
      if (math::norm(along) > kShort * math::norm(was[to] - was[from]) &&
          math::dot(out, (at[from] + at[to]) * 0.5 - middle) > 0.0)
        out_[t] = static_cast<std::uint8_t>(out_[t] | 1U << k);
    }
  }
}

bool SheetRims::joins(const TissueSolid& solid, std::uint32_t triangle, std::uint32_t corner) {
  if (near_cut_[triangle] == 0) return true;
  if (joined_of_ != triangle) {
    joined_of_ = triangle;
    ++round_;
    const auto join = [&](std::uint32_t t) {
      joined_round_[t] = round_;
      for (std::size_t k = 0; k < 3; ++k) joined_[solid.corners_of(t)[k]] = round_;
    };
    join(triangle);
    for (bool more = true; more;) {
      more = false;
      for (std::uint32_t i = first_near_[triangle]; i < first_near_[triangle + 1]; ++i) {
        const std::uint32_t t = near_[i], *at = solid.corners_of(t);
        if (joined_round_[t] == round_ ||
            std::none_of(at, at + 3, [&](std::uint32_t each) { return joined_[each] == round_; }))
          continue;
        join(t);
        more = true;
      }
    }
  }
  return joined_[corner] == round_;
}

}  // namespace ambf::physics::detail
