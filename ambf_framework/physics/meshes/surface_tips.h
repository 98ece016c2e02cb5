// Places of a shape that may meet a face between its corners: corners, tips, and places along edges. What tissue asks.
// Private to physics/. Physics thread; nothing here allocates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

// A ball that is within the shape and reaches its surface.
struct SurfaceTip {
  btVector3 at;              // m, in the shape's frame
  double radius = 0.0;       // m; 0: a corner
  std::uint64_t number = 0;  // of the place: always the same in one shape, for one spacing; below 2^40
};

struct TipSearch {
  btVector3 low, high;  // m, the box that matters, in the shape's frame
  double spacing;       // m, of places along edges
  double blunt;         // m: what is rounder has no tip
};

// Those of a shape that is no compound, up to the capacity of `found`, to which they are added; false: there are more.
// `edges`: of a convex hull (ShapeData).
bool find_tips(const btCollisionShape& shape, const std::vector<std::array<btVector3, 2>>& edges,
               const TipSearch& search, std::vector<SurfaceTip>& found);

}  // namespace ambf::physics::detail
