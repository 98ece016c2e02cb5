#include "physics/tissue_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "physics/soft/detail/long_edges.h"
#include "physics/soft/detail/tissue_seams.h"
#include "physics/soft/detail/weights.h"

namespace ambf::physics {

using math::Vec3;

namespace {

constexpr int kSamples = 6;              // along each side of a cube
constexpr double kMinShare = 0.05;       // elements with less tissue are left out
constexpr double kBesideCorners = 1e-4;  // of a cube: samples lie on no edge of a surface along the axes
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Face = std::array<std::uint32_t, 3>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

// Corners of a cube by the bits of their number: x, y, z. Every other cube is mirrored along x, so that the diagonals
// of faces meet.
constexpr std::array<std::array<std::uint32_t, 4>, 5> kParts = {
    {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}}};

// Which of kParts a place in the cube is in; u, v and w from 0 to 1.
std::size_t part_at(double u, double v, double w) {
  if (u + v + w < 1.0) return 0;
  if ((1.0 - u) + (1.0 - v) + w < 1.0) return 1;
  if ((1.0 - u) + v + (1.0 - w) < 1.0) return 2;
  if (u + (1.0 - v) + (1.0 - w) < 1.0) return 3;
  return 4;
}

struct Lattice {
  Vec3 low;
  Vec3 cube;  // m
  std::array<int, 3> count{};

  Lattice(const std::vector<Vec3>& vertices, double size) {
    Vec3 high = low = vertices.front();
    for (const Vec3& v : vertices) {
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    const Vec3 extent = high - low;
    const auto cubes = [&](double length) { return std::max(1, static_cast<int>(std::ceil(length / size - 1e-6))); };
    count = {cubes(extent.x), cubes(extent.y), cubes(extent.z)};
    cube = {extent.x / count[0], extent.y / count[1], extent.z / count[2]};
  }
  std::size_t cells() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }
  std::size_t cell(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(count[0]) +
           static_cast<std::size_t>(x);
  }
  static bool mirrored(int x, int y, int z) { return (x + y + z) % 2 != 0; }
  detail::Tetrahedron part(int x, int y, int z, std::size_t number) const {
    detail::Tetrahedron made;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t bits = mirrored(x, y, z) ? kParts[number][k] ^ 1U : kParts[number][k];
      made[k] = low + Vec3{(x + static_cast<int>(bits & 1U)) * cube.x, (y + static_cast<int>(bits >> 1U & 1U)) * cube.y,
                           (z + static_cast<int>(bits >> 2U)) * cube.z};
    }
    return made;
  }
};

// How often a line along z enters and leaves the surface: where, and 1 for each entry, -1 for each exit.
using Crossings = std::vector<std::pair<double, int>>;

class Samples {
 public:
  Samples(const TissueSurface& surface, const Lattice& lattice)
      : lattice_(lattice), nx_(lattice.count[0] * kSamples), ny_(lattice.count[1] * kSamples) {
    lines_.resize(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
    for (const Face& t : surface.triangles)
      cross(surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]);
    for (Crossings& line : lines_) std::sort(line.begin(), line.end());
  }
  double x(int i) const { return lattice_.low.x + (i + 0.5 + kBesideCorners) * lattice_.cube.x / kSamples; }
  double y(int j) const { return lattice_.low.y + (j + 0.5 + 0.7 * kBesideCorners) * lattice_.cube.y / kSamples; }
  double z(int k) const { return lattice_.low.z + (k + 0.5) * lattice_.cube.z / kSamples; }
  const Crossings& line(int i, int j) const {
    return lines_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i)];
  }
  int nx() const { return nx_; }
  int ny() const { return ny_; }

 private:
  void cross(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0.0) return;
    const auto first = [](double value, double low, double step) {
      return static_cast<int>(std::floor((value - low) / step)) - 1;
    };
    const double dx = lattice_.cube.x / kSamples, dy = lattice_.cube.y / kSamples;
    const int i0 = std::max(0, first(std::min({a.x, b.x, c.x}), lattice_.low.x, dx));
    const int i1 = std::min(nx_ - 1, first(std::max({a.x, b.x, c.x}), lattice_.low.x, dx) + 2);
    const int j0 = std::max(0, first(std::min({a.y, b.y, c.y}), lattice_.low.y, dy));
    const int j1 = std::min(ny_ - 1, first(std::max({a.y, b.y, c.y}), lattice_.low.y, dy) + 2);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) {
        const double px = x(i), py = y(j);
        const double wa = ((b.x - px) * (c.y - py) - (c.x - px) * (b.y - py)) / area;
        const double wb = ((c.x - px) * (a.y - py) - (a.x - px) * (c.y - py)) / area;
        const double wc = 1.0 - wa - wb;
        if (wa < 0.0 || wb < 0.0 || wc < 0.0) continue;
        lines_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i)].push_back(
            {wa * a.z + wb * b.z + wc * c.z, area < 0.0 ? 1 : -1});
      }
  }

  const Lattice& lattice_;
  int nx_, ny_;
  std::vector<Crossings> lines_;
};

