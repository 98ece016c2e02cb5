#include "physics/detail/free_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/joints/joint_data.h"
#include "physics/joints/joint_rows.h"

namespace ambf::physics::detail {

namespace {

// What joints will do is expected only to this extent: the share by which the expectation may come back through the
// rotation of the body. More of it could swing up.
constexpr double kMaxFeedback = 0.25;
// What a contact gives is more than this share of a velocity.
constexpr double kUnforced = 1e-12;
// Rotation in a step (rad) up to which the body counts as a ball: what rests costs nothing.
constexpr double kNoRotation = 1e-8;
// Rotation in a step (rad) that joints shall know of: a pivot 10 cm away would end 10 um beside its counterpart.
constexpr double kUnexpectedTurn = 1e-4;

bool is_round(const btVector3& inertia) { return inertia.x() == inertia.y() && inertia.y() == inertia.z(); }

bool same(const btVector3& a, const btVector3& b) {
  return (a - b).length2() <= kUnforced * kUnforced * (a.length2() + b.length2());
}

struct Impulse {
  btVector3 linear{0, 0, 0}, angular{0, 0, 0};  // Ns, Nms at the COM; world axes
};

// A body at a step's start, half begun.
struct Beginning {
  BodyData* body = nullptr;
  Impulse of_joints;           // expected
  btVector3 impulse{0, 0, 0};  // of it and of forces, where the body is not round; Nms, body axes
  Turn turn;
};

// What joints are expected to do to the body in the coming step: what they did in the last one. Nothing if that was no
// motion going on, but a jolt or the beginning of one.
Impulse expected_of_joints(const BodyData& body, double h) {
  Impulse sum;
  for (const JointData* joint : body.joints) {
    if (!joint->constraint.isEnabled()) continue;
    if (&joint->parent == &body) {
      sum.linear += joint->feedback.m_appliedForceBodyA - joint->step_force;
      sum.angular += joint->feedback.m_appliedTorqueBodyA + joint->step_torque_a;
    }
    if (&joint->child == &body) {
      sum.linear += joint->feedback.m_appliedForceBodyB + joint->step_force;
      sum.angular += joint->feedback.m_appliedTorqueBodyB + joint->step_torque_b;
    }
  }
  sum.linear *= h;
  sum.angular *= h;
  const double turned = (body.rigid.getInvInertiaTensorWorld() * sum.angular).length2();
  return turned > body.rigid.getAngularVelocity().length2() ? Impulse{} : sum;
}

// The gravity (m/s^2) by which the body falls. Forces that hold it up act as gravity does, in halves: in full they
// would lift what they balance by g h / 2 in a second while its twist is zero. (What carries a body as contacts do
// counts on the whole gravity: expected_twist.)
btVector3 falls_by(const BodyData& body) {
  const btRigidBody& rigid = body.rigid;
  const btVector3& gravity = rigid.getGravity();
  const double square = gravity.length2();
  if (square == 0.0 || body.supported) return gravity;
  const double held = -gravity.dot(rigid.getTotalForce()) * rigid.getInvMass() / square;
  return gravity * (1.0 - std::clamp(held, 0.0, 1.0));
}

// The first half: of the turn, its mean velocity is still to be found.
void begin_turning(Beginning& beginning, double h) {
  BodyData& body = *beginning.body;
  btRigidBody& rigid = body.rigid;
  const btMatrix3x3& basis = rigid.getWorldTransform().getBasis();
  const btVector3& inertia = body.inertia;
  const btVector3 omega = rigid.getAngularVelocity() * basis;  // in body axes
  body.start_torque = rigid.getTotalTorque();
  beginning.impulse = (body.start_torque * basis) * h;
  const btVector3 momentum =
      beginning.impulse + (body.instant_twist ? omega * inertia * std::sqrt(body.angular_retained)
                                              : momentum_after(omega, inertia, h) * body.angular_retained);
  btVector3 expected = beginning.of_joints.angular * basis;
  body.slow_turn = true;
  for (int i = 0; i < 3; ++i) {  // a torque about a light axis changes the rotation, and so what comes back, most
    const double feedback = 0.5 * h * omega.length() * inertia[inertia.maxAxis()] / inertia[i];
    if (feedback <= kMaxFeedback) continue;
    body.slow_turn = false;
    expected[i] *= kMaxFeedback / feedback;
  }
  beginning.impulse += expected;
  body.angular_momentum = basis * momentum;
  beginning.turn = {momentum + expected, inertia, omega};
}

void end_turning(const Beginning& beginning, const Turn& turn) {
  BodyData& body = *beginning.body;
  const btMatrix3x3& basis = body.rigid.getWorldTransform().getBasis();
  const btVector3 mean = turn.found ? turn.omega : turn.momentum / turn.inertia;
  body.mean_turn = basis * mean;
  body.rigid.setAngularVelocity(basis * (mean - beginning.impulse / turn.inertia));
}

// Whether a body on joints turns in a step otherwise than the solver leaves it.
bool turns_otherwise(const BodyData& body) {
  return body.begun && !body.round && !body.joints.empty() && body.slow_turn;
}

// The turn that belongs to the angular momentum after the solver: it found impulses for the expected rotation, and they
// are not quite those that were expected. `angular`: what it leaves the body with.
Turn turn_of_impulses(const BodyData& body, const btVector3& angular, double h) {
  const btMatrix3x3& basis = body.rigid.getWorldTransform().getBasis();
  // Efforts that joints applied since are not in the momentum yet: they count as impulses.
  const btVector3 in_momentum = body.rigid.getInvInertiaTensorWorld() * body.start_torque * h;
  const btVector3 change = angular - body.start_angular - in_momentum;
  const btVector3 impulse = (change * basis) * body.inertia;
  return {body.angular_momentum * basis + impulse, body.inertia, body.rigid.getAngularVelocity() * basis};
}

void finish_motion(BodyData& body, double h, double share) {
  btRigidBody& rigid = body.rigid;
  const btVector3 linear = rigid.getLinearVelocity(), angular = rigid.getAngularVelocity();
  const btTransform next = moved(rigid.getWorldTransform(), linear * share, angular, h);
  rigid.setWorldTransform(next);
  rigid.setInterpolationWorldTransform(next);
  rigid.updateInertiaTensor();
  if (!body.instant_twist || !body.begun) return;
  rigid.setLinearVelocity(linear * std::sqrt(body.linear_retained) + 0.5 * h * body.falls_by);
  const btVector3 turning = body.round ? angular : rigid.getInvInertiaTensorWorld() * body.angular_momentum;
  rigid.setAngularVelocity(turning * std::sqrt(body.angular_retained));
}

// The first half of a body's beginning; true: the mean velocity of its turn is still to be found.
bool begin(Beginning& beginning, double h) {
  BodyData& body = *beginning.body;
  btRigidBody& rigid = body.rigid;
  body.falls_by = falls_by(body);
  const btVector3 kick = body.falls_by * h;
  const btVector3 linear = rigid.getLinearVelocity();
  rigid.setLinearVelocity(body.instant_twist ? (linear + 0.5 * kick) * std::sqrt(body.linear_retained) - kick
                                             : linear * body.linear_retained);
  beginning.of_joints = expected_of_joints(body, h);
  body.pushed_by_joint = false;
  // What taut joints stiffen is as inert as they need, and so turns by no law of its own.
  body.round = body.stiffened || is_round(body.inertia) || h * rigid.getAngularVelocity().length() < kNoRotation;
  if (!body.round) {
    begin_turning(beginning, h);
    return true;
  }
  const double retained = body.instant_twist ? std::sqrt(body.angular_retained) : body.angular_retained;
  rigid.setAngularVelocity(rigid.getAngularVelocity() * retained);
  body.mean_turn = rigid.getAngularVelocity() + rigid.getInvInertiaTensorWorld() * beginning.of_joints.angular;
  return false;
}

void expect_motion(BodyData& body, const Impulse& of_joints, double h) {
  const btRigidBody& rigid = body.rigid;
  body.start_linear = rigid.getLinearVelocity();
  body.start_angular = rigid.getAngularVelocity();
  if (body.joints.empty()) return;
  body.mean_linear =
      body.start_linear + rigid.getGravity() * h + (rigid.getTotalForce() * h + of_joints.linear) * rigid.getInvMass();
  body.next_pose = moved(rigid.getWorldTransform(), body.mean_linear, body.mean_turn, h);
}

}  // namespace

btTransform moved(const btTransform& pose, const btVector3& linear, const btVector3& angular, double h) {
  const btVector3 half = 0.5 * h * angular;
  const double square = half.length2();
  btQuaternion turn;
  if (square < 0.01) {
    const double share = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)));
    turn.setValue(half.x() * share, half.y() * share, half.z() * share, std::sqrt(1.0 - square * share * share));
  } else {
    const double size = std::sqrt(square), share = std::sin(size) / size;
    turn.setValue(half.x() * share, half.y() * share, half.z() * share, std::cos(size));
  }
  const btQuaternion rotation = (turn * pose.getRotation()).normalized();
  return btTransform(rotation, pose.getOrigin() + linear * h);
}

