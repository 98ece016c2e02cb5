// Worlds of bodies made of triangle meshes, for tests.
#pragma once

#include <ctime>
#include <memory>
#include <vector>

#include "tests/physics/fixtures.h"
#include "tests/physics/meshes.h"

namespace ambf::physics::testing {

inline constexpr double kMargin = 0.001;  // m, of every mesh here

inline BodyDefinition mesh_body(double mass, const TestMesh& mesh, const math::Vec3& at, const math::Quat& turn = {}) {
  BodyDefinition p;
  p.mass = mass;
  p.T_world_body = {at, turn};
  ShapeOptions options;
  options.margin = kMargin;
  options.moving = mass > 0.0;
  p.shape = mesh.shape(options);
  return p;
}

inline WorldOptions awake() {
  WorldOptions options;
  options.sleeping = false;
  return options;
}

// A world of bodies made from parameters.
struct Scene {
  explicit Scene(const std::vector<BodyDefinition>& all, const WorldOptions& options = awake()) : world(options) {
    for (const BodyDefinition& p : all) {
      bodies.push_back(std::make_unique<Body>(p));
      world.add(*bodies.back());
    }
  }
  Body& operator[](std::size_t i) { return *bodies[i]; }
  ~Scene() {
    for (auto& body : bodies) world.remove(*body);
  }
  World world;
  std::vector<std::unique_ptr<Body>> bodies;
};

inline double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace ambf::physics::testing
