#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "mesh/hash_seed.h"
#include "mesh/weld_points.h"

namespace ambf::mesh {

namespace {

// Cells are a few tolerances wide: then a vertex seldom needs more than its own cell, and a cell holds few distinct vertices.
constexpr double kCellInEpsilons = 4.0;
constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

class Grid {
 public:
  Grid(std::size_t vertices, double cell, const math::Vec3& low) : inverse_cell_(1.0 / cell), low_(low) {
    std::size_t size = 64;
    while (size < 2 * vertices) size *= 2;
    mask_ = size - 1;
    heads_.assign(size, kNothing);
  }

  std::int64_t cell_of(double value, double low) const {
    return static_cast<std::int64_t>(std::floor((value - low) * inverse_cell_));
  }
  const math::Vec3& low() const { return low_; }

  // First of the distinct vertices in a cell's bucket (several cells may share one); next() goes on.
  std::uint32_t first(std::int64_t x, std::int64_t y, std::int64_t z) const { return heads_[bucket(x, y, z)]; }
  std::uint32_t next(std::uint32_t distinct) const { return next_[distinct]; }

  // Distinct vertices are added with consecutive numbers.
  void add(std::int64_t x, std::int64_t y, std::int64_t z) {
    std::uint32_t& head = heads_[bucket(x, y, z)];
    next_.push_back(head);
    head = static_cast<std::uint32_t>(next_.size() - 1);
  }

 private:
  std::size_t bucket(std::int64_t x, std::int64_t y, std::int64_t z) const {
    std::uint64_t h = seed_ ^ static_cast<std::uint64_t>(x);
    h = (h ^ (h >> 29)) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(y);
    h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ULL + static_cast<std::uint64_t>(z);
    h = (h ^ (h >> 32)) * 0x94D049BB133111EBULL;
    return static_cast<std::size_t>(h ^ (h >> 31)) & mask_;
  }

  double inverse_cell_;
  math::Vec3 low_;
  // At random, so that no file can be made to collide on purpose; results do not depend on it.
  std::uint64_t seed_ = hash_seed();
  std::size_t mask_ = 0;
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

Weld weld_points(std::size_t count, const std::function<math::Vec3(std::size_t)>& point, double epsilon) {
  Weld out;
  out.first.resize(count);
  out.welded.resize(count);
  if (count == 0) return out;

  BoundingBox box{point(0), point(0)};
  for (std::size_t i = 1; i < count; ++i) {
    const math::Vec3 p = point(i);
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
  }
  // Cell numbers must fit 63 bits, and zero tolerance needs some cell: 2^-50 of the largest extent does for both.
  const math::Vec3 extent = box.size();
  const double largest = std::max({extent.x, extent.y, extent.z, std::numeric_limits<double>::min() * 0x1p60});
  const double cell = std::max(kCellInEpsilons * epsilon, largest * 0x1p-50);
  Grid grid(count, cell, box.min);

  for (std::size_t i = 0; i < count; ++i) {
    const math::Vec3 p = point(i);
    std::int64_t from[3], to[3];
    const double values[3] = {p.x, p.y, p.z}, low[3] = {box.min.x, box.min.y, box.min.z};
    for (int k = 0; k < 3; ++k) {
      from[k] = grid.cell_of(values[k] - epsilon, low[k]);
      to[k] = grid.cell_of(values[k] + epsilon, low[k]);
    }
    std::uint32_t found = kNothing;  // the lowest distinct vertex within epsilon
    for (std::int64_t x = from[0]; x <= to[0]; ++x) {
      for (std::int64_t y = from[1]; y <= to[1]; ++y) {
        for (std::int64_t z = from[2]; z <= to[2]; ++z) {
          for (std::uint32_t j = grid.first(x, y, z); j != kNothing; j = grid.next(j)) {
            if (j >= found) continue;
            const math::Vec3 d = point(out.distinct[j]) - p;
            if (math::dot(d, d) <= epsilon * epsilon) found = j;
          }
        }
      }
    }
    if (found == kNothing) {
      found = static_cast<std::uint32_t>(out.distinct.size());
      out.distinct.push_back(static_cast<std::uint32_t>(i));
      grid.add(grid.cell_of(p.x, low[0]), grid.cell_of(p.y, low[1]), grid.cell_of(p.z, low[2]));
    }
    out.first[i] = out.distinct[found];
    out.welded[i] = found;
  }
  return out;
}

Weld weld(const std::vector<math::Vec3>& vertices, double epsilon) {
  return weld_points(
      vertices.size(), [&vertices](std::size_t i) { return vertices[i]; }, epsilon);
}

std::vector<std::vector<std::uint32_t>> copies_of(const Weld& weld) {
  std::vector<std::vector<std::uint32_t>> copies(weld.distinct.size());
  for (std::size_t i = 0; i < weld.welded.size(); ++i) copies[weld.welded[i]].push_back(static_cast<std::uint32_t>(i));
  return copies;
}

CollisionMesh make_collision_mesh(const Mesh& mesh, double epsilon_relative, Weld* out_weld) {
  std::vector<math::Vec3> all;
  all.reserve(mesh.vertex_count());
  for (const Submesh& s : mesh.submeshes) {
    for (std::size_t i = 0; i < s.vertex_count(); ++i) all.push_back(s.vertex(i));
  }
  Weld joined = weld(all, epsilon_relative * bounds_of(all).diagonal());

  CollisionMesh out;
  out.vertices.reserve(joined.distinct.size());
  for (std::uint32_t original : joined.distinct) out.vertices.push_back(all[original]);
  out.bounds = bounds_of(out.vertices);

  std::unordered_set<std::uint64_t> seen_lines;
  std::uint32_t base = 0;
  out.triangles.reserve(mesh.triangle_count());
  for (const Submesh& s : mesh.submeshes) {
    for (std::size_t t = 0; t + 2 < s.triangles.size(); t += 3) {
      const std::uint32_t a = joined.welded[base + s.triangles[t]], b = joined.welded[base + s.triangles[t + 1]],
                          c = joined.welded[base + s.triangles[t + 2]];
      if (a != b && b != c && a != c) out.triangles.push_back({a, b, c});
    }
    for (const auto& line : s.lines) {
      const std::uint32_t a = joined.welded[base + line[0]], b = joined.welded[base + line[1]];
      const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
      if (a != b && seen_lines.insert(key).second) out.lines.push_back({a, b});
    }
    base += static_cast<std::uint32_t>(s.vertex_count());
  }
  if (out_weld != nullptr) *out_weld = std::move(joined);
  return out;
}

}  // namespace ambf::mesh