void begin_motion(std::span<BodyData* const> bodies, double h) {
  std::array<Beginning, kTurnsAtOnce> beginnings;
  std::array<Turn, kTurnsAtOnce> turns;
  std::array<std::size_t, kTurnsAtOnce> turn_of{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    beginnings[i].body = bodies[i];
    turn_of[i] = begin(beginnings[i], h) ? count : kTurnsAtOnce;
    if (turn_of[i] == count) turns[count++] = beginnings[i].turn;
  }
  find_mean_velocities(std::span(turns).first(count), h);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (turn_of[i] < count) end_turning(beginnings[i], turns[turn_of[i]]);
    expect_motion(*bodies[i], beginnings[i].of_joints, h);
  }
}

btVector3 mean_turn_after(const BodyData& body, const btVector3& angular, double h) {
  if (!turns_otherwise(body)) return angular;
  Turn turn = turn_of_impulses(body, angular, h);
  find_mean_velocities({&turn, 1}, h);
  return body.rigid.getWorldTransform().getBasis() * turn.omega;
}

btVector3 unexpected_turn(const BodyData& body, const btVector3& angular, double h) {
  if (!turns_otherwise(body)) return {0, 0, 0};
  // Euler's equations have no coefficient above 1: by more than h/2 times what is not expected, times the sum of
  // both, the two cannot differ.
  const double square = angular.length2(), expected = body.mean_turn.length2();
  const double most = 0.5 * (angular - body.mean_turn).length2() * (square + expected) * h * h * h * h;
  if (h * h * square > kFastTurn * kFastTurn || most <= kUnexpectedTurn * kUnexpectedTurn) return {0, 0, 0};
  const btVector3 more = mean_turn_after(body, angular, h) - angular;
  return h * more.length() > kUnexpectedTurn ? more : btVector3(0, 0, 0);
}

