// Private to mesh/: the hash grid behind weld(), for points that lie in memory in whatever way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/detail/hash_seed.h"
#include "mesh/weld.h"

namespace ambf::mesh {

// Cells as wide as the sphere around a vertex: it meets two of them along each axis, and each holds few distinct
// vertices even where a file packs them as densely as they can stay distinct.
constexpr double kWeldCellInEpsilons = 2.0;
constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

class WeldGrid {
 public:
  WeldGrid(std::size_t vertices, double cell) : inverse_cell_(1.0 / cell) {
    std::size_t size = 64;
    while (size < 2 * vertices) size *= 2;
    mask_ = size - 1;
    heads_.assign(size, kNothing);
  }

  std::int64_t cell_of(double value, double low) const {
    return static_cast<std::int64_t>(std::floor((value - low) * inverse_cell_));
  }

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
  // At random, so that no file can be made to collide on purpose; results do not depend on it.
  std::uint64_t seed_ = hash_seed();
  std::size_t mask_ = 0;
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
};

template <typename PointAt>
Weld weld_points(std::size_t count, const PointAt& point, double epsilon) {
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
  const double cell = std::max(kWeldCellInEpsilons * epsilon, largest * 0x1p-50);
  WeldGrid grid(count, cell);

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

}  // namespace ambf::mesh
