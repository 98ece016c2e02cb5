// How near two bodies are to each other as they stand, from their collision shapes alone. Unlike contacts of a step
// this makes, keeps and wakes nothing, knows no joints, and serves static bodies and bodies outside any world too.
// Convex parts are compared by GJK and EPA, so depths are those of the deepest pair of parts. Triangle meshes are
// surfaces: a body wholly inside one touches nothing. Distances include collision margins. Physics thread.
#pragma once

#include <optional>

#include "math/types.h"
#include "physics/body.h"

namespace ambf::physics {

// The nearest points of two bodies, or the deepest of overlapping ones.
struct Proximity {
  math::Vec3 point_on_a, point_on_b;  // world, m
  math::Vec3 normal_on_b;             // world, unit, from b towards a
  double distance = 0.0;              // m, negative: depth
};

// False: they are farther apart than `max_distance` (m). A comparison of spheres around them.
bool within_reach(const Body& a, const Body& b, double max_distance);
// Nothing beyond `max_distance` (m, >= 0), and of two planes.
std::optional<Proximity> proximity(const Body& a, const Body& b, double max_distance);
// Whether their shapes overlap. Ends at the first parts that do, and computes no depths.
bool overlap(const Body& a, const Body& b);

// Whether their collision groups let them meet: one has none, or they share one.
bool groups_meet(const Body& a, const Body& b);
// Whether groups, sets and joints between them let them meet. Two static bodies may.
bool may_meet(const Body& a, const Body& b);

}  // namespace ambf::physics
