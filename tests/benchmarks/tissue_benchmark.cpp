// What a step of tissue costs by elements and modulus, and beside a blade; how far moduli, falls and volumes are from
// theory on grids finer than the tests'. Prints tables; ends with 1 where something does not hold. `cutting`: only what
// a blade costs; `sheets`: only sheets; `faces`: only how far surfaces of cuts are from what the blade swept.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <vector>

#include "physics/blade.h"
#include "physics/tissue.h"
#include "physics/tissue_grid.h"
#include "tests/benchmarks/judged.h"
#include "tests/physics/cut_strokes.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/tissue_shapes.h"

namespace {

using namespace ambf::physics;
using namespace ambf::benchmarks;
using ambf::math::Vec3;

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

TissueSurface rectangle(double x, double y, std::uint32_t nx, std::uint32_t ny) {
  TissueSurface made;
  for (std::uint32_t j = 0; j <= ny; ++j)
    for (std::uint32_t i = 0; i <= nx; ++i) made.vertices.push_back({x * i / nx - 0.5 * x, y * j / ny - 0.5 * y, 0.0});
  for (std::uint32_t j = 0; j < ny; ++j)
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1;
      made.triangles.push_back({a, b, c});
      made.triangles.push_back({b, c + 1, c});
    }
  return made;
}

// A sheet of 0.5 mm falls over a ball.
void time_of_sheets() {
  std::printf(
      "| triangles | modulus, kPa | iterations | ms a step, falling over a ball | ms, hanging on it |\n"
      "|---|---|---|---|---|\n");
  for (const std::uint32_t squares : {10U, 22U, 50U})
    for (const double young : {1e5, 1e6}) {
      TissueDefinition given;
      given.grid = make_sheet_grid(rectangle(0.12, 0.12, squares, squares), 0.0005);
      given.material.young = young;
      given.T_world_body.position.z = 0.004;
      World world;
      Tissue sheet(given);
      Body ball(testing::parameters(0.0, {testing::sphere(0.03)}, {0, 0, -0.03}));
      world.add(ball);
      add(world, sheet);
      const auto measured = [&](int steps) {
        const double from = thread_seconds();
        for (int i = 0; i < steps; ++i) world.step();
        return 1e3 * (thread_seconds() - from) / steps;
      };
      const double falling = measured(300), hanging = measured(300);
      std::printf("| %zu | %g | %zu | %.2f | %.2f |\n", sheet.link_count(), 1e-3 * young, sheet.iterations(), falling,
                  hanging);
      remove(world, sheet);
    }
}

// Strips that are clamped at one end and sag by less than a tenth of their length, by w L^4 / (8 E I).
void strips() {
  std::printf("\n| elements along a strip | step, ms | sag by theory |\n|---|---|---|\n");
  for (const std::uint32_t along : {10U, 20U, 40U})
    for (const double step : {0.0005, 0.001}) {
      const double length = 0.05, cell = length / along, thickness = 0.001, young = 1e6, g = 0.4;
      TissueDefinition given;
      given.grid = make_sheet_grid(rectangle(length + cell, 0.02, along + 1, along * 2 / 5), thickness);
      given.material.young = young;
      given.material.poisson = 0.3;
      given.step_s = step;
      for (std::uint32_t i = 0; i < given.grid.corners.size(); ++i)
        if (given.grid.corners[i].x < -0.5 * length + 0.5 * cell + 1e-9) given.fixed.push_back(i);
      WorldOptions options;
      options.step = step;
      options.gravity = {0, 0, -g};
      World world(options);
      Tissue sheet(given);
      add(world, sheet);
      const int steps = static_cast<int>(2.0 / step);
      double sag = 0.0;
      for (int i = 0; i < 2 * steps; ++i) {
        world.step();
        if (i >= steps) sag -= sheet.position(along + 1).z / steps;
      }
      const double ratio = sag * 8.0 * young * thickness * thickness / (12.0 * 1060.0 * g * std::pow(length, 4));
      std::printf("| %u | %g | %.3f%s |\n", along, 1e3 * step, ratio, judged(std::abs(ratio - 1.0) < 0.15));
      remove(world, sheet);
    }
}

// Of all that the tissue and the edge are: the same before and after a change that should change nothing.
std::uint64_t state_of(const Tissue& tissue, const Blade& blade) {
  std::vector<double> all, edge;
  tissue.get_state(all);
  blade.get_state(edge);
  all.insert(all.end(), edge.begin(), edge.end());
  std::uint64_t hash = 14695981039346656037ULL;
  for (const double number : all) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    hash = (hash ^ bits) * 1099511628211ULL;
  }
  return hash;
}

