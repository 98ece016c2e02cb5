#include "physics/wheels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/rotation.h"
#include "physics/detail/world_data.h"
#include "physics/mounted_bodies.h"
#include "physics/wheels/detail/wheel_solver.h"

namespace ambf::physics {

using detail::BodyData;
using detail::from_bullet;
using detail::to_bullet;
using detail::WheelMover;
using detail::WheelRow;
using detail::WheelSpring;

namespace {

// As Bullet has it: a suspension that leans by more than this cosine to the ground's normal counts as leaning by it.
constexpr double kMinUpright = 0.1;
// Sideways force of a rolling tyre by the angle between its heading and its way and by its load.
constexpr double kCorneringStiffness = 15.0;  // 1/rad
constexpr double kMinLoad = 1e-6;             // N

btVector3 velocity_at(const btVector3& linear, const btVector3& angular, const btVector3& lever) {
  return linear + angular.cross(lever);
}

// What wheels roll on: what their chassis would collide with. Inside of it they are pushed out.
BundleFilter ground_below(const Body& chassis) {
  BundleFilter filter;
  filter.ignored = &chassis;
  filter.as_it_collides = filter.as_if_solid = filter.from_inside = true;
  return filter;
}

// Of the ground where a wheel stands. Static bodies move while they are carried somewhere.
btVector3 ground_velocity(const BodyData& body, const btVector3& point, double h) {
  const btTransform& pose = body.rigid.getWorldTransform();
  btVector3 linear = body.rigid.getLinearVelocity(), angular = body.rigid.getAngularVelocity();
  if (body.moving_to) {
    const btTransform target = to_bullet(body.move_target * body.initial.T_body_com);
    btTransformUtil::calculateVelocity(pose, target, h, linear, angular);
  }
  return velocity_at(linear, angular, point - pose.getOrigin());
}

}  // namespace

Wheels::Wheels(std::vector<Wheel> wheels)
    : wheels_(std::move(wheels)),
      hits_(wheels_.size()),
      orders_(wheels_.size()),
      motions_(wheels_.size()),
      contacts_(wheels_.size()),
      locked_(wheels_.size()),
      solver_(std::make_unique<Solver>()) {
  for (const Wheel& wheel : wheels_)
    rays_.push_back({wheel.connection, wheel.connection + wheel.down * (wheel.rest_length + wheel.radius)});
  solver_->grounds.reserve(wheels_.size());
  solver_->contacts.reserve(wheels_.size());
  reset();
}

Wheels::~Wheels() = default;

void Wheels::forget() {
  bundle_.forget();
  obeyed_ = false;
  std::fill(hits_.begin(), hits_.end(), BundleHit{});
  for (WheelContact& contact : contacts_) contact.ground = nullptr, contact.force = {};
}

void Wheels::reset() {
  forget();
  std::fill(orders_.begin(), orders_.end(), WheelOrder{});
  std::fill(motions_.begin(), motions_.end(), WheelMotion{});
  for (std::size_t i = 0; i < size(); ++i) contacts_[i] = {nullptr, {}, {}, wheels_[i].rest_length, {}};
}

void Wheels::look(const World& world, const Body& chassis) {
  bundle_.cast(world, chassis.com_pose(), rays_, ground_below(chassis), hits_);
  for (std::size_t i = 0; i < size(); ++i) {
    const RayHit& hit = hits_[i];
    const double reach = wheels_[i].rest_length + wheels_[i].radius;
    contacts_[i].ground = orders_[i].present ? hit.body : nullptr;
    contacts_[i].point = hit.point;
    contacts_[i].normal = hit.normal;
    contacts_[i].length = hit.fraction * reach - wheels_[i].radius;
    if (contacts_[i].ground == nullptr) contacts_[i].length = wheels_[i].rest_length;
  }
}

// A chassis that sleeps may go on sleeping: nothing is new, and what it stands on rests, too.
bool Wheels::may_rest(std::span<const WheelOrder> orders, bool changed) const {
  if (changed || !std::equal(orders.begin(), orders.end(), orders_.begin())) return false;
  for (std::size_t i = 0; i < size(); ++i) {
    if (orders[i].drive != 0.0) return false;
    const Body* ground = contacts_[i].ground;
    if (ground != nullptr && !ground->data().is_static() && !ground->asleep()) return false;
  }
  return true;
}

void Wheels::act(const World& world, Body& chassis, std::span<const WheelOrder> orders) {
  const bool changed = bundle_.cast(world, chassis.com_pose(), rays_, ground_below(chassis), hits_) > 0 || !obeyed_;
  const bool rests = chassis.asleep() && may_rest(orders, changed);
  std::copy(orders.begin(), orders.end(), orders_.begin());
  obeyed_ = true;
  for (std::size_t i = 0; i < size(); ++i) motions_[i].steering = orders_[i].steering;
  look(world, chassis);
  for (WheelContact& contact : contacts_)
    if (!rests) contact.force = {};
  if (rests) return;
  if (chassis.asleep()) chassis.wake();

  Solver& solver = *solver_;
  const double h = world.options().step;
  lay_rows(chassis, h);
  if (solver.contacts.empty()) return;
  solver.solve();
  remember(h);

  btVector3 force(0, 0, 0), torque(0, 0, 0);
  for (const Solver::Contact& contact : solver.contacts) {
    btVector3 own(0, 0, 0), below(0, 0, 0);
    for (const WheelRow* row : {&contact.normal, &contact.forward, &contact.side}) {
      own += row->direction * (row->impulse / h);
      torque += row->turn * (row->impulse / h);
      below -= row->turn_ground * (row->impulse / h);
    }
    force += own;
    contacts_[contact.wheel].force = from_bullet(own);
    if (contact.ground != Solver::kStill)
      solver.grounds[contact.ground].body->owner.apply_wrench({from_bullet(-own), from_bullet(below)});
  }
  support(chassis, {from_bullet(force), from_bullet(torque)});
}

void Wheels::lay_rows(const Body& chassis, double h) {
  Solver& solver = *solver_;
  solver.grounds.clear();
  solver.contacts.clear();
  const BodyData& body = chassis.data();
  const btTransform& pose = body.rigid.getWorldTransform();
  const math::Twist expected = expected_twist(chassis);
  solver.chassis = {&body, to_bullet(expected.linear), to_bullet(expected.angular)};
  const auto present = std::count_if(orders_.begin(), orders_.end(), [](const auto& order) { return order.present; });
  const double mass = chassis.mass();
  solver.tyre_mass = mass / static_cast<double>(std::max<std::ptrdiff_t>(1, present));

  for (std::size_t i = 0; i < size(); ++i) {
    WheelMotion& motion = motions_[i];
    if (contacts_[i].ground == nullptr) {
      motion.stretch_forward = motion.stretch_side = 0.0;
      locked_[i] = false;
      continue;
    }
    const Wheel& wheel = wheels_[i];
    const WheelOrder& order = orders_[i];
    const BodyData& ground = contacts_[i].ground->data();
    const btVector3 point = to_bullet(contacts_[i].point), normal = to_bullet(contacts_[i].normal);
    const btVector3 down = pose.getBasis() * to_bullet(wheel.down);
    const btVector3 lever = point - pose.getOrigin();
    Solver::Contact contact;
    contact.wheel = i;
    contact.ground = solver.ground(ground);
    const WheelMover* below = solver.ground_of(contact);

    // Along the suspension: mass (stiffness C - damping v) by how much it leans.
    const btVector3 ground_moves = ground_velocity(ground, point, h);
    const btVector3 slides =
        velocity_at(body.rigid.getLinearVelocity(), body.rigid.getAngularVelocity(), lever) - ground_moves;
    const double lean = 1.0 / std::max(kMinUpright, -normal.dot(down)), approach = slides.dot(normal);
    const double compressed = wheel.rest_length - contacts_[i].length;
    const double damping = approach < 0.0 ? wheel.compression : wheel.relaxation;
    contact.suspension = {-h * mass * lean * wheel.stiffness * compressed,
                          h * mass * lean * (h * lean * wheel.stiffness + damping)};
    contact.normal = WheelRow(normal, lever, solver.chassis, point, below);

    // Across it, forwards and to the side of the axle.
    const btVector3 up = -down;
    btVector3 side = (pose.getBasis() * to_bullet(wheel.axle)).rotate(up, order.steering);
    side -= normal * side.dot(normal);
    if (side.length2() > 1e-12) {
      side.normalize();
      const btVector3 forward = normal.cross(side);
      const double load = std::max(kMinLoad, mass * lean * (wheel.stiffness * compressed - damping * approach));
      const double stiffness = solver.tyre_mass * detail::kTyreFrequency * detail::kTyreFrequency;
      const double leak = h * std::abs(slides.dot(forward)) * stiffness / (kCorneringStiffness * load);
      motion.stretch_side = (motion.stretch_side + h * slides.dot(side)) / (1.0 + leak);
      motion.stretch_forward = order.brake > 0.0 ? motion.stretch_forward + h * slides.dot(forward) : 0.0;
      const btVector3 rolls_by = up * (up.dot(lever) * (1.0 - wheel.roll_influence));
      contact.forward = WheelRow(forward, lever, solver.chassis, point, below);
      contact.side = WheelRow(side, lever - rolls_by, solver.chassis, point, below);
      contact.rolling = WheelSpring::of_tyre(motion.stretch_forward, 0.0, solver.tyre_mass, h);
      contact.tyre = WheelSpring::of_tyre(motion.stretch_side, leak, solver.tyre_mass, h);
      contact.drive = h * order.drive;
      contact.brake = h * order.brake;
      contact.friction = wheel.friction;
    }
    if (below == nullptr) {
      contact.normal_speed = ground_moves.dot(contact.normal.direction);
      contact.forward_speed = ground_moves.dot(contact.forward.direction);
      contact.side_speed = ground_moves.dot(contact.side.direction);
    }
    solver.contacts.push_back(contact);
  }
}

// How far tyres have given way where they slip, and which wheels the brakes hold.
void Wheels::remember(double h) {
  Solver& solver = *solver_;
  for (const Solver::Contact& contact : solver.contacts) {
    WheelMotion& motion = motions_[contact.wheel];
    const WheelMover* below = solver.ground_of(contact);
    const double forward = contact.forward.speed(solver.chassis, below) - contact.forward_speed;
    const double side = contact.side.speed(solver.chassis, below) - contact.side_speed;
    if (contact.slips || contact.brake_slips)
      motion.stretch_forward =
          detail::stretch_for(contact.forward.impulse - contact.drive, forward, 0.0, solver.tyre_mass, h);
    if (contact.slips)
      motion.stretch_side = detail::stretch_for(contact.side.impulse, side, contact.tyre.leak, solver.tyre_mass, h);
    locked_[contact.wheel] = contact.brake > 0.0 && !contact.brake_slips;
  }
}

void Wheels::advance(const World& world, const Body& chassis) {
  look(world, chassis);
  const double h = world.options().step;
  const BodyData& body = chassis.data();
  const btTransform& pose = body.rigid.getWorldTransform();
  for (std::size_t i = 0; i < size(); ++i) {
    WheelMotion& motion = motions_[i];
    if (contacts_[i].ground != nullptr && (locked_[i] || chassis.asleep())) {
      motion.rate = 0.0;
    } else if (contacts_[i].ground != nullptr) {
      const btVector3 point = to_bullet(contacts_[i].point), normal = to_bullet(contacts_[i].normal);
      const btVector3 up = pose.getBasis() * -to_bullet(wheels_[i].down);
      const btVector3 side = (pose.getBasis() * to_bullet(wheels_[i].axle)).rotate(up, orders_[i].steering);
      const btVector3 forward = normal.cross(side);
      const btVector3 slides =
          velocity_at(body.rigid.getLinearVelocity(), body.rigid.getAngularVelocity(), point - pose.getOrigin()) -
          ground_velocity(contacts_[i].ground->data(), point, h);
      const double length = forward.length();
      motion.rate = length > 1e-6 ? slides.dot(forward) / (length * wheels_[i].radius) : 0.0;
    } else if (orders_[i].brake > 0.0) {
      motion.rate = 0.0;
    }
    motion.angle = std::remainder(motion.angle + h * motion.rate, 2.0 * std::numbers::pi);
  }
}

math::Pose Wheels::T_chassis_hub(std::size_t i) const {
  const Wheel& wheel = wheels_[i];
  const math::Quat steered = math::from_axis_angle(-wheel.down, motions_[i].steering);
  return {wheel.connection + wheel.down * contacts_[i].length,
          math::normalized(steered * math::from_axis_angle(-wheel.axle, motions_[i].angle))};
}

}  // namespace ambf::physics
