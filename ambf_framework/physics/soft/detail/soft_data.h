// What a SoftBody is made of. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <memory>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/soft_body.h"

namespace ambf::physics::detail {

struct SoftData {
  explicit SoftData(const SoftDefinition& given);

  std::vector<btVector3> rest;  // m, body frame
  std::vector<std::uint32_t> fixed;
  std::vector<int> collision_groups;
  btTransform T_world_loaded;
  double mass_of_node;  // kg, before nodes were fixed
  btVector3 rest_centre{0, 0, 0};
  btSoftBodyWorldInfo surroundings;  // of this body alone
  std::unique_ptr<btSoftBody> soft;
  bool frozen = false;
  std::uint32_t user_index = 0;
  bool carried = false;  // in the next step
  btTransform carried_to;
  double max_carried_speed = 0.0;         // m/s
  std::vector<btVector3> last_good;       // positions before the last step
  btVector3 low{0, 0, 0}, high{0, 0, 0};  // around all nodes of this step, margin included

  bool meets_bodies_by_nodes() const;
  bool meets_bodies_by_clusters() const;
  void forget_contacts();  // they name bodies, which may be gone before the next step
  void begin_step(double h, const btVector3& gravity);
  void restart();  // as if new, but for the nodes' positions and velocities
};

}  // namespace ambf::physics::detail
