#include "physics/detail/free_motion.h"

#include <algorithm>
#include <cmath>

#include "physics/joints/joint_data.h"

namespace ambf::physics::detail {

namespace {

// Iterations for the mean velocity: three do up to 0.1 rad a step.
constexpr int kMaxIterations = 12;
constexpr double kPrecision = 1e-15;  // of the momentum
constexpr double kAcceptable = 1e-9;  // of the momentum: good enough if rounding allows no better
// What joints will do is expected only to this extent: the share by which the expectation may come back through the
// rotation of the body. More of it could swing up.
constexpr double kMaxFeedback = 0.25;
// What a contact gives is more than this share of a velocity.
constexpr double kUnforced = 1e-12;
// Rotation in a step (rad) up to which the body counts as a ball: what rests costs nothing.
constexpr double kNoRotation = 1e-8;

// exp(angle) v = v + c1 angle x v + c2 angle x (angle x v).
btVector3 turned(const btVector3& angle, const btVector3& v) {
  const double square = angle.length2();
  double c1, c2;
  if (square < 0.01) {
    c1 = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)));
    c2 = 0.5 - square / 24.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0 * (1.0 - square / 90.0)));
  } else {
    const double size = std::sqrt(square);
    c1 = std::sin(size) / size;
    c2 = (1.0 - std::cos(size)) / square;
  }
  const btVector3 across = angle.cross(v);
  return v + across * c1 + angle.cross(across) * c2;
}

btMatrix3x3 cross_matrix(const btVector3& v) { return {0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0}; }

bool is_round(const btVector3& inertia) { return inertia.x() == inertia.y() && inertia.y() == inertia.z(); }

bool same(const btVector3& a, const btVector3& b) {
  return (a - b).length2() <= kUnforced * kUnforced * (a.length2() + b.length2());
}

struct Impulse {
  btVector3 linear{0, 0, 0}, angular{0, 0, 0};  // Ns, Nms at the COM; world axes
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

void begin_turning(BodyData& body, const btVector3& of_joints, double h) {
  btRigidBody& rigid = body.rigid;
  const btMatrix3x3& basis = rigid.getWorldTransform().getBasis();
  const btVector3& inertia = body.inertia;
  const btVector3 omega = rigid.getAngularVelocity() * basis;  // in body axes
  body.start_torque = rigid.getTotalTorque();
  const btVector3 impulse = (body.start_torque * basis) * h;
  const btVector3 momentum = impulse + (body.instant_twist ? omega * inertia * std::sqrt(body.angular_retained)
                                                           : momentum_after(omega, inertia, h) * body.angular_retained);
  btVector3 expected = of_joints * basis;
  body.slow_turn = true;
  for (int i = 0; i < 3; ++i) {  // a torque about a light axis changes the rotation, and so what comes back, most
    const double feedback = 0.5 * h * omega.length() * inertia[inertia.maxAxis()] / inertia[i];
    if (feedback <= kMaxFeedback) continue;
    body.slow_turn = false;
    expected[i] *= kMaxFeedback / feedback;
  }
  btVector3 mean = omega;
  if (!mean_velocity(momentum + expected, inertia, h, mean)) mean = (momentum + expected) / inertia;
  body.mean_turn = basis * mean;
  body.angular_momentum = basis * momentum;
  rigid.setAngularVelocity(basis * (mean - (impulse + expected) / inertia));
}

// The mean angular velocity that belongs to the angular momentum after the solver: it found impulses for the expected
// rotation, and they are not quite those that were expected. (rad/s; `change` is what its impulses gave.)
btVector3 turn_of_impulses(const BodyData& body, const btVector3& change, double h) {
  const btMatrix3x3& basis = body.rigid.getWorldTransform().getBasis();
  const btVector3 impulse = (change * basis) * body.inertia;
  btVector3 mean = body.rigid.getAngularVelocity() * basis;
  mean_velocity(body.angular_momentum * basis + impulse, body.inertia, h, mean);
  return basis * mean;
}

}  // namespace

btVector3 momentum_before(const btVector3& omega, const btVector3& inertia, double h) {
  const btVector3 momentum = inertia * omega;
  const btVector3 rate = momentum.cross(omega);  // of the momentum, seen from the body
  const btVector3 a = rate / inertia;
  const btVector3 correction =
      (rate.cross(omega) + momentum.cross(a)) + 2.0 * inertia * omega.cross(a) + 3.0 * a.cross(momentum);
  return turned(0.5 * h * omega, momentum - h * h / 24.0 * correction);
}

