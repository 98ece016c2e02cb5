#include "physics/detail/dynamics_world.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "physics/contacts/pair_reach.h"
#include "physics/detail/free_motion.h"

namespace ambf::physics::detail {

namespace {

// A body that stayed within kRestDistance for kRestTime may sleep: it moves by less than 0.1 mm in ten seconds.
constexpr double kRestDistance = 8e-6;  // m
constexpr double kRestTime = 1.0;       // s
constexpr int kRestInterval = 16;       // steps between looks

double seconds_since(std::chrono::steady_clock::time_point& mark) {
  const auto now = std::chrono::steady_clock::now();
  const double elapsed = std::chrono::duration<double>(now - mark).count();
  mark = now;
  return elapsed;
}

}  // namespace

bool PairFilter::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  return may_collide(data_of(*static_cast<btCollisionObject*>(a->m_clientObject)),
                     data_of(*static_cast<btCollisionObject*>(b->m_clientObject)));
}

void DynamicsWorld::solve(double h, PhaseSums* times) {
  auto mark = times ? std::chrono::steady_clock::now() : std::chrono::steady_clock::time_point{};
  m_dispatchInfo.m_timeStep = h;
  m_dispatchInfo.m_stepCount = 0;
  m_solverInfo.m_timeStep = h;
  apply_gravity();
  if (times) times->integration += seconds_since(mark);
  detect_collisions();
  if (times) times->collision += seconds_since(mark);
  calculateSimulationIslands();
  solveConstraints(m_solverInfo);
  if (times) times->solver += seconds_since(mark);
}

void DynamicsWorld::move(double h, bool sleeping, PhaseSums* times) {
  auto mark = times ? std::chrono::steady_clock::now() : std::chrono::steady_clock::time_point{};
  integrate(h);
  update_sleeping(h, sleeping);
  if (times) {
    times->integration += seconds_since(mark);
    ++times->steps;
  }
}

void DynamicsWorld::begin_motion(double h) {
  std::array<BodyData*, kTurnsAtOnce> bodies{};
  std::size_t count = 0;
  for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) {
    BodyData& body = data_of(*m_nonStaticRigidBodies[i]);
    body.begun = body.rigid.isActive();
    if (!body.begun) continue;
    bodies[count++] = &body;
    if (count < bodies.size()) continue;
    detail::begin_motion(bodies, h);
    count = 0;
  }
  detail::begin_motion(std::span(bodies).first(count), h);
}

void DynamicsWorld::apply_gravity() {
  for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) {
    btRigidBody& rigid = *m_nonStaticRigidBodies[i];
    if (!rigid.isActive()) continue;
    rigid.applyGravity();
    if (own_motion_) continue;
    const BodyData& body = data_of(rigid);
    rigid.setLinearVelocity(rigid.getLinearVelocity() * body.linear_retained);
    rigid.setAngularVelocity(rigid.getAngularVelocity() * body.angular_retained);
  }
}

void DynamicsWorld::detect_collisions() {
  updateAabbs();
  m_broadphasePairCache->calculateOverlappingPairs(m_dispatcher1);
  mesh_contacts_.begin_step();
  collide_pairs();
  limit_rolling_friction();
}

void DynamicsWorld::refresh_bounds(BodyData& body) {
  btVector3 low, high;
  body.rigid.getAabb(low, high);
  const btVector3 margin(body.contact_margin, body.contact_margin, body.contact_margin);
  m_broadphasePairCache->setAabb(body.rigid.getBroadphaseHandle(), low - margin, high + margin, m_dispatcher1);
}

void DynamicsWorld::updateAabbs() {
  for (int i = 0; i < m_collisionObjects.size(); ++i) {
    BodyData& body = data_of(*m_collisionObjects[i]);
    body.moved =
        !body.collided || (body.rigid.isActive() && body.displacement_from(body.collided_pose) > body.same_contacts);
    if (!body.moved) continue;
    body.collided = true;
    body.collided_pose = body.rigid.getWorldTransform();
    if (!body.is_static()) refresh_bounds(body);
  }
}

void DynamicsWorld::refilter(BodyData& body) {
  getPairCache()->removeOverlappingPairsContainingProxy(body.rigid.getBroadphaseHandle(), m_dispatcher1);
  find_pairs(body);
}

