// What a step of tissue costs by elements and modulus, and how far moduli, falls and volumes are from theory on grids
// finer than the tests'. Prints tables; ends with 1 where something does not hold.
#include <ctime>

#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "physics/tissue.h"
#include "physics/tissue_grid.h"
#include "tests/physics/fixtures.h"

namespace {

using namespace ambf::physics;
using ambf::math::Vec3;

bool all_good = true;
const char* judged(bool good) {
  all_good &= good;
  return good ? "" : " (!)";
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TissueSurface block(const Vec3& size) {
  TissueSurface made;
  for (std::uint32_t k = 0; k < 8; ++k)
    made.vertices.push_back({k & 1U ? size.x : 0.0, k & 2U ? size.y : 0.0, k & 4U ? size.z : 0.0});
  made.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return made;
}

void time_of_a_step() {
  std::printf(
      "| elements | modulus, kPa | iterations | ms a step, at rest on a floor | ms, trembling "
      "|\n|---|---|---|---|---|\n");
  for (const double cubes : {4.0, 6.0, 10.0})
    for (const double young : {5e3, 1e5}) {
      const double side = 0.005 * cubes;
      TissueDefinition given;
      given.grid = make_tissue_grid(block({side, side, side}), 0.005);
      given.material.young = young;
      given.T_world_body.position.z = given.margin;
      World world;
      Tissue tissue(given);
      Body floor(testing::parameters(0.0, {testing::ground()}, {}));
      world.add(floor);
      add(world, tissue);
      const auto measured = [&](int steps) {
        const double from = thread_seconds();
        for (int i = 0; i < steps; ++i) world.step();
        return 1e3 * (thread_seconds() - from) / steps;
      };
      const double first = measured(100);
      for (int i = 0; i < 900; ++i) world.step();
      std::printf("| %zu | %g | %zu | %.2f | %.2f |\n", tissue.link_count(), 1e-3 * young, tissue.iterations(),
                  measured(300), first);
      remove(world, tissue);
    }
}

// Columns of 3 x 3 x 24 cubes.
void columns() {
  std::printf("\n| modulus, kPa | step, ms | sag by theory |\n|---|---|---|\n");
  for (const double young : {2e3, 1e4, 1e5})
    for (const double step : {0.0005, 0.001, 0.002}) {
      const double length = 0.06;
      TissueDefinition given;
      given.grid = make_tissue_grid(block({0.0075, 0.0075, length}), 0.0025);
      given.material.young = young;
      given.material.poisson = 0.3;
      given.step_s = step;
      for (std::uint32_t i = 0; i < given.grid.corners.size(); ++i)
        if (given.grid.corners[i].z > length - 1e-9) given.fixed.push_back(i);
      WorldOptions options;
      options.step = step;
      World world(options);
      Tissue tissue(given);
      add(world, tissue);
      const int steps = static_cast<int>(1.0 / step);
      double sag = 0.0;
      for (int i = 0; i < 2 * steps; ++i) {
        world.step();
        if (i >= steps) sag -= tissue.position(0).z / steps;
      }
      const double ratio = sag * 2.0 * young / (given.material.density * 9.8 * length * length);
      std::printf("| %g | %g | %.3f%s |\n", 1e-3 * young, 1e3 * step, ratio, judged(std::abs(ratio - 1.0) < 0.1));
      remove(world, tissue);
    }
}

}  // namespace

int main() {
  time_of_a_step();
  columns();
  return all_good ? 0 : 1;
}
