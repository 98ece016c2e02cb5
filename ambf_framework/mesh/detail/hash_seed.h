// Private to mesh/: one random number per process that all our hash tables start from, so that no file can be made to
// collide on purpose. What they number or find never depends on it.
#pragma once

#include <cstdint>
#include <random>

namespace ambf::mesh {

inline std::uint64_t hash_seed() {
  static const std::uint64_t seed = [] {
    std::random_device device;
    return (std::uint64_t{device()} << 32) ^ device();
  }();
  return seed;
}

}  // namespace ambf::mesh
