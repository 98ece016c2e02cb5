// What grasps and slopes of resistive sensors hold (dissertation Table 6.2, Fig. 6.9, 6.10), how deep a dropped ball
// dives (Fig. 6.3), and what rays cost by shape. Prints tables; ends with 1 where something does not hold.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
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
    std::vector<physics::BundleHit> hits(rays.size());
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

// A carrier with 300 rays over eleven boxes, no gravity, one step after the other.
struct RayScene {
  // `type`: of the sensor; empty: none. `speed`: of the carrier, m/s; at 0 all falls asleep.
  RayScene(const std::string& type, double speed) : speed_(speed) {
    std::string text =
        "BODY c: {name: c, mass: 1, location: {position: {x: 0, y: 0, z: 0.2}}, collision shape: BOX, "
        "collision geometry: {x: 0.6, y: 0.4, z: 0.02}, damping: {linear: 0, angular: 0}}\n";
    for (int i = 0; i < 11; ++i)
      text += model::test::box("b" + std::to_string(i), 1e5, {0.056 * (i - 5), 0, 0}, {0.05, 0.3, 0.3});
    rays = model::test::grid(20, 15, 0.38, -0.011);
    if (!type.empty()) {
      std::string sensor = model::test::sensor("s", "c", rays, {0, 0, -1},
                                               {.stick = 1.0, .slide = 1e-4, .stiffness = 1e-4, .range = 0.1});
      sensor.replace(sensor.find("Resistance"), 10, type);
      text += sensor;
    }
    world.emplace(text, type.empty() ? "" : "SENSOR s");
    if (speed > 0.0) {
      const auto port = world->rig.port("c");
      port->post(model::test::twist({{speed, 0, 0}, {}}));
    }
    world->rig.step(speed > 0.0 ? 5 : 3000);
  }
  // CPU time of a step, us; `casts` 1: that of casting the same rays beside it.
  double step_us(bool casts) {
    constexpr int kSteps = 1500;
    std::vector<physics::Ray> bundle_rays;
    for (const math::Vec3& start : rays) bundle_rays.push_back({start, start - math::Vec3{0, 0, 0.1}});
    std::vector<physics::BundleHit> hits(bundle_rays.size());
    physics::RayBundle bundle;
    std::int64_t spent_ns = 0;
    const auto port = world->rig.port("c");
    for (int i = 0; i < kSteps; ++i) {
      const double x = speed_ * (i % 2 == 0 ? 1.0 : -1.0);
      if (speed_ > 0.0) port->post(model::test::twist({{x, 0, 0}, {}}));
      world->rig.live->take_commands(1e-3 * i);
      const math::Pose at{{1e-5 * (i % 2), 0, 0.2}, {}};
      const std::int64_t begin = base::thread_cpu_ns();
      if (casts) {
        bundle.cast(world->rig.live->physics(), at, bundle_rays, {}, hits, 0);
      } else {
        world->rig.live->step(1e-3);
      }
      spent_ns += base::thread_cpu_ns() - begin;
      if (casts) world->rig.live->step(1e-3);
    }
    return 1e-3 * static_cast<double>(spent_ns) / kSteps;
  }
  std::optional<ResistiveWorld> world;
  std::vector<math::Vec3> rays;
  double speed_;
};

// What a sensor's step is made of, and what it costs while all sleeps. Medians of five, for what else runs disturbs.
void print_sensor_steps() {
  const auto median = [](const char* type, double speed, bool casts) {
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) times.push_back(RayScene(type, speed).step_us(casts));
    std::sort(times.begin(), times.end());
    return times[2];
  };
  const double without = median("", 0.01, false), asleep_without = median("", 0.0, false);
  std::printf(
      "\nA step with 300 rays over eleven boxes, us of CPU, of it the sensor's, and of that casting\n\n"
      "| sensor | awake | of it the sensor | casting | asleep | of it the sensor |\n|---|---|---|---|---|---|\n");
  for (const char* type : {"Proximity", "Resistance"}) {
    const double awake = median(type, 0.01, false), casting = median(type, 0.01, true);
    const double own = awake - without, share = casting / own;
    // Beside casting, resistive rays compute forces; among boxes, which are met by formula, these take longer.
    const bool resists = std::string(type) == "Resistance";
    std::printf("| %s | %.1f | %.1f | %.0f %%%s |", type, awake, own, 100.0 * share, judged(resists || share > 0.7));
    if (resists) {
      std::printf(" (keeps awake what it holds) | |\n");
      continue;
    }
    const double asleep = median(type, 0.0, false), own_asleep = asleep - asleep_without;
    std::printf(" %.2f (%.1f %% of awake) | %.2f |\n", asleep, 100.0 * asleep / awake, own_asleep);
  }
}

}  // namespace

// `costs`: only what is about time.
int main(int argc, char** argv) {
  if (argc < 2 || std::string(argv[1]) != "costs") {
    print_dives();
    print_grasps();
    print_slopes();
  }
  print_rays();
  print_sensor_steps();
  return all_good && !testing::Test::HasFailure() ? 0 : 1;
}
