// Saving and restoring a world. Bullet's contact pairs and their warm starts depend on the whole history; no copy of
// them gives the same continuation in another world. So both ends restart canonically: state in, everything removed
// and added in order.
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "physics/detail/grasp_data.h"
#include "physics/detail/world_data.h"
#include "physics/snapshot/detail/saved_state.h"
#include "physics/world.h"

namespace ambf::physics {

using detail::BodyData;
using detail::GraspData;
using detail::JointData;
using detail::SavedBody;
using detail::SavedGrasp;
using detail::SavedHeader;
using detail::SavedJoint;
using detail::take;

namespace {

template <class T>
void append(std::vector<std::byte>& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 8 == 0);
  const std::size_t at = out.size();
  out.resize(at + sizeof(T));
  std::memcpy(out.data() + at, &value, sizeof(T));
}

void put(double* to, const btVector3& v) {
  for (int i = 0; i < 3; ++i) to[i] = v[i];
}
btVector3 vector(const double* from) { return {from[0], from[1], from[2]}; }

void put(double* basis, double* origin, const btTransform& t) {
  for (int i = 0; i < 3; ++i) put(basis + 3 * i, t.getBasis()[i]);
  put(origin, t.getOrigin());
}
btTransform transform(const double* b, const double* origin) {
  return btTransform(btMatrix3x3(b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8]), vector(origin));
}

void put(double* to, const math::Pose& p) {
  const double values[7] = {p.position.x,    p.position.y,    p.position.z,   p.orientation.x,
                            p.orientation.y, p.orientation.z, p.orientation.w};
  std::memcpy(to, values, sizeof(values));
}
math::Pose pose(const double* v) { return {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}}; }

SavedBody state_of(const BodyData& body) {
  SavedBody s{};
  const btRigidBody& rigid = body.rigid;
  put(s.basis, s.origin, rigid.getWorldTransform());
  put(s.linear, rigid.getLinearVelocity());
  put(s.angular, rigid.getAngularVelocity());
  s.instant_twist = body.instant_twist ? 1.0 : 0.0;
  put(s.force, rigid.getTotalForce());
  put(s.torque, rigid.getTotalTorque());
  s.has_gravity = body.initial.gravity ? 1.0 : 0.0;
  if (body.initial.gravity) put(s.gravity, detail::to_bullet(*body.initial.gravity));
  put(s.given_pose, body.given_pose);
  put(s.move_target, body.move_target);
  s.moving_to = body.moving_to ? 1.0 : 0.0;
  put(s.rest_basis, s.rest_origin, body.rest_pose);
  s.rest_time = body.rest_time;
  s.activation = rigid.getActivationState();
  s.may_sleep = body.may_sleep ? 1.0 : 0.0;
  s.frozen = body.frozen ? 1.0 : 0.0;
  put(s.inverse_inertia, rigid.getInvInertiaDiagLocal());
  s.stiffened = body.stiffened ? 1.0 : 0.0;
  return s;
}

void apply(const SavedBody& s, BodyData& body) {
  btRigidBody& rigid = body.rigid;
  if (body.frozen != (s.frozen != 0.0) && !body.mounted) body.set_frozen(!body.frozen);
  body.end_stiffness();
  if (s.stiffened != 0.0 && !body.mounted) body.set_stiffness(vector(s.inverse_inertia));
  body.place(transform(s.basis, s.origin));
  rigid.setLinearVelocity(vector(s.linear));
  rigid.setAngularVelocity(vector(s.angular));
  body.instant_twist = s.instant_twist != 0.0;
  rigid.clearForces();
  rigid.applyCentralForce(vector(s.force));
  rigid.applyTorque(vector(s.torque));
  std::optional<math::Vec3> gravity;
  if (s.has_gravity != 0.0) gravity = detail::from_bullet(vector(s.gravity));
  body.owner.set_gravity(gravity);
  body.given_pose = pose(s.given_pose);
  body.move_target = pose(s.move_target);
  body.moving_to = s.moving_to != 0.0;
  body.rest_pose = transform(s.rest_basis, s.rest_origin);
  body.rest_time = s.rest_time;
  body.may_sleep = s.may_sleep != 0.0;
  rigid.forceActivationState(static_cast<int>(s.activation));
}

SavedJoint state_of(const JointData& joint) {
  SavedJoint s{};
  s.drive = static_cast<double>(joint.drive);
  s.motor_velocity = joint.motor_velocity;
  s.motor_max_impulse = joint.motor_max_impulse;
  s.drive_effort = joint.drive_effort;
  const Joint::Servo& servo = joint.servo;
  const double gains[6] = {servo.position, servo.velocity,    servo.stiffness,
                           servo.damping,  servo.feedforward, servo.max_effort};
  std::memcpy(s.servo, gains, sizeof(gains));
  s.has_limits = joint.limits ? 1.0 : 0.0;
  if (joint.limits) std::memcpy(s.limits, joint.limits->data(), sizeof(s.limits));
  s.damping = joint.damping;
  s.erp = joint.erp;
  s.cfm = joint.cfm;
  s.enabled = joint.constraint.isEnabled() ? 1.0 : 0.0;
  s.turns_reference = joint.turns_reference;
  s.sleep_reference = joint.sleep_reference;
  s.sleep_reference_settled = joint.sleep_reference_settled ? 1.0 : 0.0;
  put(s.feedback, joint.feedback.m_appliedForceBodyA);
  put(s.feedback + 3, joint.feedback.m_appliedTorqueBodyA);
  put(s.feedback + 6, joint.feedback.m_appliedForceBodyB);
  put(s.feedback + 9, joint.feedback.m_appliedTorqueBodyB);
  put(s.step_axis, joint.step_axis);
  put(s.step_lever, joint.step_lever);
  s.step_effort = joint.step_effort;
  put(s.step_force, joint.step_force);
  put(s.step_torque_a, joint.step_torque_a);
  put(s.step_torque_b, joint.step_torque_b);
  return s;
}