// The share of each part of each cube that is within the surface.
std::vector<double> shares(const TissueSurface& surface, const Lattice& lattice) {
  const Samples samples(surface, lattice);
  std::vector<double> within(5 * lattice.cells(), 0.0);
  std::array<double, 5> all{};
  for (int k = 0; k < kSamples; ++k)
    for (int j = 0; j < kSamples; ++j)
      for (int i = 0; i < kSamples; ++i)
        all[part_at((i + 0.5) / kSamples, (j + 0.5) / kSamples, (k + 0.5) / kSamples)] += 1.0;
  for (int j = 0; j < samples.ny(); ++j)
    for (int i = 0; i < samples.nx(); ++i) {
      const Crossings& line = samples.line(i, j);
      std::size_t next = 0;
      int inside = 0;
      for (int k = 0; k < lattice.count[2] * kSamples; ++k) {
        while (next < line.size() && line[next].first < samples.z(k)) inside += line[next++].second;
        if (inside <= 0) continue;
        const int x = i / kSamples, y = j / kSamples, z = k / kSamples;
        double u = (i % kSamples + 0.5) / kSamples;
        if (Lattice::mirrored(x, y, z)) u = 1.0 - u;
        const std::size_t part = part_at(u, (j % kSamples + 0.5) / kSamples, (k % kSamples + 0.5) / kSamples);
        within[5 * lattice.cell(x, y, z) + part] += 1.0 / all[part];
      }
    }
  return within;
}

std::array<double, 4> weights_in(const TissueGrid& grid, const TissueElement& element, const Vec3& point) {
  const auto& [a, b, c, d] = element.corner;
  return detail::weights_in({grid.corners[a], grid.corners[b], grid.corners[c], grid.corners[d]}, point);
}

// In the element that it is in, or else the one that it is least out of, of the cubes around.
TissuePoint embed(const TissueGrid& grid, const Lattice& lattice, const std::vector<std::uint32_t>& elements,
                  const Vec3& point) {
  const auto index = [](double value, double low, double size, int count) {
    return std::clamp(static_cast<int>(std::floor((value - low) / size)), 0, count - 1);
  };
  const int x = index(point.x, lattice.low.x, lattice.cube.x, lattice.count[0]);
  const int y = index(point.y, lattice.low.y, lattice.cube.y, lattice.count[1]);
  const int z = index(point.z, lattice.low.z, lattice.cube.z, lattice.count[2]);
  TissuePoint best;
  for (int reach = 1; reach < 64; reach *= 2) {
    double least = -std::numeric_limits<double>::infinity();
    for (int k = std::max(0, z - reach); k <= std::min(lattice.count[2] - 1, z + reach); ++k)
      for (int j = std::max(0, y - reach); j <= std::min(lattice.count[1] - 1, y + reach); ++j)
        for (int i = std::max(0, x - reach); i <= std::min(lattice.count[0] - 1, x + reach); ++i)
          for (std::size_t part = 0; part < 5; ++part) {
            const std::uint32_t element = elements[5 * lattice.cell(i, j, k) + part];
            if (element == kNone) continue;
            const std::array<double, 4> weight = weights_in(grid, grid.elements[element], point);
            const double smallest = *std::min_element(weight.begin(), weight.end());
            if (smallest <= least + 1e-9) continue;
            least = smallest;
            best = {grid.elements[element].corner, weight, element};
          }
    if (least > -std::numeric_limits<double>::infinity()) break;
  }
  return best;
}

