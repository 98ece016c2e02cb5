// Impacts and friction: cases of accuracy_benchmark.cpp with closed forms.
#include <algorithm>
#include <array>

#include "tests/benchmarks/accuracy_cases.h"

namespace ambf::accuracy {

using namespace physics;
using namespace physics::testing;

namespace {

constexpr double kGravity = 9.8;  // m/s^2

struct Cradle {
  static constexpr int kBalls = 5;
  static constexpr double kRadius = 0.05, kLength = 1.0;  // m

  explicit Cradle(double h) : world(options(h, {0.0, 0.0, -kGravity})), frame(mass_only(0.0, {})) {
    world.add(frame);
    for (int i = 0; i < kBalls; ++i) {
      const double x = 2.0 * kRadius * i;
      BodyDefinition definition = parameters(1.0, {sphere(kRadius)}, {x, 0.0, -kLength});
      if (i == 0)
        definition.T_world_body = {{x - kLength, 0.0, 0.0}, math::from_axis_angle({0.0, 1.0, 0.0}, 0.5 * kPi)};
      definition.surface = {0.0, 0.0, 1.0, 0.0, 0.0};
      balls.push_back(std::make_unique<Body>(definition));
      world.add(*balls.back());
      hinges.push_back(std::make_unique<Joint>(joint_of(state::JointType::revolute, {x, 0.0, 0.0}, {0.0, 0.0, kLength}),
                                               frame, *balls.back()));
      world.add(*hinges.back());
    }
  }
  ~Cradle() {
    for (auto& hinge : hinges) world.remove(*hinge);
  }
  double energy() const {
    double sum = 0.0;
    for (const auto& ball : balls) sum += energy_of(*ball, kGravity) + ball->mass() * kGravity * kLength;
    return sum;
  }

  World world;
  Body frame;
  std::vector<std::unique_ptr<Body>> balls;
  std::vector<std::unique_ptr<Joint>> hinges;
};

// A cube between two pads on sliders, each pressed on by `force` (N).
struct Grip {
  Grip(double h, double friction, double cube_mass, double force)
      : world(options(h, {0.0, 0.0, -kGravity})), frame(mass_only(0.0, {})), cube([&] {
          BodyDefinition definition = parameters(cube_mass, {box(0.05, 0.05, 0.05)}, {});
          definition.surface = {friction, 0.0, 0.0, 0.0, 0.0};
          return definition;
        }()) {
    world.add(frame);
    world.add(cube);
    for (const double side : {-1.0, 1.0}) {
      BodyDefinition definition = parameters(0.1, {box(0.02, 0.1, 2.0)}, {0.035 * side, 0.0, 0.0});
      definition.surface = {1.0, 0.0, 0.0, 0.0, 0.0};
      definition.gravity = math::Vec3{};
      pads.push_back(std::make_unique<Body>(definition));
      world.add(*pads.back());
      sliders.push_back(std::make_unique<Joint>(
          joint_of(state::JointType::prismatic, {0.035 * side, 0.0, 0.0}, {}, {1.0, 0.0, 0.0}), frame, *pads.back()));
      world.add(*sliders.back());
      sliders.back()->set_effort(-side * force);
    }
  }
  ~Grip() {
    for (auto& slider : sliders) world.remove(*slider);
  }

  World world;
  Body frame, cube;
  std::vector<std::unique_ptr<Body>> pads;
  std::vector<std::unique_ptr<Joint>> sliders;
};

constexpr double kPressed = 6.96;  // N
constexpr double kCubeMass = 0.1;  // kg

}  // namespace

Figures cradle(double h) {
  Cradle cradle(h);
  const double energy = cradle.energy();
  std::array<double, Cradle::kBalls> highest{};
  const double quarter =
      2.0 * kPi * std::sqrt(Cradle::kLength / kGravity) * 1.18 / 4.0;  // of a period, let go at 90 degrees
  run(cradle.world, 1.05 * quarter);
  for (int i = steps_in(1.2 * quarter, h); i > 0; --i) {
    cradle.world.step();
    for (int ball = 0; ball < Cradle::kBalls; ++ball) {
      const math::Vec3 at = cradle.balls[static_cast<std::size_t>(ball)]->pose().position -
                            math::Vec3{2.0 * Cradle::kRadius * ball, 0.0, 0.0};
      double& most = highest[static_cast<std::size_t>(ball)];
      most = std::max(most, std::abs(std::atan2(at.x, -at.z)) * 180.0 / kPi);
    }
  }
  run(cradle.world, 8.6 * 2.0 * quarter);
  Figures figures;
  for (int ball = 0; ball < Cradle::kBalls; ++ball)
    figures.push_back({"ball " + std::to_string(ball + 1) + ", degrees", highest[static_cast<std::size_t>(ball)]});
  figures.push_back({"energy in 10 swings", cradle.energy() / energy - 1.0});
  return figures;
}

Figures sliding_cube(double h) {
  const double friction = 0.05;
  Grip grip(h, friction, kCubeMass, kPressed);
  run(grip.world, 0.1);
  const double before = grip.cube.twist().linear.z;
  run(grip.world, 0.3);
  const double slowed = kGravity + (grip.cube.twist().linear.z - before) / 0.3;
  const double turned = math::norm(math::log(grip.cube.pose().orientation));
  return {{"friction short, share", 1.0 - slowed * kCubeMass / (2.0 * friction * kPressed)}, {"turned, rad", turned}};
}

Figures held_cube(double h) {
  Figures figures;
  for (const double share : {1.0, 0.995}) {
    Grip grip(h, share * kCubeMass * kGravity / (2.0 * kPressed), kCubeMass, kPressed);
    run(grip.world, 5.0);
    figures.push_back({"fallen at " + std::to_string(share).substr(0, 5) + ", m", -grip.cube.pose().position.z});
  }
  return figures;
}

}  // namespace ambf::accuracy
