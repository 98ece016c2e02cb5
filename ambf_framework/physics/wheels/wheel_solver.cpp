#include "physics/wheels/detail/wheel_solver.h"

#include <algorithm>
#include <cmath>

namespace ambf::physics {

namespace {

constexpr int kMaxSweeps = 64;
constexpr double kPrecision = 1e-9;  // m/s, at which sweeps end

}  // namespace

namespace detail {

WheelRow::WheelRow(const btVector3& along, const btVector3& lever, const WheelMover& chassis, const btVector3& point,
                   const WheelMover* ground)
    : direction(along),
      turn(lever.cross(along)),
      change(chassis.body->rigid.getInvInertiaTensorWorld() * turn),
      mobility(chassis.body->rigid.getInvMass() + change.dot(turn)) {
  if (ground == nullptr) return;
  const btRigidBody& rigid = ground->body->rigid;
  turn_ground = (point - rigid.getWorldTransform().getOrigin()).cross(along);
  change_ground = rigid.getInvInertiaTensorWorld() * turn_ground;
  mobility += rigid.getInvMass() + change_ground.dot(turn_ground);
}

WheelSpring WheelSpring::of_tyre(double stretch, double leak, double mass, double h) {
  const double k = mass * kTyreFrequency * kTyreFrequency, d = 2.0 * mass * kTyreFrequency;
  return {h * ((k + d / h) / (1.0 + leak) - d / h) * stretch, h * (h * k + d) / (1.0 + leak), leak};
}

double stretch_for(double impulse, double speed, double leak, double mass, double h) {
  return -impulse * (1.0 + leak) / (h * mass * kTyreFrequency * kTyreFrequency) - h * speed;
}

}  // namespace detail

std::size_t Wheels::Solver::ground(const detail::BodyData& body) {
  if (body.is_static()) return kStill;
  for (std::size_t i = 0; i < grounds.size(); ++i)
    if (grounds[i].body == &body) return i;
  grounds.push_back({&body, body.rigid.getLinearVelocity(), body.rigid.getAngularVelocity()});
  return grounds.size() - 1;
}

void Wheels::Solver::solve() {
  for (int i = 0; i < kMaxSweeps && sweep() > kPrecision; ++i) {
  }
}

double Wheels::Solver::set(detail::WheelRow& row, detail::WheelMover* below, double impulse) {
  const double added = impulse - row.impulse;
  chassis.push(row.direction, row.change, added);
  if (below != nullptr) below->push(-row.direction, -row.change_ground, added);
  row.impulse = impulse;
  return std::abs(added) * row.mobility;
}

// Returns the largest change of a speed.
double Wheels::Solver::sweep() {
  double most = 0.0;
  for (Contact& contact : contacts) {
    detail::WheelMover* below = ground_of(contact);
    detail::WheelRow &normal = contact.normal, &forward = contact.forward, &side = contact.side;
    const auto without = [&](const detail::WheelRow& row, double of_ground) {
      return row.speed(chassis, below) - of_ground - row.mobility * row.impulse;
    };
    const double pressed = contact.suspension.impulse(without(normal, contact.normal_speed), normal.mobility);
    most = std::max(most, set(normal, below, std::max(0.0, pressed)));
    const double rolling = without(forward, contact.forward_speed) + forward.mobility * contact.drive;
    const double held = contact.rolling.impulse(rolling, forward.mobility);
    const double braked = std::clamp(held, -contact.brake, contact.brake);
    contact.brake_slips = braked != held;
    double along = contact.drive + braked;
    double across = contact.tyre.impulse(without(side, contact.side_speed), side.mobility);
    const double asked = std::hypot(along, across), grip = contact.friction * normal.impulse;
    contact.slips = asked > grip;
    if (contact.slips) along *= grip / asked, across *= grip / asked;
    most = std::max(most, set(forward, below, along));
    most = std::max(most, set(side, below, across));
  }
  return most;
}

}  // namespace ambf::physics
