#include "tests/physics/random_scene.h"

#include <algorithm>

namespace ambf::physics::testing {

namespace {

constexpr int kBodies = 10;
constexpr double kGravity = 9.8;  // m/s^2

WorldOptions options(double h) {
  WorldOptions result;
  result.step = h;
  result.gravity = {0.0, 0.0, -kGravity};
  result.sleeping = false;
  return result;
}

double logarithmic(Random& random, double low, double high) { return low * std::pow(high / low, random(0.0, 1.0)); }

}  // namespace

// A row of bodies above a floor, some of them chained to each other or to the world, some of them loose.
RandomScene::RandomScene(unsigned seed, double h) : h_(h), world_(options(h)) {
  Random random(seed);
  const bool floor = random(0.0, 1.0) < 0.5;
  const double spin = logarithmic(random, 0.5, 500.0), share_of_joints = random(0.0, 1.0);
  const double restitution = random(0.0, 1.0) < 0.5 ? 0.0 : random(0.0, 1.0);
  datum_ = floor ? -0.1 : -200.0;
  bodies_.push_back(std::make_unique<Body>(floor ? parameters(0.0, {ground()}, {}) : mass_only(0.0, {})));
  world_.add(*bodies_.back());
  for (int i = 0; i < kBodies; ++i) {
    const math::Vec3 size{logarithmic(random, 0.02, 0.3), logarithmic(random, 0.02, 0.3),
                          logarithmic(random, 0.02, 0.3)};
    const bool round = random(0.0, 1.0) < 0.3;
    BodyDefinition definition =
        parameters(logarithmic(random, 0.01, 10.0), {round ? sphere(0.5 * size.x) : box(size.x, size.y, size.z)},
                   {0.6 * i, random(-0.1, 0.1), random(0.4, 1.0)});
    definition.T_world_body.orientation = random.rotation();
    definition.surface.linear_damping = definition.surface.angular_damping = 0.0;
    definition.surface.rolling_friction = 0.0;
    definition.surface.friction = random(0.0, 1.0);
    definition.surface.restitution = restitution;
    bodies_.push_back(std::make_unique<Body>(definition));
    Body& body = *bodies_.back();
    world_.add(body);
    body.set_twist({random.vector(2.0), random.unit() * random(0.0, spin)});
    if (random(0.0, 1.0) > share_of_joints) continue;
    const bool to_world = random(0.0, 1.0) < 0.3;
    Body& parent = to_world ? *bodies_.front() : *bodies_[bodies_.size() - 2];
    if (to_world && floor) continue;
    const math::Vec3 pivot =
        to_world ? body.pose().position + random.vector(0.2) : 0.5 * (body.pose().position + parent.pose().position);
    constexpr state::JointType kKinds[] = {state::JointType::p2p, state::JointType::revolute,
                                           state::JointType::prismatic, state::JointType::fixed};
    scene::Joint joint;
    joint.type = kKinds[static_cast<int>(random(0.0, 3.999))];
    const auto local = [&](const Body& of, const math::Vec3& v) {
      return math::rotate(math::inverse(of.pose().orientation), v);
    };
    const math::Vec3 axis = random.unit();
    joint.parent_pivot = local(parent, pivot - parent.pose().position);
    joint.child_pivot = local(body, pivot - body.pose().position);
    joint.parent_axis = local(parent, axis);
    joint.child_axis = local(body, axis);
    // The pose as it is becomes coordinate 0.
    Joint as_it_is(joint, parent, body);
    const math::Quat wanted = math::inverse(parent.pose().orientation) * body.pose().orientation;
    const math::Quat turn = wanted * math::inverse(as_it_is.child_pose_in_parent(0.0).orientation);
    joint.child_offset = math::dot(math::log(turn), math::normalized(joint.parent_axis));
    joint.ignore_inter_collision = true;
    joint.max_motor_impulse = 0.01 * std::min(body.mass(), parent.is_static() ? body.mass() : parent.mass());
    joints_.push_back(std::make_unique<Joint>(joint, parent, body));
    world_.add(*joints_.back());
    if (joints_.back()->has_coordinate() && random(0.0, 1.0) < 0.3)
      joints_.back()->set_motor_velocity(random(-5.0, 5.0));
  }
}

RandomScene::~RandomScene() {
  for (auto& joint : joints_) world_.remove(*joint);
  joints_.clear();
}

double RandomScene::energy() const {
  double sum = 0.0;
  for (const auto& body : bodies_) {
    if (body->is_static()) continue;
    const math::Twist twist = body->twist();
    const math::Vec3 local = math::rotate(math::inverse(body->com_pose().orientation), twist.angular);
    sum += 0.5 * body->mass() * math::dot(twist.linear, twist.linear) +
           0.5 * math::dot(local, math::scaled(local, body->inertia())) +
           body->mass() * kGravity * (body->com_pose().position.z - datum_);
  }
  return sum;
}

RandomScene::Result RandomScene::run(double seconds) {
  Result result;
  world_.step();  // bodies set in motion one by one come to what their joints allow
  double allowed = energy();
  for (int i = static_cast<int>(std::lround(seconds / h_)); i > 0; --i) {
    world_.step();
    for (const auto& joint : joints_) {
      if (joint->has_coordinate()) allowed += std::max(0.0, joint->effort() * joint->velocity() * h_);
      result.gap = std::max(result.gap, joint->gap().position);
    }
    const double now = energy();
    if (!std::isfinite(now)) {
      result.finite = false;
      return result;
    }
    result.gain = std::max(result.gain, now / allowed - 1.0);
  }
  return result;
}

}  // namespace ambf::physics::testing
