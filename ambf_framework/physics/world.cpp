#include "physics/world.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "math/rotation.h"
#include "physics/detail/contact_memory.h"
#include "physics/detail/world_data.h"

namespace ambf::physics {

using detail::BodyData;
using detail::from_bullet;
using detail::to_bullet;
using detail::WorldData;

World::World(const WorldOptions& options) : data_(std::make_unique<WorldData>(options)) {}
World::~World() = default;

const WorldOptions& World::options() const { return data_->options; }

void World::set_gravity(const math::Vec3& gravity) {
  if (gravity == data_->options.gravity) return;
  data_->options.gravity = gravity;
  data_->dynamics->setGravity(to_bullet(gravity));
  for (BodyData* body : data_->bodies) {
    if (body->is_static() || body->initial.gravity) continue;
    body->rigid.setGravity(to_bullet(gravity));
    body->wake();
  }
}

void World::add(Body& body) { data_->add(body.data()); }
void World::remove(Body& body) { data_->remove(body.data()); }
void World::add(Joint& joint) { data_->add(joint.data()); }
void World::remove(Joint& joint) { data_->remove(joint.data()); }
std::size_t World::body_count() const { return data_->bodies.size(); }
std::size_t World::joint_count() const { return data_->joints.size(); }

std::size_t World::awake_count() const {
  std::size_t count = 0;
  for (const BodyData* body : data_->bodies)
    if (!body->is_static() && !body->asleep()) ++count;
  return count;
}

void World::set_real_time(bool real_time) { data_->mesh_contacts->set_real_time(real_time); }
void World::step() { data_->step(); }
std::uint64_t World::steps() const { return data_->steps; }

PhaseTimes World::phase_times() const {
  const detail::PhaseSums& sums = data_->phase_sums;
  if (sums.steps == 0) return {};
  const double share = 1.0 / sums.steps;
  return {sums.collision * share, sums.solver * share, sums.integration * share};
}

std::size_t World::contacts(std::span<Contact> out) const {
  std::size_t count = 0;
  btCollisionDispatcher& dispatcher = *data_->dispatcher;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k, ++count) {
      if (count >= out.size()) continue;
      const btManifoldPoint& point = manifold.getContactPoint(k);
      Contact& contact = out[count];
      contact.body_a = &detail::data_of(*manifold.getBody0()).owner;
      contact.body_b = &detail::data_of(*manifold.getBody1()).owner;
      contact.point_on_a = from_bullet(point.getPositionWorldOnA());
      contact.point_on_b = from_bullet(point.getPositionWorldOnB());
      contact.normal_on_b = from_bullet(point.m_normalWorldOnB);
      contact.distance = point.getDistance();
      contact.normal_impulse = point.m_appliedImpulse + detail::passed_impulse(point);
      contact.friction_impulse = from_bullet(point.m_lateralFrictionDir1 * point.m_appliedImpulseLateral1 +
                                             point.m_lateralFrictionDir2 * point.m_appliedImpulseLateral2);
    }
  }
  return count;
}

namespace {

struct ClosestHit final : btCollisionWorld::ClosestRayResultCallback {
  ClosestHit(const btVector3& from, const btVector3& to, const RayFilter& ray_filter)
      : ClosestRayResultCallback(from, to), filter(ray_filter) {
    m_collisionFilterGroup = btBroadphaseProxy::AllFilter;
    m_collisionFilterMask = btBroadphaseProxy::AllFilter;
  }

  bool needsCollision(btBroadphaseProxy* proxy) const override {
    const BodyData& body = detail::data_of(*static_cast<btCollisionObject*>(proxy->m_clientObject));
    if (body.shape->empty() || (body.is_static() && !filter.hit_static) || &body.owner == filter.ignored) return false;
    for (const Body* ignored : filter.also_ignored)
      if (ignored == &body.owner) return false;
    return true;
  }

  btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool normal_in_world) override {
    triangle = result.m_localShapeInfo ? result.m_localShapeInfo->m_triangleIndex : -1;
    return ClosestRayResultCallback::addSingleResult(result, normal_in_world);
  }

  const RayFilter& filter;
  int triangle = -1;
};

// Triangle meshes are surfaces: they have no inside.
bool contains(const btCollisionShape& shape, const btTransform& pose, const btVector3& point) {
  if (shape.getShapeType() == STATIC_PLANE_PROXYTYPE) {
    const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
    return plane.getPlaneNormal().dot(pose.inverse() * point) < plane.getPlaneConstant();
  }
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int i = 0; i < compound.getNumChildShapes(); ++i)
      if (contains(*compound.getChildShape(i), pose * compound.getChildTransform(i), point)) return true;
    return false;
  }
  if (!shape.isConvex()) return false;
  btGjkEpaSolver2::sResults result;
  return btGjkEpaSolver2::SignedDistance(point, 0.0, static_cast<const btConvexShape*>(&shape), pose, result) < 0.0;
}

