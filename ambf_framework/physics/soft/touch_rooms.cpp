// Rooms for the touches of one tissue, and what never changes of its surface: as it was loaded.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/rotation.h"
#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kLone = 1e-9;            // of a weight
constexpr std::size_t kPairs = 16;        // room for pairs, of each point; with more, all are looked at in each step
constexpr std::size_t kPairsOfEdge = 16;  // likewise, of each edge, with edges of others
constexpr double kRidge = 0.87;           // cosine: where faces of a solid make more of an angle, there is a ridge
constexpr double kSamePlace = 1e-5;       // elements

}  // namespace

TouchRooms::TouchRooms(const TissueDefinition& given)
    : itself(given.touches_itself), others(given.touches_others), rims(given), edges(given) {
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
  edges.let_go(tissue);
  for (Hold& hold : holds)
    if (tissue == nullptr || hold.of == tissue) hold.of = nullptr;
}

void TouchRooms::stay(const TissueData& faces) {
  edges.forget_friction(&faces);
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

TouchEdges::TouchEdges(const TissueDefinition& given) {
  const TissueGrid& grid = given.grid;
  if (!given.touches_others) return;
  const bool is_sheet = !grid.triangles.empty();
  const std::size_t faces = is_sheet || grid.seams.empty() ? grid.faces.size() : grid.first_inner_face;
  std::vector<Vec3> at;
  std::vector<std::uint32_t> place;
  std::map<std::array<long long, 3>, std::uint32_t> places;
  const double cell = kSamePlace * grid.element_size;
  for (const TissuePoint& point : grid.points) {
    at.push_back({});
    for (std::size_t k = 0; k < 4; ++k) at.back() += grid.corners[point.corner[k]] * point.weight[k];
    const std::array<long long, 3> key{std::llround(at.back().x / cell), std::llround(at.back().y / cell),
                                       std::llround(at.back().z / cell)};
    // Two layers of a sheet may lie on each other.
    place.push_back(is_sheet ? point.corner[0]
                             : places.try_emplace(key, static_cast<std::uint32_t>(places.size())).first->second);
  }
  const auto normal = [&](std::uint32_t f) {
    const auto& face = grid.faces[f];
    return math::normalized(math::cross(at[face[1]] - at[face[0]], at[face[2]] - at[face[0]]));
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> known;  // those that wait for their mate
  std::vector<Edge> found;
  for (std::uint32_t f = 0; f < faces; ++f)
    for (std::uint8_t k = 0; k < 3; ++k) {
      const auto& face = grid.faces[f];
      Edge edge;
      edge.point = {face[(k + 1U) % 3], face[(k + 2U) % 3]};
      edge.place = {place[edge.point[0]], place[edge.point[1]]};
      edge.face = f, edge.opposite = k;
      const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax(edge.place[0], edge.place[1]);
      longest = std::max(longest, math::norm(at[edge.point[1]] - at[edge.point[0]]));
      const auto [mate, is_first] = known.try_emplace(ends, edge);
      if (!is_first) {
        edge.second = true;
        edge.mate = mate->second.face, edge.mate_opposite = mate->second.opposite;
        mate->second.mate = f, mate->second.mate_opposite = k;
        const Vec3 out = normal(edge.mate);
        const Vec3 beyond = at[face[k]] - at[edge.point[0]];
        if (!is_sheet && math::dot(out, normal(f)) < kRidge && math::dot(out, beyond) < 0.0) edges.push_back(edge);
      }
      if (is_sheet) found.push_back(edge);
    }
  for (Edge& edge : found) {
    const Edge& first_one = known.at(std::minmax(edge.place[0], edge.place[1]));
    if (!edge.second) edge = first_one;
    edges.push_back(edge);
  }
  if (edges.empty()) return;
  const std::size_t most = std::min(kMaxPairs, kPairsOfEdge * edges.size());
  pairs.reserve(most), last.reserve(most);
  few.reserve(kMaxFew);  // they may be the other's
  first.resize(kSlots + 1);
  in_cell.resize(8 * kMaxFew);
}

void TouchEdges::begin_step() {
  pairs.swap(last);
  pairs.clear();
}

void TouchEdges::let_go(const TissueData* tissue) {
  for (auto* room : {&pairs, &last})
    std::erase_if(*room, [&](const Pair& pair) { return tissue == nullptr || pair.other == tissue; });
}

void TouchEdges::forget_friction(const TissueData* with) {
  for (Pair& pair : pairs)
    if (with == nullptr || pair.other == with) pair.held = false;
}

}  // namespace ambf::physics::detail
