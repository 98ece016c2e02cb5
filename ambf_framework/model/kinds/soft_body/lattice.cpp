// Nodes within the closed mesh of a soft body of links, on a lattice, and links between them and to its surface.
#include <algorithm>
#include <cmath>
#include <set>

#include "model/kinds/soft_body/detail/builder.h"
#include "physics/tissue_grid.h"
#include "scene/soft_limits.h"

namespace ambf::model {

namespace {

constexpr double kNear = 0.4;  // lattices: no inner node is nearer to a node of the surface, or along an axis to a face
constexpr double kReach = 1.5;    // lattices: a node of the surface is linked to inner ones up to so far away
constexpr double kBeside = 1e-3;  // lattices: it is so far beside the middle of the mesh, not to meet edges of faces

using Place = std::array<double, 3>;

Place place_of(const math::Vec3& v) { return {v.x, v.y, v.z}; }

// Where a line along an axis goes through the surface, in order. `u`, `v`: where it is along the next two axes.
std::vector<double> crossings(const std::vector<Place>& at, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                              std::size_t axis, double u, double v) {
  const std::size_t first = (axis + 1) % 3, second = (axis + 2) % 3;
  std::vector<double> found;
  for (const auto& t : triangles) {
    const Place &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
    const double bu = b[first] - a[first], bv = b[second] - a[second];
    const double cu = c[first] - a[first], cv = c[second] - a[second], pu = u - a[first], pv = v - a[second];
    const double all = bu * cv - bv * cu;
    if (all == 0.0) continue;
    const double at_b = (pu * cv - pv * cu) / all, at_c = (bu * pv - bv * pu) / all;
    if (at_b < 0.0 || at_c < 0.0 || at_b + at_c > 1.0) continue;
    found.push_back(a[axis] + (b[axis] - a[axis]) * at_b + (c[axis] - a[axis]) * at_c);
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool is_inside(const std::vector<double>& crossings, double at, double away) {
  const auto above = std::upper_bound(crossings.begin(), crossings.end(), at);
  if ((above - crossings.begin()) % 2 == 0 || above == crossings.end()) return false;
  return *above - at >= away && at - *(above - 1) >= away;
}

// Places `size` apart in the middle of a box.
class Lattice {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  Lattice(const mesh::BoundingBox& box, double size) : size_(size) {
    const Place low = place_of(box.min), high = place_of(box.max);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double fit = std::floor((high[axis] - low[axis]) / size);
      first_[axis] = 0.5 * (low[axis] + high[axis] - fit * size) + kBeside * size * static_cast<double>(axis + 1);
      count_[axis] = fit + 1.0;
    }
  }
  double count() const { return count_[0] * count_[1] * count_[2]; }

  void add_nodes(SoftNodes& nodes) {
    is_in_.assign(static_cast<std::size_t>(count()), true);
    node_.assign(is_in_.size(), kNone);
    std::vector<Place> surface;
    for (const math::Vec3& node : nodes.at) surface.push_back(place_of(node));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t first = (axis + 1) % 3, second = (axis + 2) % 3;
      std::array<int, 3> cell{};
      for (cell[first] = 0; cell[first] < count_[first]; ++cell[first])
        for (cell[second] = 0; cell[second] < count_[second]; ++cell[second]) {
          const std::vector<double> along =
              crossings(surface, nodes.triangles, axis, at(first, cell[first]), at(second, cell[second]));
          for (cell[axis] = 0; cell[axis] < count_[axis]; ++cell[axis])
            if (!is_inside(along, at(axis, cell[axis]), kNear * size_)) is_in_[number(cell)] = false;
        }
    }
    const std::vector<math::Vec3> of_surface = nodes.at;
    each([&](const std::array<int, 3>& cell) {
      const math::Vec3 place{at(0, cell[0]), at(1, cell[1]), at(2, cell[2])};
      if (!is_in_[number(cell)] || std::any_of(of_surface.begin(), of_surface.end(), [&](const math::Vec3& node) {
            return math::norm(node - place) < kNear * size_;
          }))
        return;
      node_[number(cell)] = static_cast<std::uint32_t>(nodes.at.size());
      nodes.at.push_back(place);
    });
  }

  // Neighbours along axes and across the squares between them, so that it resists shear.
  void add_links(std::set<std::array<std::uint32_t, 2>>& links) const {
    each([&](const std::array<int, 3>& cell) {
      const std::uint32_t own = node_[number(cell)];
      if (own == kNone) return;
      for (const auto& way : kWays)
        if (const std::uint32_t other = beside(cell, way); other != kNone) links.insert({own, other});
    });
  }

  // Nodes that lack a neighbour along an axis.
  std::vector<std::uint32_t> rim() const {
    std::vector<std::uint32_t> found;
    each([&](const std::array<int, 3>& cell) {
      const std::uint32_t own = node_[number(cell)];
      if (own == kNone) return;
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
          std::array<int, 3> way{};
          way[axis] = side;
          if (beside(cell, way) != kNone) continue;
          found.push_back(own);
          return;
        }
    });
    return found;
  }

