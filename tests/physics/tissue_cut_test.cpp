// Blades that cut tissue: what falls apart, what gapes, what is lost (nothing), the force that it takes, and that a cut
// repeats and can be saved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "physics/rays.h"
#include "tests/physics/cut_scene.h"
#include "tests/physics/tissue_block.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

const Vec3 kSize{0.04, 0.02, 0.02};

struct Scene : CutScene {
  explicit Scene(double sharpness, const Vec3& edge_from, const Vec3& edge_to, bool fixed_below = false,
                 std::size_t max_corners = 4000)
      : CutScene(given(fixed_below, max_corners), {{edge_from, edge_to}, sharpness}) {}
  static TissueDefinition given(bool fixed_below, std::size_t max_corners) {
    TissueDefinition made = tissue_of(block(kSize), 0.005, 2e4, 0.45, max_corners);
    for (std::uint32_t i = 0; fixed_below && i < made.grid.corners.size(); ++i)
      if (made.grid.corners[i].z < 1e-9) made.fixed.push_back(i);
    return made;
  }
};

constexpr Vec3 kFrom{0.0, -0.005, 0.0}, kTo{0.0, 0.025, 0.0};

TEST(TissueCut, HalfwayItGapesAndThroughItFallsApart) {
  Scene scene(0.1, kFrom, kTo);
  ASSERT_TRUE(scene.tissue.can_be_cut());
  const double mass = scene.tissue.mass(), volume = scene.tissue.volume();
  EXPECT_NEAR(volume, kSize.x * kSize.y * kSize.z, 1e-12);
  const std::size_t corners = scene.tissue.corner_count(), nodes = scene.tissue.node_count();
  scene.stroke({{0.021, 0, 0.025}, {}}, {0, 0, -0.015}, 60);
  const std::size_t half = scene.tissue.open_seams();
  EXPECT_GT(half, 10U);
  EXPECT_EQ(scene.tissue.pieces(), 1U);
  EXPECT_EQ(scene.tissue.node_count(), nodes);
  scene.stroke({{0.021, 0, 0.025}, {}}, {0, 0, -0.03}, 120);
  EXPECT_GT(scene.tissue.open_seams(), half);
  EXPECT_EQ(scene.tissue.pieces(), 2U);
  EXPECT_GT(scene.tissue.corner_count(), corners);
  EXPECT_NEAR(scene.tissue.mass(), mass, 1e-9 * mass);
  EXPECT_NEAR(scene.tissue.volume(), volume, 1e-3 * volume);
  // Pulled at both ends the halves part; what is behind the lips is met from between them.
  for (int i = 0; i < 200; ++i) {
    for (std::size_t node = 0; node < nodes; ++node) {
      const double x = scene.tissue.position(node).x;
      scene.tissue.apply_force(node, {x < 0.018 ? -1e-5 : (x > 0.024 ? 1e-5 : 0.0), 0, 0});
    }
    scene.world.step();
  }
  EXPECT_EQ(scene.tissue.pieces(), 2U);
  const Vec3 middle = scene.tissue.centre().position;
  const auto lip = ray_cast_soft(scene.world, middle, middle + Vec3{0.5, 0, 0});
  ASSERT_TRUE(lip);
  EXPECT_GT(lip->point.x - middle.x, 0.002);
  scene.tissue.reset();
  EXPECT_EQ(scene.tissue.open_seams(), 0U);
  EXPECT_EQ(scene.tissue.corner_count(), corners);
  EXPECT_EQ(scene.tissue.pieces(), 1U);
}

// The tissue asks the blades that are near whether they move before it sleeps: not one that is gone.
TEST(TissueCut, GoesOnWhenABladeThatIsInItIsRemoved) {
  Scene scene(0.1, kFrom, kTo, true);
  scene.blade.use(nullptr);
  auto gone = std::make_unique<Blade>(BladeOptions{{kFrom, kTo}, 0.1});
  add(scene.world, *gone);
  gone->use(&scene.hand);
  for (int i = 1; i <= 60; ++i) {
    scene.hand.move_to({{0.021, 0, 0.025 - 0.015 * i / 60.0}, {}});
    scene.world.step();
  }
  const std::size_t open = scene.tissue.open_seams();
  EXPECT_GT(open, 10U);
  remove(scene.world, *gone);
  gone.reset();
  for (int i = 0; i < 3000; ++i) {
    scene.hand.move_to({{0.021, 0, 0.01 - 1e-5 * i}, {}});
    scene.world.step();
  }
  EXPECT_EQ(scene.tissue.open_seams(), open);
  EXPECT_TRUE(scene.tissue.asleep()) << "and it rests, whatever the hand does";
}

TEST(TissueCut, DrawnAlongItsEdgeItCutsNothing) {
  Scene scene(0.0, {-0.01, 0, 0}, {0.01, 0, 0});
  scene.stroke({{-0.02, 0.0101, 0.0101}, {}}, {0.08, 0, 0}, 160);
  EXPECT_EQ(scene.tissue.open_seams(), 0U);
  scene.stroke({{0.02, 0.0101, 0.0101}, {}}, {0, 0, 0.005}, 20);  // the same, across
  EXPECT_GT(scene.tissue.open_seams(), 0U);
}

