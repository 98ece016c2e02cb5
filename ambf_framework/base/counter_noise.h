// Noise that repeats: a function of who draws and when, so that runs, snapshots and threads need no state of a random
// generator. Pure; any thread. C++17.
#pragma once

#include <cmath>
#include <cstdint>

namespace ambf::base {

// SplitMix64's finaliser (Steele, Lea, Flood 2014): every bit of the result depends on every bit of the argument.
inline std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15ULL;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  return bits ^ (bits >> 31);
}

// Normally distributed with mean 0 and deviation 1 (Box-Muller), the same for the same arguments.
inline double normal_noise(std::uint64_t seed, std::uint64_t counter, std::uint64_t index) {
  constexpr double kPi = 3.14159265358979323846;
  const std::uint64_t first = mixed(mixed(mixed(seed) ^ counter) ^ index), second = mixed(first);
  const auto unit = [](std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53; };  // 0 .. 1
  return std::sqrt(-2.0 * std::log(unit(first))) * std::cos(2.0 * kPi * unit(second));
}

}  // namespace ambf::base
