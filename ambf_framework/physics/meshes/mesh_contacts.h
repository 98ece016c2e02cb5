// Contacts of moving triangle meshes with each other, with static meshes, boxes and other convex shapes; half-spaces
// stay with Bullet. This is the only header of the room that the rest of physics/ includes: docs/mesh_contacts.md has
// the theory, detail/constants.h the numbers. Surfaces: any thread. MeshContacts: physics thread. Knows Bullet's
// shapes and objects, no bodies.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct FeatureMesh;
using SharedSurface = std::shared_ptr<const FeatureMesh>;

// The surface of a mesh, in the frame of the centre of mass (m), or of a solid box. Never on the physics thread.
// `margin`: how far outside the triangles the surface is.
SharedSurface make_mesh_surface(const std::vector<math::Vec3>& vertices,
                                const std::vector<std::array<int, 3>>& triangles, double margin, bool moving);
SharedSurface make_box_surface(const btVector3& half_extents);
// Moving meshes meet the shape by this surface from now on. The surface must outlive the shape.
void attach_surface(btCollisionShape& shape, const FeatureMesh& surface);

// Where a ray first meets the triangles of a shape's surface, from either side, before `fraction` of `along` (without
// the margin). The shape needs an attached surface. Physics thread.
struct SurfaceHit {
  double fraction;
  int triangle;      // of the surface; -1: nothing is met
  btVector3 normal;  // unit, outward
};
SurfaceHit cast_at_surface(const btCollisionShape& shape, const btVector3& start, const btVector3& along,
                           double fraction);

class MeshContacts {
 public:
  // Registers itself with the dispatcher, which it must outlive; both live as long as `configuration`. Each mesh and
  // box shape needs an attached surface. `preparation_thread`: see World::set_real_time.
  MeshContacts(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration, bool preparation_thread);
  ~MeshContacts();
  MeshContacts(const MeshContacts&) = delete;
  MeshContacts& operator=(const MeshContacts&) = delete;

  void set_real_time(bool real_time);
  void begin_step();
  // Whether contacts were put off to a later step since the last call: their pair must be processed then even if
  // nothing moves.
  bool take_postponed();
  std::uint64_t overloaded_steps() const;  // in which pairs waited for more than four steps
  void restart();                          // as if new; overloaded steps stay counted

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::physics::detail
