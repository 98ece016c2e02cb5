// From a mesh to the triangles that a sheet is made of.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "physics/soft/detail/long_edges.h"

namespace ambf::physics {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Face = std::array<std::uint32_t, 3>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

// Every corner of every triangle gets a point of its own, the first at each place that of the vertex; and where two
// triangles share an edge there is a seam.
void prepare_cuts(TissueGrid& grid) {
  std::vector<bool> taken(grid.corners.size(), false);
  for (std::uint32_t t = 0; t < grid.faces.size(); ++t)
    for (std::uint32_t& point : grid.faces[t]) {
      if (taken[point]) {
        TissuePoint further = grid.points[point];
        further.element = t;
        point = static_cast<std::uint32_t>(grid.points.size());
        grid.points.push_back(further);
      } else {
        taken[point] = true;
        grid.points[point].element = t;
      }
    }
  grid.first_inner_face = grid.faces.size();
  grid.first_inner_point = grid.points.size();
  std::map<Edge, std::pair<std::uint32_t, std::uint8_t>> known;  // the triangle, and its corner opposite to the edge
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    for (std::uint8_t k = 0; k < 3; ++k) {
      const auto& corner = grid.triangles[t].corner;
      const auto next = static_cast<std::uint8_t>((k + 1) % 3), last = static_cast<std::uint8_t>((k + 2) % 3);
      const auto [found, is_new] = known.try_emplace(std::minmax(corner[next], corner[last]), t, k);
      if (is_new) continue;
      const auto [other, opposite] = found->second;
      TissueSeam seam;
      seam.element = {other, t};
      for (std::size_t i = 0; i < 2; ++i) {
        seam.corner[0][i] = static_cast<std::uint8_t>((opposite + 1 + i) % 3);
        seam.corner[1][i] = grid.triangles[other].corner[seam.corner[0][i]] == corner[next] ? next : last;
      }
      grid.seams.push_back(seam);
    }
}

}  // namespace

namespace detail {

void divide_long_edges(TissueSurface& surface, double longest) {
  for (;;) {
    std::map<Edge, std::uint32_t> middle;
    const auto middle_of = [&](std::uint32_t a, std::uint32_t b) -> std::uint32_t {
      if (!(math::norm(surface.vertices[a] - surface.vertices[b]) > longest)) return kNone;
      const auto [found, is_new] =
          middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(surface.vertices.size()));
      if (is_new) surface.vertices.push_back((surface.vertices[a] + surface.vertices[b]) * 0.5);
      return found->second;
    };
    std::vector<Face> made;
    for (const Face& t : surface.triangles) {
      std::array<std::uint32_t, 3> m{};  // of the edge that begins at a corner
      int divided = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        m[k] = middle_of(t[k], t[(k + 1) % 3]);
        divided += m[k] == kNone ? 0 : 1;
      }
      if (divided == 0) {
        made.push_back(t);
      } else if (divided == 3) {
        for (std::size_t k = 0; k < 3; ++k) made.push_back({t[k], m[k], m[(k + 2) % 3]});
        made.push_back({m[0], m[1], m[2]});
      } else if (divided == 1) {
        const std::size_t k = m[0] != kNone ? 0 : (m[1] != kNone ? 1 : 2);
        made.push_back({t[k], m[k], t[(k + 2) % 3]});
        made.push_back({m[k], t[(k + 1) % 3], t[(k + 2) % 3]});
      } else {
        const std::size_t k = m[0] == kNone ? 1 : (m[1] == kNone ? 2 : 0);  // both edges after the one left whole
        const std::size_t l = (k + 1) % 3, o = (k + 2) % 3;
        made.push_back({m[k], t[l], m[l]});
        made.push_back({t[k], m[k], m[l]});
        made.push_back({t[k], m[l], t[o]});
      }
    }
    surface.triangles = std::move(made);
    if (middle.empty()) return;
  }
}

}  // namespace detail

std::size_t crowded_edges(const TissueSurface& surface) {
  std::map<Edge, std::size_t> sides;
  for (const Face& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
  return static_cast<std::size_t>(
      std::count_if(sides.begin(), sides.end(), [](const auto& each) { return each.second > 2; }));
}

TissueGrid make_sheet_grid(const TissueSurface& surface, double thickness, double longest, bool to_be_cut) {
  TissueSurface fine = surface;
  if (longest > 0.0) detail::divide_long_edges(fine, 1.001 * longest);
  TissueGrid grid;
  grid.thickness = thickness;
  grid.corners = std::move(fine.vertices);
  grid.faces = std::move(fine.triangles);
  double sum = 0.0;
  for (const Face& t : grid.faces) {
    grid.triangles.push_back({t});
    for (std::size_t k = 0; k < 3; ++k) sum += math::norm(grid.corners[t[k]] - grid.corners[t[(k + 1) % 3]]);
  }
  if (!grid.faces.empty()) grid.element_size = sum / static_cast<double>(3 * grid.faces.size());
  for (std::uint32_t i = 0; i < grid.corners.size(); ++i)
    grid.points.push_back({{i, i, i, i}, {1.0, 0.0, 0.0, 0.0}, 0});
  if (to_be_cut) prepare_cuts(grid);
  return grid;
}

}  // namespace ambf::physics