TEST(TissueCut, TakesItsForceAndBelowItOnlyPushes) {
  for (const double sharpness : {20.0, 60.0}) {
    Scene scene(sharpness, kFrom, kTo, true);
    scene.stroke({{0.021, 0, 0.0205}, {}}, {0, 0, -0.00055}, 50);
    EXPECT_EQ(scene.tissue.open_seams(), 0U);  // tissue gives way by 0.05 mm
    scene.stroke({{0.021, 0, 0.021}, {}}, {0, 0, -0.01}, 250);
    EXPECT_GT(scene.tissue.open_seams(), 0U);
    const double length = scene.blade.length_in_tissue();
    EXPECT_NEAR(length, 0.02, 0.002);
    EXPECT_NEAR(scene.blade.force_world().z, -sharpness * length, 0.1 * sharpness * length);
    EXPECT_NEAR(scene.tissue.force_on(scene.hand).z, sharpness * length, 0.1 * sharpness * length);
  }
}

TEST(TissueCut, RandomStrokesLoseNothingRepeatAndAreSaved) {
  Scene first(2.0, kFrom, kTo), again(2.0, kFrom, kTo), saved(2.0, kFrom, kTo);
  const double mass = first.tissue.mass(), volume = first.tissue.volume();
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<double>(random() % 10001) / 10000.0; };
  for (int i = 0; i < 100; ++i) {
    const math::Quat turned = math::Quat{number() - 0.5, number() - 0.5, number() - 0.5, 0.2 + number()};
    const double size = 1.0 / math::norm(turned);
    const math::Pose from{{0.06 * number() - 0.01, 0.03 * number() - 0.005, 0.025},
                          {turned.x * size, turned.y * size, turned.z * size, turned.w * size}};
    const Vec3 way{0.02 * number() - 0.01, 0.02 * number() - 0.01, -0.03 * number()};
    if (i == 50) {
      std::vector<double> state;
      first.tissue.get_state(state);
      // Saving a world restarts what it holds, as this does: where lips stick to each other is in no state.
      for (Scene* each : {&first, &again, &saved}) ASSERT_TRUE(each->tissue.set_state(state));
      EXPECT_EQ(saved.tissue.open_seams(), first.tissue.open_seams());
    }
    first.stroke(from, way, 5);
    again.stroke(from, way, 5);
    if (i >= 50) saved.stroke(from, way, 5);
    ASSERT_FALSE(first.tissue.divergence()) << i;
  }
  EXPECT_GT(first.tissue.open_seams(), 100U);
  EXPECT_FALSE(first.tissue.full());
  EXPECT_NEAR(first.tissue.mass(), mass, 1e-9 * mass);
  EXPECT_EQ(first.state(), again.state());
  EXPECT_EQ(first.state(), saved.state());
  first.blade.use(nullptr);
  for (int i = 0; i < 200; ++i) first.world.step();
  EXPECT_NEAR(first.tissue.volume(), volume, 1e-3 * volume);
}

// What it could not have written puts the edge nowhere: element, or place, of a saved state.
TEST(TissueCut, AForgedPlaceOfTheEdgeIsNone) {
  Scene scene(0.1, kFrom, kTo);
  scene.stroke({{0.021, 0, 0.025}, {}}, {0, 0, -0.015}, 60);
  std::vector<double> state, now;
  scene.blade.get_state(state);
  std::size_t first = 0;
  while (state[first] < 0.0) first += 6;
  scene.blade.set_state(scene.world, state);
  scene.blade.get_state(now);
  EXPECT_EQ(now, state);
  for (const auto& [number, value] : {std::pair{2, -3.0}, {2, 1e9}, {2, NAN}, {3, NAN}, {4, 1e300}, {5, 1.0}}) {
    std::vector<double> forged = state;
    forged[first + static_cast<std::size_t>(number)] = value;
    scene.blade.set_state(scene.world, forged);
    scene.blade.get_state(now);
    EXPECT_EQ(now[first], -1.0) << number << " " << value;
    EXPECT_TRUE(std::equal(now.begin() + static_cast<std::ptrdiff_t>(first) + 6, now.end(),
                           state.begin() + static_cast<std::ptrdiff_t>(first) + 6));
  }
}

// Where it had room for some copies only: cutting stops, and nothing is lost.
TEST(TissueCut, FullItStops) {
  Scene scene(0.0, kFrom, kTo, false, 240);
  scene.stroke({{0.021, 0, 0.025}, {}}, {0, 0, -0.03}, 60);
  EXPECT_TRUE(scene.tissue.full());
  EXPECT_LE(scene.tissue.corner_count(), 240U);
  EXPECT_EQ(scene.tissue.pieces(), 1U);
  EXPECT_FALSE(scene.tissue.divergence());
}

}  // namespace
}  // namespace ambf::physics
