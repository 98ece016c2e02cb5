#include "physics/contacts/swept_motion.h"

#include <algorithm>
#include <cmath>

namespace ambf::physics::detail {
namespace {

// Of a ball's radius. A smaller ball starts free of what its body rests on; the body stops at its full radius.
constexpr double kSweptShare = 0.8;
// So much of its radius a body goes into what stops it: of boxes, Bullet finds contacts only where they overlap.
constexpr double kOverlap = 0.04;
constexpr int kMaxBalls = 16;  // of a compound; more parts are not swept

// The largest ball about the origin that lies within the supporting planes of 26 directions: exact for balls, boxes and
// cylinders.
double inner_radius(const btConvexShape& shape) {
  double radius = SIMD_INFINITY;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const btVector3 direction = btVector3(x, y, z).normalized();
        radius = std::min(radius, direction.dot(shape.localGetSupportingVertex(direction)));
      }
  return radius;
}

// The first thing that a ball meets on its way, others moving on meanwhile.
struct FirstMet final : btCollisionWorld::ConvexResultCallback {
  FirstMet(const BodyData& body, const btVector3& way, double radius, double h)
      : body_(body), way_(way), radius_(radius), h_(h) {
    m_collisionFilterGroup = m_collisionFilterMask = btBroadphaseProxy::AllFilter;
  }

  bool needsCollision(btBroadphaseProxy* proxy) const override {
    const BodyData& other = data_of(*static_cast<btCollisionObject*>(proxy->m_clientObject));
    return &other != &body_ && may_collide(body_, other);
  }

  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool normal_in_world) override {
    const btCollisionObject& other = *result.m_hitCollisionObject;
    btVector3 normal = result.m_hitNormalLocal;
    if (!normal_in_world) normal = other.getWorldTransform().getBasis() * normal;
    const auto* rigid = btRigidBody::upcast(&other);
    const btVector3 other_way = rigid == nullptr ? btVector3(0, 0, 0) : rigid->getLinearVelocity() * h_;
    const double alone = std::abs(way_.dot(normal)), together = std::abs((way_ - other_way).dot(normal));
    // In contact at the start, or sliding along: the solver has seen to it.
    if (result.m_hitFraction <= 0.0 || alone <= 0.0) return m_closestHitFraction;
    const double gap = result.m_hitFraction * alone - (1.0 - kSweptShare) * radius_;
    const bool approach = way_.dot(normal) * (way_ - other_way).dot(normal) > 0.0;
    if (gap <= 0.0 || !approach || gap >= together) return m_closestHitFraction;
    share = std::min(share, (gap + kOverlap * radius_) / together);
    return m_closestHitFraction;
  }

  double share = 1.0;

 private:
  const BodyData& body_;
  btVector3 way_;
  double radius_, h_;
};

}  // namespace

std::vector<SweptBall> swept_balls(const btCollisionShape& shape) {
  std::vector<SweptBall> balls;
  const auto add = [&balls](const btCollisionShape& part, const btVector3& centre) {
    if (!part.isConvex()) return;
    const double radius = inner_radius(static_cast<const btConvexShape&>(part));
    if (radius > 0.0 && radius < SIMD_INFINITY) balls.push_back({centre, radius});
  };
  if (!shape.isCompound()) {
    add(shape, {0, 0, 0});
    return balls;
  }
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  if (compound.getNumChildShapes() > kMaxBalls) return balls;
  for (int i = 0; i < compound.getNumChildShapes(); ++i)
    add(*compound.getChildShape(i), compound.getChildTransform(i).getOrigin());
  return balls;
}

void SweptMotion::begin_step(btCollisionWorld& world, const btAlignedObjectArray<btRigidBody*>& bodies, double h) {
  stopped_.clear();
  next_ = 0;
  for (int i = 0; i < bodies.size(); ++i) {
    btRigidBody& rigid = *bodies[i];
    const BodyData& body = data_of(rigid);
    const btVector3 way = rigid.getLinearVelocity() * h;
    if (!rigid.isActive() || way.length2() <= body.swept_from * body.swept_from || !body.joints.empty()) continue;
    double share = 1.0;
    for (const SweptBall& ball : body.swept_balls) {
      if (way.length2() <= ball.radius * ball.radius) continue;
      const btSphereShape swept(kSweptShare * ball.radius);
      const btTransform from(btMatrix3x3::getIdentity(), rigid.getWorldTransform() * ball.centre);
      const btTransform to(btMatrix3x3::getIdentity(), from.getOrigin() + way);
      FirstMet met(body, way, ball.radius, h);
      world.convexSweepTest(&swept, from, to, met);
      share = std::min(share, met.share);
    }
    if (share < 1.0) stopped_.push_back({i, share});
  }
}

double SweptMotion::share_of(int body) {
  if (next_ >= stopped_.size() || stopped_[next_].body != body) return 1.0;
  return stopped_[next_++].share;
}

}  // namespace ambf::physics::detail