 private:
  static constexpr std::array<std::array<int, 3>, 9> kWays{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}}};

  double at(std::size_t axis, int cell) const { return first_[axis] + cell * size_; }
  std::size_t number(const std::array<int, 3>& cell) const {
    return static_cast<std::size_t>((cell[0] * count_[1] + cell[1]) * count_[2] + cell[2]);
  }
  std::uint32_t beside(const std::array<int, 3>& cell, const std::array<int, 3>& way) const {
    std::array<int, 3> other{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      other[axis] = cell[axis] + way[axis];
      if (other[axis] < 0 || other[axis] >= count_[axis]) return kNone;
    }
    return node_[number(other)];
  }
  template <class Visit>
  void each(const Visit& visit) const {
    std::array<int, 3> cell{};
    for (cell[0] = 0; cell[0] < count_[0]; ++cell[0])
      for (cell[1] = 0; cell[1] < count_[1]; ++cell[1])
        for (cell[2] = 0; cell[2] < count_[2]; ++cell[2]) visit(cell);
  }

  double size_;
  Place first_{}, count_{};  // m; whole numbers
  std::vector<bool> is_in_;
  std::vector<std::uint32_t> node_;
};

}  // namespace

// Each node of the surface is linked to all inner ones that are near, and each at the rim to the nearest of the
// surface: none is without.
void add_inner_lattice(const scene::KindBlock& block, double size, SoftNodes& nodes, Findings& findings) {
  const auto leave_out = [&](const std::string& problem, const std::string& what_to_do) {
    findings.warning(block.identity, "config/inner lattice", problem, what_to_do + "; there is none");
  };
  if (nodes.triangles.empty()) return leave_out("the collision mesh has no triangles", "give a closed mesh");
  if (const std::size_t open = physics::open_edges({nodes.at, nodes.triangles}); open > 0)
    return leave_out("the collision mesh is not closed: it is open along " + std::to_string(open) + " edges",
                     "close it, or give another `collision mesh`");
  Lattice lattice(mesh::bounds_of(nodes.at), size);
  if (!(lattice.count() <= 8.0 * scene::kMaxSoftNodes))
    return leave_out("of " + scene::text_of(size) + " m has some " + scene::text_of(lattice.count()) +
                         " places; at most " + std::to_string(scene::kMaxSoftNodes) + " nodes are simulated",
                     "give a larger distance: twice as far apart they are an eighth");
  const auto count = static_cast<std::uint32_t>(nodes.at.size());
  lattice.add_nodes(nodes);
  if (nodes.at.size() == count)
    return leave_out("no place " + scene::text_of(size) + " m apart is within the mesh", "give a smaller distance");
  std::set<std::array<std::uint32_t, 2>> links;
  lattice.add_links(links);
  for (std::uint32_t node = 0; node < count; ++node)
    for (std::uint32_t inner = count; inner < nodes.at.size(); ++inner)
      if (math::norm(nodes.at[node] - nodes.at[inner]) < kReach * size) links.insert({node, inner});
  for (const std::uint32_t inner : lattice.rim()) {
    const auto nearer = [&](const math::Vec3& a, const math::Vec3& b) {
      return math::norm(a - nodes.at[inner]) < math::norm(b - nodes.at[inner]);
    };
    const auto nearest = std::min_element(nodes.at.begin(), nodes.at.begin() + count, nearer);
    links.insert({static_cast<std::uint32_t>(nearest - nodes.at.begin()), inner});
  }
  nodes.lines.insert(nodes.lines.end(), links.begin(), links.end());
}

}  // namespace ambf::model