// What is wholly within stays 1; the others share what is left of the surface's volume.
void fit_volume(TissueGrid& grid, double wanted) {
  double whole = 0.0, partial = 0.0;
  for (const TissueElement& e : grid.elements) {
    const Vec3 o = grid.corners[e.corner[0]];
    const double volume = math::dot(grid.corners[e.corner[1]] - o,
                                    math::cross(grid.corners[e.corner[2]] - o, grid.corners[e.corner[3]] - o)) /
                          6.0;
    (e.share < 0.999 ? partial : whole) += volume * e.share;
  }
  const double factor = partial > 0.0 ? std::clamp((wanted - whole) / partial, 0.5, 2.0) : 1.0;
  for (TissueElement& e : grid.elements) e.share = e.share < 0.999 ? std::min(1.0, e.share * factor) : 1.0;
}

}  // namespace

std::size_t open_edges(const TissueSurface& surface) {
  std::map<Edge, int> balance;
  for (const Face& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return static_cast<std::size_t>(
      std::count_if(balance.begin(), balance.end(), [](const auto& each) { return each.second != 0; }));
}

double volume_within(const TissueSurface& surface) {
  double six = 0.0;
  if (surface.vertices.empty()) return 0.0;
  const Vec3 o = surface.vertices.front();
  for (const Face& t : surface.triangles)
    six += math::dot(surface.vertices[t[0]] - o, math::cross(surface.vertices[t[1]] - o, surface.vertices[t[2]] - o));
  return six / 6.0;
}

double max_elements(const TissueSurface& surface, double element_size) {
  if (surface.vertices.empty()) return 0.0;
  Vec3 low = surface.vertices.front(), high = low;
  for (const Vec3& v : surface.vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const auto cubes = [&](double length) { return std::max(1.0, std::ceil(length / element_size - 1e-6)); };
  return 5.0 * cubes(high.x - low.x) * cubes(high.y - low.y) * cubes(high.z - low.z);
}

TissueGrid make_tissue_grid(const TissueSurface& surface, double element_size, bool to_be_cut) {
  TissueGrid grid;
  const Lattice lattice(surface.vertices, element_size);
  grid.element_size = std::min({lattice.cube.x, lattice.cube.y, lattice.cube.z});
  const std::vector<double> within = shares(surface, lattice);
  std::vector<std::uint32_t> elements(within.size(), kNone);
  std::vector<detail::Tetrahedron> left_out;
  const int px = lattice.count[0] + 1, py = lattice.count[1] + 1;
  std::map<int, std::uint32_t> numbers;
  for (int z = 0; z < lattice.count[2]; ++z)
    for (int y = 0; y < lattice.count[1]; ++y)
      for (int x = 0; x < lattice.count[0]; ++x)
        for (std::size_t part = 0; part < 5; ++part) {
          const std::size_t slot = 5 * lattice.cell(x, y, z) + part;
          if (within[slot] < kMinShare) {
            if (to_be_cut) left_out.push_back(lattice.part(x, y, z, part));
            continue;
          }
          TissueElement element;
          element.share = std::min(1.0, within[slot]);
          for (std::size_t k = 0; k < 4; ++k) {
            std::uint32_t bits = kParts[part][k];
            if (Lattice::mirrored(x, y, z)) bits ^= 1U;
            const int i = x + static_cast<int>(bits & 1U), j = y + static_cast<int>(bits >> 1U & 1U),
                      l = z + static_cast<int>(bits >> 2U);
            const auto [found, is_new] =
                numbers.try_emplace((l * py + j) * px + i, static_cast<std::uint32_t>(grid.corners.size()));
            if (is_new)
              grid.corners.push_back(lattice.low + Vec3{i * lattice.cube.x, j * lattice.cube.y, l * lattice.cube.z});
            element.corner[k] = found->second;
          }
          const Vec3 o = grid.corners[element.corner[0]];
          if (math::dot(grid.corners[element.corner[1]] - o,
                        math::cross(grid.corners[element.corner[2]] - o, grid.corners[element.corner[3]] - o)) < 0.0)
            std::swap(element.corner[2], element.corner[3]);
          elements[slot] = static_cast<std::uint32_t>(grid.elements.size());
          grid.elements.push_back(element);
        }
  if (grid.elements.empty()) return grid;
  fit_volume(grid, volume_within(surface));
  if (to_be_cut) {
    detail::add_cut_faces(grid, surface, left_out,
                          [&](const Vec3& point) { return embed(grid, lattice, elements, point); });
    return grid;
  }
  TissueSurface fine = surface;
  detail::divide_long_edges(fine, 1.001 * element_size);
  for (const Vec3& vertex : fine.vertices) grid.points.push_back(embed(grid, lattice, elements, vertex));
  grid.faces = std::move(fine.triangles);
  return grid;
}

}  // namespace ambf::physics