bool mean_velocity(const btVector3& momentum, const btVector3& inertia, double h, btVector3& omega) {
  btVector3 found = omega;
  const double size = momentum.length();
  double error = SIMD_INFINITY;
  for (int i = 0; i < kMaxIterations; ++i) {
    const btVector3 residual = momentum - momentum_before(found, inertia, h);
    const double last = error;
    error = residual.length();
    if (error <= kPrecision * size || (error >= last && error <= kAcceptable * size)) break;
    if (!(error < 1e3 * size)) return false;
    // Derivative of exp(h/2 omega) I omega to first order in h.
    const btMatrix3x3 own(inertia.x(), 0.0, 0.0, 0.0, inertia.y(), 0.0, 0.0, 0.0, inertia.z());
    const btMatrix3x3 slope = own + (cross_matrix(found) * own - cross_matrix(inertia * found)) * (0.5 * h);
    found += slope.inverse() * residual;
  }
  if (!(error <= kAcceptable * size)) return false;
  omega = found;
  return true;
}

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

void begin_motion(BodyData& body, double h) {
  btRigidBody& rigid = body.rigid;
  body.falls_by = falls_by(body);
  const btVector3 kick = body.falls_by * h;
  const btVector3 linear = rigid.getLinearVelocity();
  rigid.setLinearVelocity(body.instant_twist ? (linear + 0.5 * kick) * std::sqrt(body.linear_retained) - kick
                                             : linear * body.linear_retained);
  const Impulse expected = expected_of_joints(body, h);
  body.pushed_by_joint = false;
  // What taut joints stiffen is as inert as they need, and so turns by no law of its own.
  body.round = body.stiffened || is_round(body.inertia) || h * rigid.getAngularVelocity().length() < kNoRotation;
  if (body.round) {
    const double retained = body.instant_twist ? std::sqrt(body.angular_retained) : body.angular_retained;
    rigid.setAngularVelocity(rigid.getAngularVelocity() * retained);
    body.mean_turn = rigid.getAngularVelocity() + rigid.getInvInertiaTensorWorld() * expected.angular;
  } else {
    begin_turning(body, expected.angular, h);
  }
  body.start_linear = rigid.getLinearVelocity();
  body.start_angular = rigid.getAngularVelocity();
  if (body.joints.empty()) return;
  body.mean_linear =
      body.start_linear + rigid.getGravity() * h + (rigid.getTotalForce() * h + expected.linear) * rigid.getInvMass();
  body.next_pose = moved(rigid.getWorldTransform(), body.mean_linear, body.mean_turn, h);
}

btVector3 mean_turn_after(const BodyData& body, const btVector3& angular, double h) {
  if (!body.begun || body.round || body.joints.empty() || !body.slow_turn) return angular;
  // Efforts that joints applied since are not in the momentum yet: they count as impulses.
  const btVector3 in_momentum = body.rigid.getInvInertiaTensorWorld() * body.start_torque * h;
  return turn_of_impulses(body, angular - body.start_angular - in_momentum, h);
}

void end_motion(BodyData& body, double h, double share) {
  btRigidBody& rigid = body.rigid;
  const btVector3 linear = rigid.getLinearVelocity(), angular = rigid.getAngularVelocity();
  const btVector3 by_force = rigid.getTotalForce() * rigid.getInvMass() * h;
  const btVector3 by_torque = rigid.getInvInertiaTensorWorld() * rigid.getTotalTorque() * h;
  if (body.begun) {
    body.instant_twist = !body.pushed_by_joint && !body.supported && same(linear, body.start_linear + by_force) &&
                         same(angular, body.start_angular + by_torque);
  }
  body.supported = false;
  btVector3 turn = angular;
  if (body.begun && !body.instant_twist) {
    turn = mean_turn_after(body, angular, h);
    rigid.setAngularVelocity(turn);
  }
  const btTransform next = moved(rigid.getWorldTransform(), linear * share, turn, h);
  rigid.setWorldTransform(next);
  rigid.setInterpolationWorldTransform(next);
  rigid.updateInertiaTensor();
  if (!body.instant_twist || !body.begun) return;
  rigid.setLinearVelocity(linear * std::sqrt(body.linear_retained) + 0.5 * h * body.falls_by);
  const btVector3 turning = body.round ? angular : rigid.getInvInertiaTensorWorld() * body.angular_momentum;
  rigid.setAngularVelocity(turning * std::sqrt(body.angular_retained));
}

}  // namespace ambf::physics::detail