void DynamicsWorld::part(BodyData& a, BodyData& b) {
  btBroadphaseProxy *of_a = a.rigid.getBroadphaseHandle(), *of_b = b.rigid.getBroadphaseHandle();
  if (getPairCache()->findPair(of_a, of_b)) getPairCache()->removeOverlappingPair(of_a, of_b, m_dispatcher1);
}

void DynamicsWorld::find_pairs(BodyData& body) {
  btBroadphaseProxy* proxy = body.rigid.getBroadphaseHandle();
  auto& broadphase = static_cast<btDbvtBroadphase&>(*m_broadphasePairCache);
  broadphase.setAabbForceUpdate(proxy, proxy->m_aabbMin, proxy->m_aabbMax, m_dispatcher1);
}

// The tree keeps pairs whose fattened boxes overlap; the exact boxes decide here whether there is anything to compute.
void DynamicsWorld::collide_pairs() {
  btOverlappingPairCache& cache = *getPairCache();
  auto& dispatcher = static_cast<btCollisionDispatcher&>(*m_dispatcher1);
  btBroadphasePair* pairs = cache.getOverlappingPairArrayPtr();
  std::swap(postponed_, postponed_before_);
  std::sort(postponed_before_.begin(), postponed_before_.end());
  postponed_.clear();
  crowd_limit_.begin_step(cache, m_nonStaticRigidBodies.size());
  for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
    btBroadphasePair& pair = pairs[i];
    auto* a = static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject);
    auto* b = static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject);
    const bool postponed = was_postponed(pair);
    if (!a->isActive() && !b->isActive()) {
      if (postponed) postponed_.push_back(key_of(pair));
      continue;
    }
    const btBroadphaseProxy &of_a = *pair.m_pProxy0, &of_b = *pair.m_pProxy1;
    if (!TestAabbAgainstAabb2(of_a.m_aabbMin, of_a.m_aabbMax, of_b.m_aabbMin, of_b.m_aabbMax) ||
        !comes_near(*a, of_b.m_aabbMin, of_b.m_aabbMax) || !comes_near(*b, of_a.m_aabbMin, of_a.m_aabbMax)) {
      if (pair.m_algorithm) cache.cleanOverlappingPair(pair, m_dispatcher1);
      continue;
    }
    if (!crowd_limit_.admits(i)) continue;
    if (pair.m_algorithm && !data_of(*a).moved && !data_of(*b).moved && !postponed) {
      refresh_contacts(*pair.m_algorithm);
      continue;
    }
    const btCollisionObjectWrapper wrap_a(nullptr, a->getCollisionShape(), a, a->getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper wrap_b(nullptr, b->getCollisionShape(), b, b->getWorldTransform(), -1, -1);
    if (!pair.m_algorithm)
      pair.m_algorithm = dispatcher.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    if (!pair.m_algorithm) continue;
    btManifoldResult result(&wrap_a, &wrap_b);
    if (a->getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE &&
        b->getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE) {
      // Else Bullet sees two balls only once they overlap, unlike all other shapes, and a hit comes a step late.
      result.m_closestPointDistanceThreshold = std::min(data_of(*a).contact_margin, data_of(*b).contact_margin);
    }
    pair.m_algorithm->processCollision(&wrap_a, &wrap_b, m_dispatchInfo, &result);
    if (mesh_contacts_.take_postponed()) postponed_.push_back(key_of(pair));
  }
}

void DynamicsWorld::refresh_contacts(btCollisionAlgorithm& algorithm) {
  manifolds_.resize(0);
  algorithm.getAllContactManifolds(manifolds_);
  for (int i = 0; i < manifolds_.size(); ++i) {
    btPersistentManifold& manifold = *manifolds_[i];
    manifold.refreshContactPoints(manifold.getBody0()->getWorldTransform(), manifold.getBody1()->getWorldTransform());
  }
}

