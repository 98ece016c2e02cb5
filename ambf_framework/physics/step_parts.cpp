// The part of WorldData for steps that are too long for what turns in them. Joints know of the paths of their pivots up
// to about half a radian a step (joints/fast_turns.cpp), those of balls and cones up to 0.15 (joints/joint_rows.cpp); a
// link that a kilonewton throws about turns by more than one, and its pivots ended centimetres apart. Where the solved
// step would do so, or where joints of fast bodies are still wrong when all rounds of solving are over (a wrist of a
// few grams that a shaft presses on a table with 400 N, and that spins between its limits), it is taken again from its
// start in up to kMaxParts parts: commands, forces and the world's time know nothing of it. What turns less keeps its
// bits. Where parts make it wilder (an old robot's links of kilograms on a base of a gram, loaded beyond their limits),
// it is taken as a whole after all. Physics thread.
#include <algorithm>
#include <cmath>

#include "physics/detail/world_data.h"

namespace ambf::physics::detail {
namespace {

// Turns in rad: too far for a step, and what a part shall have.
struct Turns {
  double too_far, of_part;
};
constexpr Turns kOfAxes{0.5, 0.2}, kOfBalls{0.15, 0.1};
constexpr int kMaxParts = 8;
constexpr double kMaxBentError = 2e-4;  // m or rad
constexpr int kPartsOfBent = 4;
constexpr double kWilder = 2.0;      // times the kinetic energy of the step that was solved as a whole
constexpr double kMaxBeside = 1e-4;  // m that a pivot may end beside its path: what turns about its pivot never does

// Into how many parts a step shall go in which a body turns by `turn` (rad, world axes). The pivot of a joint at the
// lever r would end |r_perp| a^2 / 2 beside a straight path, at the turn a.
int parts_for(const BodyData& body, const btVector3& turn) {
  const double angle = turn.length();
  int parts = 1;
  for (const JointData* joint : body.joints) {
    const bool ball = joint->freedom == Freedom::ball || joint->freedom == Freedom::cone;
    const Turns& turns = ball ? kOfBalls : kOfAxes;
    if (angle <= turns.too_far || !joint->constraint.isEnabled() || joint->freedom == Freedom::six) continue;
    const btVector3& lever = (&joint->parent == &body ? joint->frame_a : joint->frame_b).getOrigin();
    const btVector3 path = turn.cross(body.rigid.getWorldTransform().getBasis() * lever);
    if (0.5 * angle * path.length() <= kMaxBeside) continue;
    parts = std::max(parts, static_cast<int>(std::min(std::ceil(angle / turns.of_part), 1.0 * kMaxParts)));
  }
  return parts;
}

}  // namespace

void WorldData::remember_start() {
  bent_error = 0.0;
  if (!dynamics->own_motion() || (joints.empty() && holding.empty())) return;
  for (BodyData* body : bodies) {
    if (body->is_static()) continue;
    body->step_pose = body->rigid.getWorldTransform();
    body->step_linear = body->rigid.getLinearVelocity();
    body->step_angular = body->rigid.getAngularVelocity();
    body->step_force = body->rigid.getTotalForce();
    body->step_torque = body->rigid.getTotalTorque();
  }
}

int WorldData::parts_needed() const {
  if (!dynamics->own_motion()) return 1;
  int parts = bent_error > kMaxBentError ? kPartsOfBent : 1;
  for (const BodyData* body : bodies) {
    if (body->joints.empty() || body->is_static() || body->asleep()) continue;
    const btVector3 turn = body->rigid.getAngularVelocity() * h;
    if (turn.length2() > kOfBalls.too_far * kOfBalls.too_far) parts = std::max(parts, parts_for(*body, turn));
  }
  return parts;
}

double WorldData::kinetic_energy() const {
  double twice = 0.0;
  for (const BodyData* body : bodies) {
    if (body->is_static()) continue;
    const btRigidBody& rigid = body->rigid;
    const btVector3 turn = rigid.getAngularVelocity() * rigid.getWorldTransform().getBasis();  // body axes
    const btVector3& inverse = rigid.getInvInertiaDiagLocal();
    if (rigid.getInvMass() > 0.0) twice += rigid.getLinearVelocity().length2() / rigid.getInvMass();
    for (int i = 0; i < 3; ++i)
      if (inverse[i] > 0.0) twice += turn[i] * turn[i] / inverse[i];
  }
  return 0.5 * twice;
}

// What contacts gave in the last step is where they start from in a part of one, and the other way round.
void WorldData::set_part(double share) {
  if (share == part) return;
  const double ratio = share / part;
  for (int i = 0; i < dispatcher->getNumManifolds(); ++i) {
    btPersistentManifold& manifold = *dispatcher->getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      btManifoldPoint& point = manifold.getContactPoint(k);
      point.m_appliedImpulse *= ratio;
      point.m_appliedImpulseLateral1 *= ratio;
      point.m_appliedImpulseLateral2 *= ratio;
    }
  }
  part = share;
  h = options.step * share;
  for (BodyData* body : bodies) set_damping(*body);
}

void WorldData::return_to_start() {
  for (BodyData* body : bodies) {
    if (body->is_static()) continue;
    btRigidBody& rigid = body->rigid;
    rigid.setWorldTransform(body->step_pose);  // what is deep was pushed
    rigid.setInterpolationWorldTransform(body->step_pose);
    rigid.updateInertiaTensor();
    rigid.setLinearVelocity(body->step_linear);
    rigid.setAngularVelocity(body->step_angular);
  }
}

void WorldData::solve_parts(int parts, PhaseSums* times) {
  set_part(1.0 / parts);
  for (int i = 0; i < parts; ++i) {
    for (BodyData* body : bodies) {  // gravity and joints have added theirs
      if (body->is_static()) continue;
      body->rigid.clearForces();
      body->rigid.applyCentralForce(body->step_force);
      body->rigid.applyTorque(body->step_torque);
    }
    solve(times);
    if (i + 1 < parts) dynamics->move(h, options.sleeping, times);
  }
  if (times != nullptr) times->steps -= parts - 1;
}

// All but the motion of the last part.
void WorldData::solve_in_parts(int parts, PhaseSums* times) {
  const double as_a_whole = kinetic_energy();
  return_to_start();
  solve_parts(parts, times);
  if (kinetic_energy() <= kWilder * as_a_whole) return;  // false for what is not finite
  return_to_start();
  solve_parts(1, times);
}

}  // namespace ambf::physics::detail
