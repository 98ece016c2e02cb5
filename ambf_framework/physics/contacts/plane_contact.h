// Contacts of convex shapes with a plane, all corners at once. Bullet finds one point a step and lets the rest
// collect, so that cans and boxes stand on two points for a while, tip and fall back for ever; with all points known
// from the first step they stand still, which sleeping needs. Private to physics/. Physics thread.
#pragma once

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

class PlaneContactAlgorithm final : public btCollisionAlgorithm {
 public:
  PlaneContactAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& convex,
                        const btCollisionObjectWrapper& plane, bool swapped);
  ~PlaneContactAlgorithm() override;

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo&,
                        btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1.0;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (manifold_ && owned_) manifolds.push_back(manifold_);
  }

  struct CreateFunc final : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* a,
                                                   const btCollisionObjectWrapper* b) override {
      void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(PlaneContactAlgorithm));
      if (m_swapped) return new (memory) PlaneContactAlgorithm(info, *b, *a, true);
      return new (memory) PlaneContactAlgorithm(info, *a, *b, false);
    }
  };

 private:
  btPersistentManifold* manifold_;
  bool owned_ = false, swapped_;
};

// Lets a dispatcher use it for every convex shape.
class PlaneContactRegistration {
 public:
  explicit PlaneContactRegistration(btCollisionDispatcher& dispatcher);

 private:
  PlaneContactAlgorithm::CreateFunc straight_, swapped_;
};

}  // namespace ambf::physics::detail
