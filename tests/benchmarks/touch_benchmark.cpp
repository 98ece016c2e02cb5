// What grasps and slopes of resistive sensors hold (dissertation Table 6.2, Fig. 6.9, 6.10), how deep a dropped ball
// dives (Fig. 6.3), and what rays cost by shape. Prints tables; ends with 1 where something does not hold.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "physics/rays.h"
#include "tests/model/resistive.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/meshes.h"

namespace {

using namespace ambf;
using model::test::ResistiveGrasp;
using model::test::ResistiveWorld;

bool all_good = true;
const char* judged(bool good) {
  all_good &= good;
  return good ? "" : " (!)";
}

// A ball of longitudes and half as many latitudes.
physics::testing::TestMesh ball_mesh(double radius, std::uint32_t around) {
  physics::testing::TestMesh mesh;
  const std::uint32_t rings = around / 2;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (std::uint32_t k = 0; k < around; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / around;
      mesh.vertices.push_back({radius * std::sin(polar) * std::cos(angle), radius * std::sin(polar) * std::sin(angle),
                               radius * std::cos(polar)});
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t next = (k + 1) % around, upper = i * around, lower = upper + around;
      if (i > 0) mesh.triangles.push_back({upper + k, lower + k, upper + next});
      if (i + 1 < rings) mesh.triangles.push_back({upper + next, lower + k, lower + next});
    }
  return mesh;
}

// 50 kg, radius 0.5 m, dropped by 2 m: how far it is in the floor at most, m.
double dive(const physics::SharedShape& shape, double rate_hz) {
  physics::WorldOptions options;
  options.step = 1.0 / rate_hz;
  physics::World world(options);
  physics::BodyDefinition ball;
  ball.mass = 50.0;
  ball.shape = shape;
  ball.T_world_body.position = {0, 0, 2.5};
  physics::Body floor(physics::testing::parameters(0.0, {physics::testing::ground()}, {})), body(ball);
  world.add(floor);
  world.add(body);
  double lowest = 2.5;
  for (int i = 0; i < static_cast<int>(1.5 * rate_hz); ++i) {
    world.step();
    lowest = std::min(lowest, body.pose().position.z);
  }
  return std::max(0.0, 0.5 - lowest);
}

void print_dives() {
  std::printf(
      "A ball of 50 kg (radius 0.5 m) dropped by 2 m: greatest depth, mm\n\n| | 60 Hz | 120 | 250 | 500 | 1000 |\n"
      "|---|---|---|---|---|---|\n");
  const struct {
    const char* name;
    physics::SharedShape shape;
  } kBalls[] = {{"sphere", physics::make_shape({physics::testing::sphere(0.5)}, {})},
                {"mesh of 440 triangles", ball_mesh(0.5, 22).shape()},
                {"mesh of 3960 triangles", ball_mesh(0.5, 64).shape()}};
  for (const auto& ball : kBalls) {
    std::printf("| %s |", ball.name);
    for (const double rate : {60.0, 120.0, 250.0, 500.0, 1000.0}) {
      const double depth = dive(ball.shape, rate);
      std::printf(" %.2f%s |", 1e3 * depth, judged(depth < 0.25));
    }
    std::printf("\n");
  }
}

void print_grasps() {
  std::printf(
      "\nTwo jaws of rays hold a box for 10 s, no other friction; slip in mm (contact area 1 mm)\n\n"
      "| sensors | 0.4 kg, limit 4/3 of the weight | 0.8 kg | 0.4 kg, limit 2/3 | 0.8 kg |\n"
      "|---|---|---|---|---|\n");
  for (const int elements : {4, 8, 16, 24, 36, 50}) {
    std::printf("| %d |", elements);
    for (const double share : {4.0 / 3.0, 2.0 / 3.0}) {
      for (const double mass : {0.4, 0.8}) {
        const bool holds = share > 1.0;
        const double slip = ResistiveGrasp(elements, mass, share).drop(holds ? 10.0 : 0.5);
        if (holds) std::printf(" %.3f%s |", 1e3 * slip, judged(slip < 0.001));
        if (!holds) std::printf(" slides%s |", judged(slip > 0.01));
      }
    }
    std::printf("\n");
  }
}

void print_slopes() {
  std::printf(
      "\nA box of 0.5 kg on a slope of 20 degrees, nine rays, no other friction: drift in 60 s, um\n\n"
      "| 4 ms | 2 ms | 1 ms | 0.5 ms |\n|---|---|---|---|\n|");
  const math::Vec3 gravity = math::rotate(math::from_rpy(0, -std::numbers::pi / 9.0, 0), {0, 0, -9.81});
  for (const double h : {0.004, 0.002, 0.001, 0.0005}) {
    ResistiveWorld world(
        model::test::box("slope", 0.0, {0, 0, -0.5}, {4, 4, 1}) +
            model::test::box("b", 0.5, {0, 0, 0.0105}, {0.1, 0.1, 0.02}) +
            model::test::sensor("s", "b", model::test::grid(3, 3, 0.08, -0.005), {0, 0, -1},
                                {.stick = 5000.0, .damping = 0.1, .slide = 0.8, .contact_damping = 0.1}),
        "SENSOR s", {0, 0, -9.81}, h);
    world.load_slowly(gravity, 0.5);
    world.rig.step(static_cast<int>(2.0 / h));
    const math::Vec3 settled = world.at("b");
    world.rig.step(static_cast<int>(60.0 / h));
    const double drift = math::norm(world.at("b") - settled);
    std::printf(" %.3f%s |", 1e6 * drift, judged(drift < 1e-4));
  }
  std::printf("\n");
}

// 100 rays, in ten by ten, onto a body that moves a little in each step so that all are cast again.
void print_rays() {
  std::printf("\nOne ray among eleven bodies, us (100 rays of a bundle that moves)\n\n| shape | us |\n|---|---|\n");
  using namespace physics::testing;
  const struct {
    const char* name;
    physics::SharedShape shape;
  } kShapes[] = {{"sphere", physics::make_shape({sphere(0.05)}, {})},
                 {"box", physics::make_shape({box(0.1, 0.1, 0.1)}, {})},
                 {"mesh of 440 triangles", ball_mesh(0.05, 22).shape()},
                 {"mesh of 3960 triangles", ball_mesh(0.05, 64).shape()}};
  for (const auto& each : kShapes) {
    physics::World world;
    std::vector<std::unique_ptr<physics::Body>> bodies;
    for (int i = 0; i < 11; ++i) {
      physics::BodyDefinition definition;
      definition.shape = each.shape;
      definition.T_world_body.position = {0.12 * (i - 5), 0, 0};
      world.add(*bodies.emplace_back(std::make_unique<physics::Body>(definition)));
    }
    world.step();
    std::vector<physics::Ray> rays;
    for (int i = 0; i < 10; ++i)
      for (int k = 0; k < 10; ++k)
        rays.push_back({{0.01 * i - 0.045, 0.01 * k - 0.045, 0.2}, {0.01 * i - 0.045, 0.01 * k - 0.045, -0.2}});
    physics::RayBundle bundle;
    std::vector<physics::RayHit> hits(rays.size());
    constexpr int kTimes = 300;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kTimes; ++i) {
      world.step();
      bundle.cast(world, {{1e-5 * i, 0, 0}, {}}, rays, {}, hits, 0);
    }
    const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - begin;
    std::printf("| %s | %.2f |\n", each.name, taken.count() / kTimes / static_cast<double>(rays.size()));
  }
}

}  // namespace

int main() {
  print_dives();
  print_grasps();
  print_slopes();
  print_rays();
  return all_good && !testing::Test::HasFailure() ? 0 : 1;
}
