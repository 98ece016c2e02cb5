// Bundles of rays that are cast again and again, as sensors do: one search of the broadphase for all rays, then each
// ray against what is within its reach. Surfaces are met exactly (1e-9 of the ray's length): primitives by formula,
// hulls by faces, meshes and soft bodies by triangles, without margins. Allocates nothing. Physics thread.
#pragma once

#include <cstdint>
#include <span>

#include "physics/world.h"

namespace ambf::physics {

class SoftBody;  // physics/soft_body.h

// From `start` towards `end`, in the frame of the bundle, m.
struct Ray {
  math::Vec3 start, end;
};

struct BundleFilter {
  const Body* ignored = nullptr;  // what the rays start from; may be null
  // Leaves out, too, what `ignored` never collides with.
  bool as_it_collides = false;
  // As if `ignored` had a shape, where it has none and so collides with nothing.
  bool as_if_solid = false;
  // A ray that starts inside a solid hits it at once (fraction 0, normal against the ray). Else it sees nothing of that
  // convex part.
  bool from_inside = false;
  bool soft_bodies = false;  // faces of soft bodies are met, too
};

// What one ray of a bundle meets: a body, or a face of a soft body.
struct BundleHit : RayHit {
  const SoftBody* soft = nullptr;  // then `triangle` is the face (SoftBody::faces()), and `body` is null

  bool any() const { return body != nullptr || soft != nullptr; }
};

class RayBundle {
 public:
  // `hits` has one entry a ray; body and soft null and fraction 1: nothing hit. The normal is unit, world, against the
  // ray; `triangle` counts those of the collision surface. Casts at most `limit` rays (0: all), in turns, and none once
  // all were cast and neither the bundle nor anything within its reach has moved since. Returns how many were cast.
  std::size_t cast(const World& world, const math::Pose& T_world_bundle, std::span<const Ray> rays,
                   const BundleFilter& filter, std::span<BundleHit> hits, std::size_t limit = 0);
  // The next cast() casts all rays, whatever the limit: bodies came or went, or were put elsewhere by a restore.
  void forget() { *this = {}; }

 private:
  bool known_ = false;      // all of the below
  std::uint64_t seen_ = 0;  // of poses within reach, and of the bundle's, at the last cast
  std::size_t stale_ = 0;   // rays that were not cast since something moved
  std::size_t next_ = 0;    // the first of them, counted around
};

}  // namespace ambf::physics
