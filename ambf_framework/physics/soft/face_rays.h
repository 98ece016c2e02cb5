// Rays against faces of soft bodies, for bundles (rays/ray_bundle.cpp). Private to physics/. Physics thread; nothing
// here allocates once every face was near a bundle.
#pragma once

#include <cstdint>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/soft_body.h"

namespace ambf::physics::detail {

// Notes which faces of each body may be met within a box, and returns a number that differs, in all likelihood, once
// any body there has moved; 0 where none is.
std::uint64_t find_faces(const std::vector<SoftBody*>& bodies, const btVector3& low, const btVector3& high);

struct FaceHit {
  const SoftBody* body = nullptr;  // null: nothing is met
  int face = -1;
  double fraction = 1.0;
  btVector3 normal{0, 0, 0};  // unit, against the ray
};
// The first of the noted faces that a ray meets at less than `nearer`, from either side, exactly and without margins.
// Of faces at one place, the first body's first.
FaceHit cast_at_faces(const std::vector<SoftBody*>& bodies, const btVector3& start, const btVector3& along,
                      double nearer);

}  // namespace ambf::physics::detail
