// Bullet's discrete dynamics world with a step of our own: exactly one fixed step, phases that can be timed, tight
// bounding boxes, no motion states, and sleeping by displacement instead of speed. Private to
// physics/. Physics thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "physics/contacts/crowd_limit.h"
#include "physics/contacts/swept_motion.h"
#include "physics/detail/body_data.h"
#include "physics/joints/joint_data.h"
#include "physics/meshes/mesh_contacts.h"

namespace ambf::physics::detail {

// Seconds spent in the phases of the sampled steps.
struct PhaseSums {
  double collision = 0.0, solver = 0.0, integration = 0.0;
  int steps = 0;
};

// Lets pairs into the broadphase only where neither joints nor groups nor sets forbid contact, so that forbidden
// pairs cost nothing in a step.
struct PairFilter final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
};

class DynamicsWorld final : public btDiscreteDynamicsWorld {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();
  DynamicsWorld(btCollisionDispatcher& dispatcher, btBroadphaseInterface& broadphase, btConstraintSolver& solver,
                btCollisionConfiguration& configuration, MeshContacts& mesh_contacts, bool own_motion)
      : btDiscreteDynamicsWorld(&dispatcher, &broadphase, &solver, &configuration),
        mesh_contacts_(mesh_contacts),
        own_motion_(own_motion) {}

  // Bodies move as free_motion.h has it, not as Bullet does.
  bool own_motion() const { return own_motion_; }
  // Before the rows of joints are made, where motion is our own.
  void begin_motion(double h);

  // One step without forces cleared, in two calls: its velocities, and the motion. Null: phases are not measured.
  void solve(double h, PhaseSums* times);
  void move(double h, bool sleeping, PhaseSums* times);
  void clear_applied_forces();

  // The bounding box follows the body's pose at once; new pairs are found.
  void refresh_bounds(BodyData& body);
  // Pairs of this body are judged anew by the filter.
  void refilter(BodyData& body);
  // These two no longer touch; all other contacts of both stay.
  void part(BodyData& a, BodyData& b);
  // Finds the pairs of this body that the filter admits and that are not there.
  void find_pairs(BodyData& body);
  // Calls `visit(BodyData&)` for every body whose bounding box overlaps this one's (the tree's pairs are those of
  // fattened boxes).
  template <class Visit>
  void visit_neighbours(const BodyData& body, Visit&& visit) {
    btOverlappingPairCache& cache = *getPairCache();
    for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
      const btBroadphasePair& pair = cache.getOverlappingPairArrayPtr()[i];
      if (!TestAabbAgainstAabb2(pair.m_pProxy0->m_aabbMin, pair.m_pProxy0->m_aabbMax, pair.m_pProxy1->m_aabbMin,
                                pair.m_pProxy1->m_aabbMax)) {
        continue;
      }
      auto& a = data_of(*static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject));
      auto& b = data_of(*static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject));
      if (&a == &body) visit(b);
      if (&b == &body) visit(a);
    }
  }

  int awake_count() const { return awake_count_; }
  const CrowdLimit& crowd_limit() const { return crowd_limit_; }
  void forget(const BodyData& body) { crowd_limit_.forget(body); }  // it leaves the world
  void count_awake();
  // As in a new world: nothing was measured, nothing waits.
  void restart_memory() {
    sleep_phase_ = 0;
    postponed_.clear();
  }
  btAlignedObjectArray<btRigidBody*>& moving_bodies() { return m_nonStaticRigidBodies; }

 private:
  void apply_gravity();
  void detect_collisions();
  void collide_pairs();
  void refresh_contacts(btCollisionAlgorithm& algorithm);
  void limit_rolling_friction();
  void integrate(double h);
  void update_sleeping(double h, bool sleeping);
  void updateAabbs() override;
  void calculateSimulationIslands() override;

  // Names a pair whatever its place in Bullet's cache.
  static std::uint64_t key_of(const btBroadphasePair& pair) {
    const auto a = static_cast<std::uint32_t>(pair.m_pProxy0->m_uniqueId);
    const auto b = static_cast<std::uint32_t>(pair.m_pProxy1->m_uniqueId);
    return std::uint64_t{a} << 32 | b;
  }
  bool was_postponed(const btBroadphasePair& pair) const {
    return !postponed_before_.empty() &&
           std::binary_search(postponed_before_.begin(), postponed_before_.end(), key_of(pair));
  }

  MeshContacts& mesh_contacts_;
  const bool own_motion_;
  CrowdLimit crowd_limit_;
  SweptMotion swept_motion_;
  std::vector<std::uint64_t> postponed_,
      postponed_before_;  // pairs whose meshes wait, now and before this step (sorted)
  int awake_count_ = 0;
  btManifoldArray manifolds_;  // of one pair
  int sleep_phase_ = 0;        // steps since displacements were last looked at
  friend struct WorldData;
};

}  // namespace ambf::physics::detail
