// Private to mesh/: numbers equal positions once, in order of appearance (open addressing; 0 and -0 are equal). Used
// where a format repeats positions, so that a mesh in memory is smaller than its file. The hash is seeded at random, so
// that no file can be made to collide on purpose; the numbers given do not depend on it.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "mesh/detail/hash_seed.h"

namespace ambf::mesh {

class PositionTable {
 public:
  explicit PositionTable(std::size_t expected) { resize(expected); }

  // Index of xyz in `positions` (xyz triples), appended there when new. Finite numbers only.
  std::uint32_t index_of(const float* xyz, std::vector<float>& positions) {
    const float p[3] = {xyz[0] + 0.0F, xyz[1] + 0.0F, xyz[2] + 0.0F};  // -0 becomes 0
    if (2 * (positions.size() / 3) >= slots_.size()) rebuild(positions);
    for (std::size_t slot = hash(p) & mask_;; slot = (slot + 1) & mask_) {
      const std::uint32_t index = slots_[slot];
      if (index == kEmpty) {
        const auto added = static_cast<std::uint32_t>(positions.size() / 3);
        slots_[slot] = added;
        positions.insert(positions.end(), p, p + 3);
        return added;
      }
      const float* q = positions.data() + std::size_t{3} * index;
      if (q[0] == p[0] && q[1] == p[1] && q[2] == p[2]) return index;
    }
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFFU;

  std::size_t hash(const float p[3]) const {
    std::uint64_t h = seed_ ^ std::bit_cast<std::uint32_t>(p[0]);
    h = (h ^ (h >> 15)) * 0x9E3779B97F4A7C15ULL + std::bit_cast<std::uint32_t>(p[1]);
    h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ULL + std::bit_cast<std::uint32_t>(p[2]);
    h = (h ^ (h >> 32)) * 0x94D049BB133111EBULL;
    return static_cast<std::size_t>(h ^ (h >> 31));
  }
  void resize(std::size_t expected) {
    std::size_t size = 64;
    while (size < 2 * expected + 2) size *= 2;
    slots_.assign(size, kEmpty);
    mask_ = size - 1;
  }
  void rebuild(const std::vector<float>& positions) {
    const std::size_t count = positions.size() / 3;
    resize(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t slot = hash(positions.data() + 3 * i) & mask_;
      while (slots_[slot] != kEmpty) slot = (slot + 1) & mask_;
      slots_[slot] = static_cast<std::uint32_t>(i);
    }
  }

  const std::uint64_t seed_ = hash_seed();
  std::vector<std::uint32_t> slots_;
  std::size_t mask_ = 0;
};

}  // namespace ambf::mesh