// Bodies that touch or are joined form an island; being merely near (as Bullet has it) keeps nobody awake.
void DynamicsWorld::calculateSimulationIslands() {
  int count = 0;
  for (int i = 0; i < m_collisionObjects.size(); ++i) {
    btCollisionObject& object = *m_collisionObjects[i];
    if (!object.isStaticOrKinematicObject()) object.setIslandTag(count++);
    object.setCompanionId(-1);
  }
  m_islandManager->initUnionFind(count);
  btUnionFind& islands = m_islandManager->getUnionFind();
  const auto join = [&islands](const btCollisionObject& a, const btCollisionObject& b) {
    if (!a.isStaticOrKinematicObject() && !b.isStaticOrKinematicObject())
      islands.unite(a.getIslandTag(), b.getIslandTag());
  };
  for (int i = 0; i < m_dispatcher1->getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *m_dispatcher1->getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() > 0) join(*manifold.getBody0(), *manifold.getBody1());
  }
  for (int i = 0; i < m_constraints.size(); ++i)
    if (m_constraints[i]->isEnabled()) join(m_constraints[i]->getRigidBodyA(), m_constraints[i]->getRigidBodyB());
  m_islandManager->storeIslandActivationState(this);
}

// Rolling friction is for round shapes, which touch in a point or a line. Where contacts span an area, or a mesh
// gives many, they resist rolling themselves, and the extra rows, being redundant, keep the solver from converging:
// stacks creep by half a millimetre a second. A body with flat sides tips about an edge: a lever as long as the body is
// wide would keep it there.
void DynamicsWorld::limit_rolling_friction() {
  for (int i = 0; i < m_dispatcher1->getNumManifolds(); ++i) {
    btPersistentManifold& manifold = *m_dispatcher1->getManifoldByIndexInternal(i);
    const BodyData &a = data_of(*manifold.getBody0()), &b = data_of(*manifold.getBody1());
    const bool redundant = manifold.getNumContacts() >= (a.shape->concave() || b.shape->concave() ? 2 : 3);
    const double limit = redundant ? 0.0 : std::min(a.rolling_lever_limit, b.rolling_lever_limit);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      btScalar& lever = manifold.getContactPoint(k).m_combinedRollingFriction;
      lever = std::min(lever, limit);
    }
  }
}

void DynamicsWorld::integrate(double h) {
  swept_motion_.begin_step(*this, m_nonStaticRigidBodies, h);
  std::array<EndingBody, kTurnsAtOnce> bodies{};
  std::size_t count = 0;
  for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) {
    btRigidBody& rigid = *m_nonStaticRigidBodies[i];
    if (!rigid.isActive()) continue;
    const double share = swept_motion_.share_of(i);
    if (own_motion_) {
      bodies[count++] = {&data_of(rigid), share};
      if (count < bodies.size()) continue;
      end_motion(bodies, h);
      count = 0;
      continue;
    }
    btTransform next;
    rigid.predictIntegratedTransform(h, next);
    const btVector3& from = rigid.getWorldTransform().getOrigin();
    if (share < 1.0) next.setOrigin(from + (next.getOrigin() - from) * share);
    rigid.setWorldTransform(next);
    rigid.setInterpolationWorldTransform(next);
    rigid.updateInertiaTensor();
  }
  end_motion(std::span(bodies).first(count), h);
}

void DynamicsWorld::update_sleeping(double h, bool sleeping) {
  const bool look = ++sleep_phase_ >= kRestInterval;
  if (look) sleep_phase_ = 0;
  awake_count_ = 0;
  for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) {
    btRigidBody& rigid = *m_nonStaticRigidBodies[i];
    if (rigid.getActivationState() == ISLAND_SLEEPING) {
      rigid.setLinearVelocity({0, 0, 0});
      rigid.setAngularVelocity({0, 0, 0});
      continue;
    }
    ++awake_count_;
    BodyData& body = data_of(rigid);
    if (look) {
      if (!sleeping || !body.may_sleep || body.displacement_from(body.rest_pose) > kRestDistance) {
        body.rest_pose = rigid.getWorldTransform();
        body.rest_time = 0.0;
      } else {
        body.rest_time += kRestInterval * h;
      }
    }
    rigid.setActivationState(body.rest_time >= kRestTime ? WANTS_DEACTIVATION : ACTIVE_TAG);
  }
}

void DynamicsWorld::count_awake() {
  awake_count_ = 0;
  for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i)
    if (m_nonStaticRigidBodies[i]->getActivationState() != ISLAND_SLEEPING) ++awake_count_;
}

void DynamicsWorld::clear_applied_forces() {
  for (int i = 0; i < m_nonStaticRigidBodies.size(); ++i) m_nonStaticRigidBodies[i]->clearForces();
}

}  // namespace ambf::physics::detail
