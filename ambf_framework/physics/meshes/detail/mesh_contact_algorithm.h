// Bullet's face of this room: the contacts of one pair of collision objects, found by SurfaceContacts instead of
// Bullet's GImpact, which runs a whole collision algorithm for each pair of triangles: milliseconds a step for a
// robot in a floor, seconds for two robots at one place. Private to physics/meshes/. Physics thread.
#pragma once

#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>

#include <array>

#include "physics/detail/bullet.h"
#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/surface_contacts.h"

namespace ambf::physics::detail {

// A: the moving mesh (of two: the first). B: what it touches.
class MeshContactAlgorithm final : public btCollisionAlgorithm {
 public:
  MeshContactAlgorithm(const btCollisionAlgorithmConstructionInfo& info, SurfaceContacts& contacts, bool swapped)
      : btCollisionAlgorithm(info), contacts_(contacts), ticket_(contacts.budget().first_ticket()), swapped_(swapped) {}
  ~MeshContactAlgorithm() override;

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo&,
                        btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1.0;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override;

  struct CreateFunc final : btCollisionAlgorithmCreateFunc {
    explicit CreateFunc(SurfaceContacts& found) : contacts(found) {}
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper*,
                                                   const btCollisionObjectWrapper*) override {
      void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(MeshContactAlgorithm));
      return new (memory) MeshContactAlgorithm(info, contacts, m_swapped);
    }
    SurfaceContacts& contacts;
  };

 private:
  static constexpr int kMaxPoints = kMaxGroups * kMaxGroupSize;
  struct Known;

  void find(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other, const btTransform& T_b_a,
            double reach, const Known& known);

  SurfaceContacts& contacts_;
  std::array<btPersistentManifold*, kMaxGroups> manifolds_{};  // each made when first needed
  // Of the last update:
  std::size_t cost_ = 0;
  btQuaternion q_world_b_ = btQuaternion::getIdentity();
  std::uint64_t ticket_;  // place in the queue of the budget
  bool swapped_;
  bool fine_ = false;  // there were too many triangles
};
// Bullet's pool of algorithms has slots of the size of its own largest one.
static_assert(sizeof(MeshContactAlgorithm) <= sizeof(btConvexConvexAlgorithm));

}  // namespace ambf::physics::detail
