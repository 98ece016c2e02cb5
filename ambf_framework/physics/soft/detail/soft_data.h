// What a SoftBody is made of. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <memory>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/soft/detail/ray_faces.h"
#include "physics/soft_body.h"
#include "physics/soft_grip.h"

namespace ambf::physics::detail {

struct BodyData;
struct SoftGripData;

// The spring of a held node in the step that is being made (held_nodes.cpp). World axes.
struct HeldSpring {
  btSoftBody::Node* node;
  BodyData* holder;  // null: held in the world
  HeldNode* held;
  btVector3 place, lever;  // m, from the holder's COM: where it is held, and where the node is; else from the origin
  double max_force;        // N
  double stiffness;        // N/m, damping included
  btVector3 from_damping;  // N, of the gap as the step began
  btMatrix3x3 share;       // of what is missing of the force, that a pass adds
  btVector3 force{0, 0, 0};
};

struct SoftData : RayFaces {
  SoftData(const SoftDefinition& given, const SoftBody& owner);

  const SoftBody* owner;

  std::vector<btVector3> rest;  // m, body frame
  // As given: Bullet shuffles its own where constraints are randomized.
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::uint32_t> fixed;
  std::vector<int> collision_groups;
  btTransform T_world_loaded;
  double mass_of_node;  // kg, before nodes were fixed
  btVector3 rest_centre{0, 0, 0};
  btSoftBodyWorldInfo surroundings;  // of this body alone
  std::unique_ptr<btSoftBody> soft;
  bool frozen = false;
  bool carried = false;  // in the next step
  btTransform carried_to;
  double max_carried_speed = 0.0;         // m/s
  std::vector<btVector3> last_good;       // positions before the last step
  btVector3 low{0, 0, 0}, high{0, 0, 0};  // around all nodes of this step, margin included

  void find_bounds();

  std::vector<SoftGripData*> grips;  // that hold nodes, in the order in which they began to
  std::vector<HeldSpring> springs;   // of the step that is being made

  bool meets_bodies_by_nodes() const;
  bool meets_bodies_by_clusters() const;
  void forget_contacts();  // they name bodies, which may be gone before the next step
  void begin_step(double h, const btVector3& gravity);
  void restart();  // as if new, but for the nodes' positions and velocities
};

}  // namespace ambf::physics::detail
