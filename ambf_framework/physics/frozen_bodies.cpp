// Bodies that diverged leave the simulation until they are released: frozen bodies are static to everything else.
#include <cmath>

#include "physics/detail/jointed_group.h"
#include "physics/detail/world_data.h"
#include "physics/world.h"

namespace ambf::physics {

using detail::BodyData;
using detail::jointed_group;

namespace {

// NaN fails every comparison.
bool finite(const btTransform& pose) {
  double sum = pose.getOrigin().length2();
  for (int i = 0; i < 3; ++i) sum += pose.getBasis()[i].length2();
  return std::isfinite(sum);
}

bool diverged(const BodyData& body, const SpeedLimits& limits) {
  if (body.is_static()) return false;
  const double linear = body.rigid.getLinearVelocity().length2(), angular = body.rigid.getAngularVelocity().length2();
  const bool slow = linear <= limits.linear * limits.linear && angular <= limits.angular * limits.angular;
  return !slow || !finite(body.rigid.getWorldTransform());
}

// Where the last step found the body (to same_contacts).
btTransform pose_before_step(const BodyData& body) {
  if (body.collided && finite(body.collided_pose)) return body.collided_pose;
  if (finite(body.rigid.getWorldTransform())) return body.rigid.getWorldTransform();
  return detail::to_bullet(body.initial.T_world_body * body.initial.T_body_com);
}

}  // namespace

namespace detail {

// Bullet reads these when the body is added to its world.
void BodyData::set_frozen(bool freeze) {
  frozen = freeze;
  stiffened = false;
  rigid.setLinearVelocity({0, 0, 0});
  rigid.setAngularVelocity({0, 0, 0});
  rigid.clearForces();
  if (freeze)
    rigid.setMassProps(0.0, {0, 0, 0});
  else
    rigid.setMassProps(initial.mass, inertia);
  rigid.updateInertiaTensor();
}

void WorldData::freeze(BodyData& body, const btTransform& T_world_com) {
  for (PullData& pull : pulls)
    if (pull.body == &body) end(pull);
  dynamics->visit_neighbours(body, [](BodyData& neighbour) { neighbour.wake(); });
  dynamics->removeRigidBody(&body.rigid);
  body.set_frozen(true);
  body.place(T_world_com);
  for (JointData* joint : body.joints) joint->clear_feedback();
  attach(body);
  ++frozen_count;
}

void WorldData::release(BodyData& body) {
  dynamics->removeRigidBody(&body.rigid);
  body.set_frozen(false);
  attach(body);
  --frozen_count;
  after_teleport(body);
}

}  // namespace detail

const Body* World::first_diverged(const SpeedLimits& limits) const {
  for (const BodyData* body : data_->bodies)
    if (diverged(*body, limits)) return &body->owner;
  return nullptr;
}

std::vector<FrozenGroup> World::freeze_diverged(const SpeedLimits& limits) {
  std::vector<FrozenGroup> groups;
  for (BodyData* body : data_->bodies) {
    if (!diverged(*body, limits)) continue;
    FrozenGroup group;
    group.linear_speed = body->rigid.getLinearVelocity().length();
    group.angular_speed = body->rigid.getAngularVelocity().length();
    // The diverged body comes first.
    for (BodyData* each : jointed_group(*body, [](const BodyData& other) { return !other.is_static(); })) {
      data_->freeze(*each, pose_before_step(*each));
      group.bodies.push_back(&each->owner);
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

void World::release_frozen(Body& body) {
  if (!body.frozen()) return;
  for (BodyData* each : jointed_group(body.data(), [](const BodyData& other) { return other.frozen; }))
    data_->release(*each);
}

std::size_t World::frozen_count() const { return data_->frozen_count; }

}  // namespace ambf::physics