void apply(const SavedJoint& s, JointData& joint) {
  joint.drive = static_cast<detail::Drive>(static_cast<int>(s.drive));
  joint.motor_velocity = s.motor_velocity;
  joint.motor_max_impulse = s.motor_max_impulse;
  joint.drive_effort = s.drive_effort;
  joint.servo = {s.servo[0], s.servo[1], s.servo[2], s.servo[3], s.servo[4], s.servo[5]};
  joint.limits.reset();
  if (s.has_limits != 0.0) joint.limits = std::array<double, 2>{s.limits[0], s.limits[1]};
  joint.damping = s.damping;
  joint.erp = s.erp;
  joint.cfm = s.cfm;
  joint.constraint.setEnabled(s.enabled != 0.0 && !joint.parent.mounted && !joint.child.mounted);
  joint.turns_reference = s.turns_reference;
  joint.sleep_reference = s.sleep_reference;
  joint.sleep_reference_settled = s.sleep_reference_settled != 0.0;
  joint.feedback.m_appliedForceBodyA = vector(s.feedback);
  joint.feedback.m_appliedTorqueBodyA = vector(s.feedback + 3);
  joint.feedback.m_appliedForceBodyB = vector(s.feedback + 6);
  joint.feedback.m_appliedTorqueBodyB = vector(s.feedback + 9);
  joint.step_axis = vector(s.step_axis);
  joint.step_lever = vector(s.step_lever);
  joint.step_effort = s.step_effort;
  joint.step_force = vector(s.step_force);
  joint.step_torque_a = vector(s.step_torque_a);
  joint.step_torque_b = vector(s.step_torque_b);
}

std::uint64_t index_of(const std::vector<BodyData*>& bodies, const BodyData& body) {
  return static_cast<std::uint64_t>(std::find(bodies.begin(), bodies.end(), &body) - bodies.begin());
}

SavedGrasp state_of(const JointData& joint, std::size_t grasp, const std::vector<BodyData*>& bodies) {
  SavedGrasp s{};
  s.grasp = grasp;
  s.holder = index_of(bodies, joint.parent);
  s.held = index_of(bodies, joint.child);
  put(s.holder_basis, s.holder_origin, joint.frame_a);
  put(s.held_basis, s.held_origin, joint.frame_b);
  s.joint = state_of(joint);
  return s;
}

void apply(const SavedGrasp& s, detail::WorldData& world) {
  GraspData& grasp = *world.grasps[s.grasp];
  if (world.bodies[s.holder]->mounted || world.bodies[s.held]->mounted) return;  // only a forged state has such
  apply(s.joint, grasp.make(*world.bodies[s.holder], *world.bodies[s.held], transform(s.holder_basis, s.holder_origin),
                            transform(s.held_basis, s.held_origin)));
  world.tie(grasp);
}

}  // namespace

void World::save_state(std::vector<std::byte>& out) {
  detail::WorldData& world = *data_;
  out.clear();
  SavedHeader header{};
  header.magic = detail::kSavedMagic;
  header.version = detail::kSavedVersion;
  header.bodies = world.bodies.size();
  header.joints = world.joints.size();
  header.grasps = world.holding.size();
  header.steps = world.steps;
  header.moving = world.maybe_awake ? 1 : 0;
  header.step = world.options.step;
  put(header.gravity, detail::to_bullet(world.options.gravity));
  append(out, header);
  for (const BodyData* body : world.bodies) append(out, state_of(*body));
  for (const JointData* joint : world.joints) append(out, state_of(*joint));
  for (std::size_t i = 0; i < world.grasps.size(); ++i)
    if (world.grasps[i]->joint) append(out, state_of(*world.grasps[i]->joint, i, world.bodies));
  world.restart();
}

bool World::restore_state(std::span<const std::byte> state) {
  detail::WorldData& world = *data_;
  StateLayout layout{{}, world.joints.size(), world.grasps.size(), world.options.step};
  for (const BodyData* body : world.bodies) layout.is_static.push_back(body->owner.is_static());
  if (check_state(state, layout)) return false;
  const auto header = take<SavedHeader>(state);
  world.end_pulls();
  world.forget_grasps();
  set_gravity(detail::from_bullet(vector(header.gravity)));
  world.carried.clear();
  world.frozen_count = 0;
  for (BodyData* body : world.bodies) {
    apply(take<SavedBody>(state), *body);
    if (body->moving_to) world.carried.push_back(body);
    if (body->frozen) ++world.frozen_count;
  }
  for (JointData* joint : world.joints) apply(take<SavedJoint>(state), *joint);
  for (std::uint64_t i = 0; i < header.grasps; ++i) apply(take<SavedGrasp>(state), world);
  world.steps = header.steps;
  world.restart();
  world.maybe_awake = header.moving != 0;
  return true;
}

void World::reset() {
  detail::WorldData& world = *data_;
  world.end_pulls();
  world.forget_grasps();
  world.carried.clear();
  world.frozen_count = 0;
  for (BodyData* body : world.bodies) {
    if (body->frozen) body->set_frozen(false);
    body->set_initial_state();
    if (!body->is_static()) body->rigid.forceActivationState(ACTIVE_TAG);
  }
  for (JointData* joint : world.joints) {
    joint->reset();
    joint->turns_reference = joint->coordinate();
  }
  if (world.soft != nullptr) world.soft->reset();
  world.steps = 0;
  world.restart();
  world.maybe_awake = true;
}

}  // namespace ambf::physics
