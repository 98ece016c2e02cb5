#include "physics/mounted_bodies.h"

#include <algorithm>
#include <cmath>

#include "physics/detail/world_data.h"

namespace ambf::physics {

using detail::BodyData;
using detail::from_bullet;
using detail::to_bullet;

namespace detail {

// Bullet reads these when the body is added to its world.
void BodyData::set_mounted(bool mount) {
  end_stiffness();
  mounted = mount;
  rigid.clearForces();
  if (mount)
    rigid.setMassProps(0.0, {0, 0, 0});
  else
    rigid.setMassProps(std::max(0.0, initial.mass), inertia);
  rigid.updateInertiaTensor();
}

void WorldData::mount(BodyData& body, bool mounted) {
  if (body.frozen) release(body);
  for (PullData& pull : pulls)
    if (pull.body == &body) end(pull);
  release_grasps_of(body);
  before_teleport(body);
  dynamics->forget(body);
  dynamics->removeRigidBody(&body.rigid);
  body.set_mounted(mounted);
  attach(body);
  for (JointData* joint : body.joints) {
    joint->constraint.setEnabled(!joint->parent.mounted && !joint->child.mounted);
    joint->clear_feedback();
  }
  body.moving_to = false;
  body.instant_twist = true;
  after_teleport(body);
}

}  // namespace detail

void set_mounted(Body& body, bool mounted) {
  BodyData& data = body.data();
  if (data.world != nullptr && data.mounted != mounted) data.world->mount(data, mounted);
}

bool is_mounted(const Body& body) { return body.data().mounted; }

void place_mounted(Body& body, const math::Pose& T_world_com, const math::Twist& twist) {
  BodyData& data = body.data();
  if (!data.mounted || data.world == nullptr) return;
  data.place(to_bullet(T_world_com));
  data.given_pose = T_world_com * math::inverse(data.initial.T_body_com);
  data.rigid.setLinearVelocity(to_bullet(twist.linear));
  data.rigid.setAngularVelocity(to_bullet(twist.angular));
  data.world->dynamics->refresh_bounds(data);
}

math::Twist expected_twist(const Body& body) {
  const BodyData& data = body.data();
  if (data.is_static() || data.world == nullptr) return body.twist();
  const btRigidBody& rigid = data.rigid;
  const double h = data.world->h;
  const btVector3 by_gravity = rigid.getGravity() * h;
  btVector3 linear = rigid.getLinearVelocity(), angular = rigid.getAngularVelocity();
  if (data.world->dynamics->own_motion() && data.instant_twist) {
    linear = (linear + 0.5 * by_gravity) * std::sqrt(data.linear_retained);
    angular *= std::sqrt(data.angular_retained);
  } else {
    linear = linear * data.linear_retained + by_gravity;
    angular *= data.angular_retained;
  }
  return {from_bullet(linear + rigid.getTotalForce() * (rigid.getInvMass() * h)),
          from_bullet(angular + rigid.getInvInertiaTensorWorld() * rigid.getTotalTorque() * h)};
}

void support(Body& body, const math::Wrench& wrench) {
  BodyData& data = body.data();
  if (data.is_static() || data.asleep()) return;
  data.rigid.applyCentralForce(to_bullet(wrench.force));
  data.rigid.applyTorque(to_bullet(wrench.torque));
  data.supported = true;
}

}  // namespace ambf::physics
