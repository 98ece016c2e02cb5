#include "model/detail/command_bounds.h"

#include <algorithm>
#include <cmath>

#include "base/limits.h"
#include "math/rotation.h"

namespace ambf::model {
namespace {

constexpr double kMaxSpeed = base::kMaxCommandedSpeed;

// The largest s in [0, 1] for which v + s change is no faster than the bound, or than v where that is faster already.
double share(const math::Vec3& v, const math::Vec3& change) {
  const double limit = std::max(kMaxSpeed * kMaxSpeed, math::dot(v, v));
  const math::Vec3 after = v + change;
  if (math::dot(after, after) <= limit) return 1.0;
  // |v + s change|^2 = limit.
  const double a = math::dot(change, change), b = math::dot(v, change), c = math::dot(v, v) - limit;
  return std::clamp((std::sqrt(std::max(0.0, b * b - a * c)) - b) / a, 0.0, 1.0);
}

// What a torque impulse changes of the angular velocity, world axes.
math::Vec3 turned_by(const physics::Body& body, const math::Vec3& impulse_world) {
  const math::Quat R_world_com = body.com_pose().orientation;
  const math::Vec3 inertia = body.inertia();
  const math::Vec3 impulse = math::rotate(math::inverse(R_world_com), impulse_world);
  return math::rotate(R_world_com, {impulse.x / inertia.x, impulse.y / inertia.y, impulse.z / inertia.z});
}

bool shifts(const physics::Joint& joint) {
  return joint.type() == state::JointType::prismatic || joint.type() == state::JointType::linear_spring;
}

double max_of(const math::Vec3& v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

math::Wrench CommandBound::wrench(const math::Wrench& wrench_world) {
  const physics::Body& body = *live_.body;
  const math::Twist twist = body.twist();
  const Mechanism& mechanism = live_.mechanism;
  const double of_force = share(twist.linear, wrench_world.force * (h_s_ / mechanism.mass));
  const math::Vec3 turn = mechanism.bodies > 1 ? wrench_world.torque * (h_s_ / mechanism.inertia)
                                               : turned_by(body, wrench_world.torque * h_s_);
  const double of_torque = share(twist.angular, turn);
  if (of_force == 1.0 && of_torque == 1.0) return wrench_world;
  cut_ = true;
  return {wrench_world.force * of_force, wrench_world.torque * of_torque};
}

math::Vec3 CommandBound::velocity(const math::Vec3& velocity_world) {
  const double speed = math::norm(velocity_world);
  if (speed <= kMaxSpeed) return velocity_world;
  cut_ = true;
  return velocity_world * (kMaxSpeed / speed);
}

// The inertia of a mechanism is an upper bound: what a light link can bear that is joined to heavy ones is not known
// without solving all joints.
double CommandBound::inertia_about(const physics::Joint& joint) const {
  const Mechanism& mechanism = live_.mechanism;
  if (mechanism.bodies == 1) return joint.effective_inertia();
  return shifts(joint) ? mechanism.mass : mechanism.inertia;
}

double CommandBound::effort(const physics::Joint& joint, double effort) {
  const math::Twist twist = live_.body->twist();
  const math::Vec3& speed = shifts(joint) ? twist.linear : twist.angular;
  const double inertia = inertia_about(joint);
  // A slow body is as good as one at rest.
  const bool slow = math::dot(speed, speed) < 0.25 * kMaxSpeed * kMaxSpeed;
  if (slow && std::abs(effort) * h_s_ <= 0.5 * kMaxSpeed * inertia) return effort;
  const double of_effort = share({joint.velocity(), 0, 0}, {effort * h_s_ / inertia, 0, 0});
  if (of_effort == 1.0) return effort;
  cut_ = true;
  return of_effort * effort;
}

double CommandBound::rate(double rate) {
  if (std::abs(rate) <= kMaxSpeed) return rate;
  cut_ = true;
  return std::clamp(rate, -kMaxSpeed, kMaxSpeed);
}

// The servo is implicit: it asks for a speed of gain * value / servo_gain, and never pulls with more than gain * value.
double CommandBound::servo_input(const physics::Joint& joint, double value, double gain, double servo_gain) {
  const double pull = gain * std::abs(value);
  if (pull <= kMaxSpeed * servo_gain) return value;
  const double room = kMaxSpeed - std::copysign(1.0, value) * joint.velocity();  // up to the bound of the speed
  const double most = std::max(kMaxSpeed * servo_gain, inertia_about(joint) / h_s_ * room);
  if (pull <= most) return value;
  cut_ = true;
  return std::copysign(most / gain, value);
}

void weigh_mechanisms(const TypedTable<LiveBody>& bodies, const state::Structure& structure) {
  const auto root_of = [&](std::uint32_t slot) {
    while (bodies[slot].mechanism.root != slot)
      slot = bodies[slot].mechanism.root = bodies[bodies[slot].mechanism.root].mechanism.root;
    return slot;
  };
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    bodies[slot].mechanism = {};
    bodies[slot].mechanism.root = slot;
  }
  for (const state::JointInfo& joint : structure.joints)
    if (!bodies[joint.parent_body].body->is_static() && !bodies[joint.child_body].body->is_static())
      bodies[root_of(joint.parent_body)].mechanism.root = root_of(joint.child_body);
  const auto each = [&](auto visit) {
    for (std::uint32_t slot = 0; slot < bodies.size(); ++slot)
      if (!bodies[slot].body->is_static()) visit(*bodies[slot].body, bodies[root_of(slot)].mechanism);
  };
  each([](const physics::Body& body, Mechanism& whole) {
    ++whole.bodies;
    whole.mass += body.mass();
    whole.first_moment += body.initial_com_pose().position * body.mass();
  });
  // Steiner; every axis through the centre.
  each([](const physics::Body& body, Mechanism& whole) {
    const math::Vec3 arm = body.initial_com_pose().position - whole.first_moment * (1.0 / whole.mass);
    whole.inertia += max_of(body.inertia()) + body.mass() * math::dot(arm, arm);
  });
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    const std::uint32_t root = root_of(slot);
    if (root == slot) continue;
    bodies[slot].mechanism = bodies[root].mechanism;
  }
}

}  // namespace ambf::model
