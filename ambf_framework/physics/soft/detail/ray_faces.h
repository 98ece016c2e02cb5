// What rays need of a soft body of any sort (face_rays.cpp). Private to physics/soft/. Physics thread.
#pragma once

#include <cstdint>
#include <vector>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct RayFaces {
  std::uint64_t moves = 0;                          // how often nodes went elsewhere
  std::uint64_t bounded = ~std::uint64_t{0};        // the count of moves that the box below is of
  btVector3 node_low{0, 0, 0}, node_high{0, 0, 0};  // around all nodes
  std::vector<std::uint32_t> near_faces;            // of the bundle that is being cast
};

}  // namespace ambf::physics::detail