double median_of(std::vector<double>& times) {
  if (times.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

// A cube of tissue has its bottom fixed, and an edge across all of it, a little askew, goes down through it, six times.
void time_of_a_blade() {
  std::printf(
      "| elements | ms a step, no blade | blade beside | in it, cuts nothing | cuts a row of seams (steps) | "
      "of the one that cuts nothing | state |\n|---|---|---|---|---|---|---|\n");
  for (const double cubes : {5.0, 10.0}) {
    const double side = 0.005 * cubes;
    TissueDefinition given;
    given.grid = make_tissue_grid(block({side, side, side}), 0.005, true);
    given.material.young = 2e4;
    given.max_corners = 12000;
    for (std::uint32_t i = 0; i < given.grid.corners.size(); ++i)
      if (given.grid.corners[i].z < 1e-9) given.fixed.push_back(i);
    WorldOptions options;
    options.gravity = {};
    World world(options);
    Tissue tissue(given);
    Blade blade({{{0.0005, -0.005, 0.0}, {-0.0005, side + 0.005, 0.0003}}, 5.0});
    ambf::physics::Body hand(testing::mass_only(0.0, {}, {{0, 0, 1}, {}}));
    world.add(hand);
    add(world, tissue);
    add(world, blade);
    const auto timed = [&] {
      const double from = thread_seconds();
      world.step();
      return 1e3 * (thread_seconds() - from);
    };
    std::vector<double> none, beside, within, cutting;
    for (int i = 0; i < 100; ++i) none.push_back(timed());
    for (int stroke = 0; stroke < 6; ++stroke) {
      const double x = side * (stroke + 0.7) / 6.0;
      blade.use(nullptr);
      hand.set_pose({{x, 0, side + 0.002}, {}});
      blade.use(&hand);
      for (int i = 0; i < 20; ++i) beside.push_back(timed());
      for (int i = 1; i <= 100; ++i) {  // 0.5 m/s
        hand.move_to({{x, 0, side + 0.002 - 0.0005 * i}, {}});
        const std::size_t before = tissue.open_seams();
        const double time = timed();
        const std::size_t opened = tissue.open_seams() - before;
        if (static_cast<double>(opened) >= cubes) {  // each between two elements
          cutting.push_back(time);
        } else if (opened == 0 && blade.length_in_tissue() > 0.5 * side) {
          within.push_back(time);
        }
      }
    }
    const std::size_t cuts = cutting.size();
    const double plain = median_of(within), cut = median_of(cutting);
    std::printf("| %zu | %.3f | %.3f | %.3f | %.3f (%zu) | %.2f%s | %016llx |\n", tissue.link_count(), median_of(none),
                median_of(beside), plain, cut, cuts, cut / plain, judged(cut < 2.0 * plain),
                static_cast<unsigned long long>(state_of(tissue, blade)));
    remove(world, blade);
    remove(world, tissue);
    world.remove(hand);
  }
}

// In elements.
void faces_of_cuts() {
  using testing::CutStrokes;
  using testing::OffSwept;
  std::printf(
      "| stroke | strokes | nodes | furthest between elements | furthest | root mean square "
      "|\n|---|---|---|---|---|---|\n");
  const auto print = [](const char* what, const std::vector<OffSwept>& strokes) {
    OffSwept all;
    double squares = 0.0;
    for (const OffSwept& each : strokes) {
      all.nodes += each.nodes;
      all.most = std::max(all.most, each.most);
      all.loaded = std::max(all.loaded, each.loaded);
      squares += each.mean * each.mean * static_cast<double>(each.nodes);
    }
    std::printf("| %s | %zu | %zu | %.2f | %.3f%s | %.3f |\n", what, strokes.size(), all.nodes, all.loaded, all.most,
                judged(all.most < 0.2), std::sqrt(squares / static_cast<double>(std::max<std::size_t>(all.nodes, 1))));
  };
  const auto turns = [](const auto& stroke) {
    std::vector<OffSwept> made;
    for (const double turn : {0.0, 0.3, 0.6, 0.9})
      for (const double roll : {0.0, 0.4}) made.push_back(stroke(turn, roll));
    return made;
  };
  print("block, straight", turns(CutStrokes::block_straight));
  print("block, about 30 mm", {CutStrokes::block_round(0.03)});
  print("block, about 15 mm", {CutStrokes::block_round(0.015)});
  print("ball, straight",
        turns([](double turn, double roll) { return CutStrokes::mesh_straight(testing::ball(), turn, roll); }));
  print("liver, straight",
        turns([](double turn, double roll) { return CutStrokes::mesh_straight(testing::liver(), turn, roll); }));
  for (const testing::Mesh mesh : {testing::Mesh::diagonals, testing::Mesh::crossed})
    print(mesh == testing::Mesh::crossed ? "sheet, crossed, straight" : "sheet, diagonals, straight",
          turns([&](double turn, double lean) { return CutStrokes::sheet_straight(mesh, turn, lean); }));
  for (const double radius : {0.05, 0.025})
    print(radius > 0.03 ? "sheet, about 50 mm" : "sheet, about 25 mm",
          {CutStrokes::sheet_round(testing::Mesh::crossed, radius)});
  std::printf("\nahead of an edge that stops halfway: %.2f\n", CutStrokes::ahead_of_edge());
}

}  // namespace

int main(int count, char** words) {
  const std::string_view only = count > 1 ? words[1] : "";
  if (only == "faces") {
    faces_of_cuts();
    return all_good ? 0 : 1;
  }
  if (only != "cutting") {
    time_of_sheets();
    strips();
  }
  if (only == "sheets") return all_good ? 0 : 1;
  time_of_a_blade();
  if (only == "cutting") return all_good ? 0 : 1;
  time_of_a_step();
  columns();
  return all_good ? 0 : 1;
}
