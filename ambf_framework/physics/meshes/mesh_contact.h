// Contacts of moving triangle meshes with each other, with static ones, boxes and other convex shapes, found by SurfaceContacts instead of
// Bullet's GImpact, which runs a whole collision algorithm for each pair of triangles: milliseconds a step for a robot in a floor,
// seconds for two robots at one place. Half-spaces stay with GImpact, which is good at them. Private to physics/. Physics thread.
#pragma once

#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>

#include <array>
#include <optional>

#include "physics/detail/bullet.h"
#include "physics/meshes/surface_contacts.h"

namespace ambf::physics::detail {

// A: the moving mesh (of two: the first). B: what it touches.
class MeshContactAlgorithm final : public btCollisionAlgorithm {
 public:
  MeshContactAlgorithm(const btCollisionAlgorithmConstructionInfo& info, SurfaceContacts& contacts, bool swapped)
      : btCollisionAlgorithm(info), contacts_(contacts), ticket_(contacts.turns().first_ticket()), swapped_(swapped) {}
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
  static constexpr int kMostPoints = SurfaceContacts::kMostGroups * SurfaceContacts::kMostInGroup;
  struct Known;

  void find(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other, const btTransform& T_b_a,
            double reach, const Known& known);

  SurfaceContacts& contacts_;
  std::array<btPersistentManifold*, SurfaceContacts::kMostGroups> manifolds_{};  // made when needed first
  std::size_t cost_ = 0;                                                         // of looking at it, the last time
  btQuaternion q_world_b_ = btQuaternion::getIdentity();                         // the last time
  std::uint64_t ticket_;                                                         // in the queue of those who take turns
  bool swapped_;
  bool fine_ = false;  // the last time there were too many triangles
};
// The pool of algorithms has pieces of the size of Bullet's own.
static_assert(sizeof(MeshContactAlgorithm) <= sizeof(btConvexConvexAlgorithm));

// Lets a dispatcher use it for everything that moving meshes meet, but half-spaces.
class MeshContactRegistration {
 public:
  // `preparation_thread`: needed for set_real_time(true) to have an effect (World::set_real_time).
  MeshContactRegistration(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration,
                          bool preparation_thread);
  SurfaceContacts& contacts() { return contacts_; }
  void set_real_time(bool real_time) { contacts_.prepare_by(real_time && preparation_ ? &*preparation_ : nullptr); }

 private:
  std::optional<SurfacePreparation> preparation_;
  SurfaceContacts contacts_;
  MeshContactAlgorithm::CreateFunc straight_{contacts_}, swapped_{contacts_};
};

}  // namespace ambf::physics::detail
