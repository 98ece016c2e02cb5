// Closed surfaces for tests of tissue: a ball, one like a liver, and both with a wound of 3 mm.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "tests/physics/fixtures.h"
#include "tests/physics/tissue_block.h"

namespace ambf::physics::testing {

// Of rings between two poles; each direction has its radius, m.
template <std::uint32_t kRings = 11, std::uint32_t kAround = 20, class Radius>
TissueSurface closed(const Radius& radius) {
  TissueSurface made;
  const auto add = [&](double polar, double angle) {
    const math::Vec3 out{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
    made.vertices.push_back(math::scaled(out, radius(out)));
  };
  add(0.0, 0.0);
  for (std::uint32_t i = 1; i <= kRings; ++i)
    for (std::uint32_t j = 0; j < kAround; ++j) add(kPi * i / (kRings + 1), 2.0 * kPi * j / kAround);
  add(kPi, 0.0);
  const auto last = static_cast<std::uint32_t>(made.vertices.size() - 1);
  const auto at = [](std::uint32_t ring, std::uint32_t j) { return 1 + ring * kAround + j % kAround; };
  for (std::uint32_t j = 0; j < kAround; ++j) {
    made.triangles.push_back({0, at(0, j), at(0, j + 1)});
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
      made.triangles.push_back({at(ring, j), at(ring + 1, j), at(ring, j + 1)});
      made.triangles.push_back({at(ring, j + 1), at(ring + 1, j), at(ring + 1, j + 1)});
    }
    made.triangles.push_back({last, at(kRings - 1, j + 1), at(kRings - 1, j)});
  }
  return made;
}

inline TissueSurface ball() {
  return closed([](const math::Vec3&) { return math::Vec3{0.02, 0.02, 0.02}; });
}
// m, half of it along each axis, by the direction from its middle: a thick right lobe, a thin left one, a dent below.
inline math::Vec3 liver_radius(const math::Vec3& out) {
  const double thick = 0.012 - 0.005 * out.x - 0.003 * std::max(0.0, -out.z) * (1.0 - out.x * out.x);
  return {0.03, 0.018 - 0.004 * out.x, thick};
}
inline TissueSurface liver() { return closed(liver_radius); }

// What is `inside` on either side of a wound of 3 mm across x, whose top is at z = 0.
template <class Inside>
std::array<TissueSurface, 2> lips_of(const Inside& inside, double top) {
  std::array<TissueSurface, 2> made;
  for (const double side : {-1.0, 1.0}) {
    const math::Vec3 middle{0.009 * side, 0, 0};
    const auto is_in = [&](const math::Vec3& at) { return side * at.x > 0.0015 && inside(at); };
    TissueSurface& lip = made[side < 0.0 ? 0 : 1];
    lip = closed<19, 36>([&](const math::Vec3& out) {
      double low = 0.0, high = 0.1;
      for (int i = 0; i < 50; ++i) (is_in(middle + out * (0.5 * (low + high))) ? low : high) = 0.5 * (low + high);
      return math::Vec3{low, low, low};
    });
    for (math::Vec3& vertex : lip.vertices) vertex += middle - math::Vec3{0, 0, top};
  }
  return made;
}
inline std::array<TissueSurface, 2> ball_lips() {
  return lips_of([](const math::Vec3& at) { return math::norm(at) < 0.02; }, 0.02);
}
inline std::array<TissueSurface, 2> liver_lips() {
  return lips_of(
      [](const math::Vec3& at) {
        // Along a way the same direction, but for the scale of each axis: near enough a liver.
        const math::Vec3 half = liver_radius(at / std::max(math::norm(at), 1e-9));
        return std::hypot(at.x / half.x, at.y / half.y, at.z / half.z) < 1.0;
      },
      0.012);
}

}  // namespace ambf::physics::testing