void end_motion(std::span<const EndingBody> bodies, double h) {
  std::array<Turn, kTurnsAtOnce> turns;
  std::array<std::size_t, kTurnsAtOnce> turn_of{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyData& body = *bodies[i].body;
    btRigidBody& rigid = body.rigid;
    const btVector3 linear = rigid.getLinearVelocity(), angular = rigid.getAngularVelocity();
    const btVector3 by_force = rigid.getTotalForce() * rigid.getInvMass() * h;
    const btVector3 by_torque = rigid.getInvInertiaTensorWorld() * rigid.getTotalTorque() * h;
    if (body.begun) {
      body.instant_twist = !body.pushed_by_joint && !body.supported && same(linear, body.start_linear + by_force) &&
                           same(angular, body.start_angular + by_torque);
    }
    body.supported = false;
    turn_of[i] = kTurnsAtOnce;
    if (body.instant_twist || !turns_otherwise(body)) continue;
    turn_of[i] = count;
    turns[count++] = turn_of_impulses(body, angular, h);
  }
  find_mean_velocities(std::span(turns).first(count), h);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyData& body = *bodies[i].body;
    if (turn_of[i] < count)
      body.rigid.setAngularVelocity(body.rigid.getWorldTransform().getBasis() * turns[turn_of[i]].omega);
    finish_motion(body, h, bodies[i].share);
  }
}

}  // namespace ambf::physics::detail