// The first body, in order of addition, that contains a point.
struct Containing final : btBroadphaseAabbCallback {
  Containing(const btVector3& at, const ClosestHit& ray) : point(at), hit(ray) {}
  bool process(const btBroadphaseProxy* proxy) override {
    auto* object = static_cast<btCollisionObject*>(proxy->m_clientObject);
    const bool earlier = !body || proxy->m_uniqueId < uid;
    if (earlier && hit.needsCollision(object->getBroadphaseHandle()) &&
        contains(*object->getCollisionShape(), object->getWorldTransform(), point)) {
      body = &detail::data_of(*object).owner;
      uid = proxy->m_uniqueId;
    }
    return true;
  }
  const btVector3& point;
  const ClosestHit& hit;
  const Body* body = nullptr;
  int uid = 0;
};

}  // namespace

std::optional<RayHit> World::ray_cast(const math::Vec3& from, const math::Vec3& to, const RayFilter& filter) const {
  const btVector3 start = to_bullet(from), end = to_bullet(to);
  ClosestHit hit(start, end, filter);
  if (filter.hit_from_inside) {
    Containing containing(start, hit);
    data_->broadphase->aabbTest(start, start, containing);
    if (containing.body) return RayHit{containing.body, from, math::normalized(from - to), 0.0, -1};
  }
  data_->dynamics->rayTest(start, end, hit);
  if (!hit.hasHit()) return std::nullopt;
  RayHit result;
  const BodyData& body = detail::data_of(*hit.m_collisionObject);
  result.body = &body.owner;
  result.point = from_bullet(hit.m_hitPointWorld);
  result.normal = from_bullet(hit.m_hitNormalWorld);
  result.fraction = hit.m_closestHitFraction;
  result.triangle = body.shape->concave() ? hit.triangle : -1;
  return result;
}

int World::begin_pull(Body& body, const math::Vec3& point_world) {
  BodyData& target = body.data();
  if (target.is_static() || target.world != data_.get()) return -1;
  const auto free = std::find_if(data_->pulls.begin(), data_->pulls.end(), [](const auto& p) { return !p.body; });
  if (free == data_->pulls.end()) return -1;
  detail::PullData& pull = *free;
  const btVector3 pivot = target.rigid.getWorldTransform().inverse() * to_bullet(point_world);
  pull.body = &target;
  pull.feedback = {};
  btPoint2PointConstraint& constraint = pull.constraint.emplace(target.rigid, pivot);
  constraint.m_setting.m_impulseClamp = target.initial.mass;
  constraint.setJointFeedback(&pull.feedback);
  data_->dynamics->addConstraint(&constraint, false);
  target.wake();
  return static_cast<int>(free - data_->pulls.begin());
}

void World::move_pull(int pull, const math::Vec3& target_world) {
  detail::PullData& held = data_->pulls[pull];
  if (!held.body) return;
  held.constraint->setPivotB(to_bullet(target_world));
  held.body->wake();
}

void World::end_pull(int pull) { data_->end(data_->pulls[pull]); }

const Body* World::pulled(int pull) const {
  const BodyData* body = data_->pulls[pull].body;
  return body ? &body->owner : nullptr;
}

math::Wrench World::pull_wrench(int pull) const {
  const btJointFeedback& feedback = data_->pulls[pull].feedback;
  return {from_bullet(feedback.m_appliedForceBodyA), from_bullet(feedback.m_appliedTorqueBodyA)};
}

std::uint64_t World::crowded_steps() const { return data_->mesh_contacts->overloaded_steps(); }

World::Crowd World::crowd() const {
  const detail::CrowdLimit::Crowd& crowd = data_->dynamics->crowd_limit().crowd();
  return {crowd.body ? &crowd.body->owner : nullptr, crowd.near_bodies, crowd.steps};
}

std::array<const Body*, 2> World::max_depth_meshes() const {
  std::array<const Body*, 2> result{};
  double deepest = SIMD_INFINITY;
  for (int i = 0; i < data_->dispatcher->getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *data_->dispatcher->getManifoldByIndexInternal(i);
    const BodyData &a = detail::data_of(*manifold.getBody0()), &b = detail::data_of(*manifold.getBody1());
    if (!(a.shape->concave() && !a.is_static()) && !(b.shape->concave() && !b.is_static())) continue;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      if (manifold.getContactPoint(k).getDistance() >= deepest) continue;
      deepest = manifold.getContactPoint(k).getDistance();
      result = {&a.owner, &b.owner};
    }
  }
  return result;
}

}  // namespace ambf::physics
