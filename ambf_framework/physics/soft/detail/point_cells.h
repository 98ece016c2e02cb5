// Points sorted by cells, and those of them that may be within a box. Private to physics/soft/. Physics thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

inline int cell_of(double value, double size) {
  constexpr double kFar = 1e9;
  const double cell = std::floor(value / size);
  return cell > -kFar && cell < kFar ? static_cast<int>(cell) : 0;  // what is not finite has diverged
}

// Slots of a row of cells along x follow each other. `slots`: a power of two.
inline std::size_t slot_of(int x, int y, int z, std::size_t slots) {
  const auto part = [](int value, std::uint32_t prime) { return static_cast<std::uint32_t>(value) * prime; };
  return ((part(y, 19349663U) ^ part(z, 83492791U)) + part(x, 1U)) & (slots - 1);
}

// The points of slots that follow each other lie one after the other.
struct PointCells {
  struct Sorted {
    math::Vec3 at;
    std::uint32_t point;
  };
  double size = 1.0;                 // m, of a cell
  std::vector<std::uint32_t> first;  // of each slot in `sorted`, and the end
  std::vector<Sorted> sorted;

  void make_room(std::size_t points) {
    std::size_t slots = 64;
    while (slots < 2 * points) slots *= 2;
    first.resize(slots + 1);
    sorted.resize(points);
  }
  std::uint32_t count() const { return first.back(); }

  // Of those of `at` for which `counts(i)` is true.
  template <class Counts>
  void sort(const std::vector<btVector3>& at, double cell, const Counts& counts) {
    size = cell;
    const std::size_t slots = first.size() - 1;
    const auto slot = [&](const btVector3& p) {
      return slot_of(cell_of(p.x(), size), cell_of(p.y(), size), cell_of(p.z(), size), slots);
    };
    // Counting sort: how many, then where each slot ends, then from the last point on.
    std::fill(first.begin(), first.end(), 0U);
    for (std::uint32_t i = 0; i < at.size(); ++i)
      if (counts(i)) ++first[slot(at[i])];
    for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
    for (auto i = static_cast<std::uint32_t>(at.size()); i-- > 0;)
      if (counts(i)) sorted[--first[slot(at[i])]] = {from_bullet(at[i]), i};
  }

  // All points in the box, and some others.
  template <class Look>
  void each_near(const btVector3& from, const btVector3& to, const Look& look) const {
    if (!(from.x() <= to.x() && from.y() <= to.y() && from.z() <= to.z())) return;
    const std::size_t slots = first.size() - 1;
    const int x0 = cell_of(from.x(), size), x1 = cell_of(to.x(), size), y0 = cell_of(from.y(), size),
              y1 = cell_of(to.y(), size), z0 = cell_of(from.z(), size), z1 = cell_of(to.z(), size);
    // A box that is very large: all of them.
    if (static_cast<double>(x1 - x0 + 1) * (y1 - y0 + 1) * (z1 - z0 + 1) > static_cast<double>(count())) {
      for (std::uint32_t k = 0; k < count(); ++k) look(sorted[k]);
      return;
    }
    for (int z = z0; z <= z1; ++z)
      for (int y = y0; y <= y1; ++y) {
        const std::size_t begin = slot_of(x0, y, z, slots), end = begin + static_cast<std::size_t>(x1 - x0) + 1;
        for (std::uint32_t k = first[begin]; k < first[std::min(end, slots)]; ++k) look(sorted[k]);
        // A row that goes on at the first slot.
        for (std::uint32_t k = 0; end > slots && k < first[end - slots]; ++k) look(sorted[k]);
      }
  }
};

}  // namespace ambf::physics::detail
