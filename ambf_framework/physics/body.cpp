#include "physics/body.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "math/rotation.h"
#include "physics/contacts/swept_motion.h"
#include "physics/detail/body_data.h"
#include "physics/detail/shape_data.h"
#include "physics/detail/world_data.h"

namespace ambf::physics {

using detail::BodyData;
using detail::from_bullet;
using detail::to_bullet;

namespace {

// A shape that gives no inertia (empty, plane) stands for a ball of this radius: a body that cannot turn would lock
// mechanisms.
constexpr double kAssumedRadius = 0.05;  // m

// Two bodies that both stayed within this of where their contacts were computed keep those contacts, brought up to
// date. So what rests costs no collision detection, though awake, and keeps the impulses it starts from. Moving
// triangle meshes find other contacts in every pose, and jitter if they look too often.
constexpr double kSameContacts = 1e-6;      // m
constexpr double kSameMeshContacts = 5e-5;  // m

// Rolling friction's lever on a body with flat sides, as a share of its reach.
constexpr double kRollingLever = 0.02;

btVector3 usable_inertia(const BodyDefinition& parameters, const Shape& shape) {
  if (parameters.mass <= 0.0) return {0, 0, 0};
  const math::Vec3 given = parameters.inertia.value_or(shape.inertia(parameters.mass));
  const double assumed = 0.4 * parameters.mass * kAssumedRadius * kAssumedRadius;
  const auto usable = [assumed](double value) { return std::isfinite(value) && value > 0.0 ? value : assumed; };
  return {usable(given.x), usable(given.y), usable(given.z)};
}

btRigidBody::btRigidBodyConstructionInfo construction(const BodyDefinition& parameters, const Shape& shape,
                                                      const btVector3& inertia) {
  btRigidBody::btRigidBodyConstructionInfo info(std::max(0.0, parameters.mass), nullptr, shape.data().shape.get(),
                                                inertia);
  info.m_startWorldTransform = to_bullet(parameters.T_world_body * parameters.T_body_com);
  info.m_friction = parameters.surface.friction;
  info.m_rollingFriction = parameters.surface.rolling_friction;
  info.m_restitution = parameters.surface.restitution;
  info.m_linearDamping = parameters.surface.linear_damping;
  info.m_angularDamping = parameters.surface.angular_damping;
  return info;
}

bool rolls(const Shape& shape) {
  switch (shape.data().shape->getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE:
    case CAPSULE_SHAPE_PROXYTYPE:
    case CYLINDER_SHAPE_PROXYTYPE:
    case CONE_SHAPE_PROXYTYPE: return true;
    default: return false;
  }
}

double reach_of(const Shape& shape) {
  if (shape.empty() || shape.infinite()) return kAssumedRadius;
  const BoundingBox box = shape.bounds();
  const math::Vec3 farthest{std::max(std::abs(box.min.x), std::abs(box.max.x)),
                            std::max(std::abs(box.min.y), std::abs(box.max.y)),
                            std::max(std::abs(box.min.z), std::abs(box.max.z))};
  return std::max(math::norm(farthest), 1e-3);
}

}  // namespace

namespace detail {

BodyData::BodyData(const BodyDefinition& parameters, Body& body)
    : owner(body),
      initial(parameters),
      shape(parameters.shape ? parameters.shape : make_empty_shape()),
      T_com_body(to_bullet(math::inverse(parameters.T_body_com))),
      inertia(usable_inertia(parameters, *shape)),
      rigid(construction(parameters, *shape, inertia)) {
  std::sort(initial.collision_groups.begin(), initial.collision_groups.end());
  rigid.setUserPointer(this);
  reach = reach_of(*shape);
  contact_margin =
      std::min(gContactBreakingThreshold, shape->data().shape->getContactBreakingThreshold(gContactBreakingThreshold));
  same_contacts = shape->concave() && !is_static() ? std::min(kSameMeshContacts, 0.25 * contact_margin) : kSameContacts;
  if (shape->empty()) rigid.setCollisionFlags(rigid.getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  if (parameters.gravity) {
    rigid.setFlags(rigid.getFlags() | BT_DISABLE_WORLD_GRAVITY);
    rigid.setGravity(to_bullet(*parameters.gravity));
  }
  if (!is_static() && !rolls(*shape)) rolling_lever_limit = kRollingLever * reach;
  if (!is_static()) swept_balls = detail::swept_balls(*shape->data().shape);
  for (const SweptBall& ball : swept_balls) swept_from = std::min(swept_from, ball.radius);
  set_initial_state();
}

double BodyData::displacement_from(const btTransform& then) const {
  const btTransform& now = rigid.getWorldTransform();
  // |R - R0| (Frobenius) = 2 sqrt(2) |sin(angle / 2)|.
  double squares = 0.0;
  for (int i = 0; i < 3; ++i) squares += (now.getBasis()[i] - then.getBasis()[i]).length2();
  return (now.getOrigin() - then.getOrigin()).length() + reach * std::sqrt(0.5 * squares);
}

void BodyData::place(const btTransform& T_world_com) {
  collided = false;
  rigid.setWorldTransform(T_world_com);
  rigid.setInterpolationWorldTransform(T_world_com);
  mean_linear.setZero();
  mean_turn.setZero();
  next_pose = T_world_com;
  rigid.updateInertiaTensor();
}

void BodyData::set_initial_state() {
  end_stiffness();
  place(to_bullet(initial.T_world_body * initial.T_body_com));
  given_pose = initial.T_world_body;
  moving_to = false;
  instant_twist = true;
  rigid.setLinearVelocity({0, 0, 0});
  rigid.setAngularVelocity({0, 0, 0});
  rigid.clearForces();
  rest_time = 0.0;
  rest_pose = rigid.getWorldTransform();
}

void BodyData::wake() {
  if (is_static()) return;
  rest_time = 0.0;
  rest_pose = rigid.getWorldTransform();
  if (rigid.getActivationState() != ACTIVE_TAG) {
    rigid.forceActivationState(ACTIVE_TAG);
    if (world) world->something_woke();
  }
}

bool groups_meet(const BodyData& a, const BodyData& b) {
  const auto &groups_a = a.initial.collision_groups, &groups_b = b.initial.collision_groups;
  if (groups_a.empty() || groups_b.empty()) return true;
  for (auto i = groups_a.begin(), j = groups_b.begin(); i != groups_a.end() && j != groups_b.end();) {
    if (*i == *j) return true;
    if (*i < *j)
      ++i;
    else
      ++j;
  }
  return false;
}

bool may_meet(const BodyData& a, const BodyData& b) {
  if (a.shape->empty() || b.shape->empty() || a.mounted || b.mounted) return false;
  if (a.initial.no_collision_set != 0 && a.initial.no_collision_set == b.initial.no_collision_set) return false;
  const auto& excluded = a.excluded.size() < b.excluded.size() ? a.excluded : b.excluded;
  const BodyData* other = a.excluded.size() < b.excluded.size() ? &b : &a;
  return std::find(excluded.begin(), excluded.end(), other) == excluded.end() && groups_meet(a, b);
}

bool may_collide(const BodyData& a, const BodyData& b) { return !(a.is_static() && b.is_static()) && may_meet(a, b); }

}  // namespace detail

Body::Body(const BodyDefinition& parameters) : data_(std::make_unique<BodyData>(parameters, *this)) {}

Body::~Body() {
  assert(data_->joints.empty());
  if (data_->world) data_->world->remove(*data_);
}

bool Body::is_static() const { return data_->initial.mass <= 0.0; }
double Body::mass() const { return std::max(0.0, data_->initial.mass); }
math::Vec3 Body::inertia() const { return from_bullet(data_->inertia); }
const math::Pose& Body::T_body_com() const { return data_->initial.T_body_com; }
std::uint32_t Body::user_index() const { return data_->initial.user_index; }
void Body::set_user_index(std::uint32_t index) { data_->initial.user_index = index; }

math::Pose Body::pose() const { return from_bullet(data_->rigid.getWorldTransform() * data_->T_com_body); }
math::Pose Body::com_pose() const { return from_bullet(data_->rigid.getWorldTransform()); }

math::Pose Body::initial_com_pose() const { return data_->initial.T_world_body * data_->initial.T_body_com; }

math::Twist Body::twist() const {
  return {from_bullet(data_->rigid.getLinearVelocity()), from_bullet(data_->rigid.getAngularVelocity())};
}

math::Vec3 Body::velocity_at(const math::Vec3& point_world) const {
  const btRigidBody& rigid = data_->rigid;
  return from_bullet(rigid.getVelocityInLocalPoint(to_bullet(point_world) - rigid.getWorldTransform().getOrigin()));
}

void Body::set_pose(const math::Pose& T_world_body) {
  BodyData& body = *data_;
  if (is_static()) {
    body.moving_to = false;
    if (T_world_body == body.given_pose) return;
    body.given_pose = T_world_body;
  }
  if (body.world) body.world->before_teleport(body);
  body.place(to_bullet(T_world_body * body.initial.T_body_com));
  body.instant_twist = true;
  if (body.world) body.world->after_teleport(body);
}

void Body::set_twist(const math::Twist& twist) {
  if (data_->is_static()) return;
  data_->rigid.setLinearVelocity(to_bullet(twist.linear));
  data_->rigid.setAngularVelocity(to_bullet(twist.angular));
  data_->instant_twist = true;
  if (data_->world) data_->world->state_changed();
  data_->wake();
}

math::Vec3 Body::gravity_on_set_twist() const {
  if (is_static() || !data_->world) return {};
  return gravity() * (data_->world->h * (data_->world->dynamics->own_motion() ? 0.5 : 1.0));
}

math::Wrench Body::wrench_of_set_twist(const math::Twist& wanted) const {
  if (is_static() || !data_->world) return {};
  const double h = data_->world->h;
  const math::Twist now = twist();
  math::Vec3 change = wanted.linear - now.linear;
  if (!data_->instant_twist) change += gravity_on_set_twist() - gravity() * h;
  const math::Quat R_world_com = com_pose().orientation;
  const math::Vec3 turned_com = math::rotate(math::inverse(R_world_com), wanted.angular - now.angular);
  return {change * (mass() / h), math::rotate(R_world_com, math::scaled(inertia(), turned_com)) * (1.0 / h)};
}

void Body::move_to(const math::Pose& T_world_body) {
  BodyData& body = *data_;
  if (!is_static() || !body.world) return set_pose(T_world_body);
  if (T_world_body == body.given_pose && !body.moving_to) return;
  body.move_target = T_world_body;
  if (body.moving_to) return;
  body.moving_to = true;
  body.world->start_moving(body);
}

void Body::apply_wrench(const math::Wrench& wrench) {
  if (data_->is_static()) return;
  const btVector3 force = to_bullet(wrench.force), torque = to_bullet(wrench.torque);
  if (force.isZero() && torque.isZero()) return;
  data_->rigid.applyCentralForce(force);
  data_->rigid.applyTorque(torque);
  data_->wake();
}

void Body::apply_force(const math::Vec3& force_world, const math::Vec3& point_world) {
  const math::Vec3 com = from_bullet(data_->rigid.getWorldTransform().getOrigin());
  apply_wrench({force_world, math::cross(point_world - com, force_world)});
}

void Body::apply_torque(const math::Vec3& torque_world) { apply_wrench({{}, torque_world}); }

void Body::apply_impulse(const math::Vec3& impulse_world, const math::Vec3& point_world) {
  if (data_->is_static() || impulse_world == math::Vec3{}) return;
  const btVector3 com = data_->rigid.getWorldTransform().getOrigin();
  data_->rigid.applyImpulse(to_bullet(impulse_world), to_bullet(point_world) - com);
  if (data_->world) data_->world->state_changed();
  data_->wake();
}

math::Wrench Body::applied_wrench() const {
  return {from_bullet(data_->rigid.getTotalForce()), from_bullet(data_->rigid.getTotalTorque())};
}

void Body::set_gravity(const std::optional<math::Vec3>& gravity) {
  if (data_->initial.gravity == gravity) return;
  data_->initial.gravity = gravity;
  btRigidBody& rigid = data_->rigid;
  const int flags = rigid.getFlags() & ~BT_DISABLE_WORLD_GRAVITY;
  rigid.setFlags(gravity ? flags | BT_DISABLE_WORLD_GRAVITY : flags);
  if (gravity)
    rigid.setGravity(to_bullet(*gravity));
  else if (data_->world)
    rigid.setGravity(to_bullet(data_->world->options.gravity));
  data_->wake();
}

math::Vec3 Body::gravity() const { return from_bullet(data_->rigid.getGravity()); }

void Body::set_surface(const scene::Surface& surface) {
  BodyData& body = *data_;
  body.rigid.setFriction(surface.friction);
  body.rigid.setRollingFriction(surface.rolling_friction);
  body.rigid.setRestitution(surface.restitution);
  body.rigid.setDamping(surface.linear_damping, surface.angular_damping);
  body.collided = false;  // contacts carry what the surfaces were when they were computed
  if (!body.world) return;
  body.world->set_damping(body);
  body.world->wake_around(body);
}

scene::Surface Body::surface() const {
  const btRigidBody& rigid = data_->rigid;
  return {rigid.getFriction(), rigid.getRollingFriction(), rigid.getRestitution(), rigid.getLinearDamping(),
          rigid.getAngularDamping()};
}

void Body::wake() { data_->wake(); }
bool Body::asleep() const { return data_->asleep(); }
bool Body::frozen() const { return data_->frozen; }

void Body::set_sleeping_allowed(bool allowed) {
  data_->may_sleep = allowed;
  if (!allowed) data_->wake();
}

void Body::reset() {
  if (data_->frozen) data_->world->release(*data_);
  if (data_->world) data_->world->release_grasps_of(*data_);
  if (data_->world) data_->world->before_teleport(*data_);
  data_->set_initial_state();
  if (data_->world) data_->world->after_teleport(*data_);
}

}  // namespace ambf::physics
