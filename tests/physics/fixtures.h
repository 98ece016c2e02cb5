// Small helpers for tests of physics/: bodies and joints in a line each.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "math/rotation.h"
#include "physics/body.h"
#include "physics/joint.h"
#include "physics/shape.h"
#include "physics/world.h"

namespace ambf::physics::testing {

// For names of tests.
inline std::string name_of(SolverKind solver) {
  return solver == SolverKind::direct ? "direct" : solver == SolverKind::si ? "si" : "mlcp";
}

inline constexpr double kPi = std::numbers::pi;

inline scene::PlacedGeometry box(double x, double y, double z, const math::Pose& offset = {}) {
  scene::PlacedGeometry part;
  part.geometry.shape = scene::Shape::box;
  part.geometry.size = {x, y, z};
  part.offset = offset;
  return part;
}

inline scene::PlacedGeometry sphere(double radius, const math::Pose& offset = {}) {
  scene::PlacedGeometry part;
  part.geometry.shape = scene::Shape::sphere;
  part.geometry.radius = radius;
  part.offset = offset;
  return part;
}

inline scene::PlacedGeometry ground(double height = 0.0) {
  scene::PlacedGeometry part;
  part.geometry.shape = scene::Shape::plane;
  part.geometry.offset = height;
  return part;
}

inline BodyDefinition parameters(double mass, const std::vector<scene::PlacedGeometry>& parts, const math::Vec3& at) {
  BodyDefinition p;
  p.mass = mass;
  p.T_world_body.position = at;
  ShapeOptions options;
  options.moving = mass > 0.0;
  p.shape = make_shape(parts, options);
  return p;
}

// No shape, no damping: only mass and inertia.
inline BodyDefinition mass_only(double mass, const math::Vec3& inertia, const math::Pose& at = {}) {
  BodyDefinition p;
  p.mass = mass;
  p.inertia = inertia;
  p.T_world_body = at;
  p.surface.linear_damping = p.surface.angular_damping = 0.0;
  return p;
}

struct Random {
  explicit Random(unsigned seed) : engine(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  math::Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  math::Vec3 unit() {
    for (;;) {
      const math::Vec3 v = vector(1.0);
      if (math::norm(v) > 0.1 && math::norm(v) < 1.0) return math::normalized(v);
    }
  }
  math::Quat rotation() { return math::exp(unit() * (*this)(0.0, 3.0)); }
  math::Pose pose(double size) { return {vector(size), rotation()}; }
  std::mt19937 engine;
};

inline double angle_between(const math::Quat& a, const math::Quat& b) {
  return math::norm(math::log(math::inverse(a) * b));
}

// Momentum of free bodies about the world's origin.
struct Momentum {
  math::Vec3 linear, angular;
};
inline Momentum momentum(const std::vector<const Body*>& bodies) {
  Momentum sum;
  for (const Body* body : bodies) {
    const math::Pose com = body->com_pose();
    const math::Twist twist = body->twist();
    const math::Vec3 p = twist.linear * body->mass();
    const math::Vec3 local = math::rotate(math::inverse(com.orientation), twist.angular);
    sum.linear += p;
    sum.angular += math::cross(com.position, p) + math::rotate(com.orientation, math::scaled(local, body->inertia()));
  }
  return sum;
}

inline void run(World& world, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / world.options().step));
  for (int i = 0; i < steps; ++i) world.step();
}

}  // namespace ambf::physics::testing
