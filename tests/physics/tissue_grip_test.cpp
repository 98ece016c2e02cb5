// Points of tissue that a body or a pointer holds (EQUATIONS 16), and rays that meet its faces: as of links.
#include <gtest/gtest.h>

#include <memory>

#include "physics/rays.h"
#include "physics/soft_grip.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/tissue_block.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr double kSide = 0.02, kG = 9.81;

struct Scene {
  explicit Scene(const Vec3& gravity = {0, 0, -kG})
      : world([&] {
          WorldOptions options;
          options.gravity = gravity;
          return options;
        }()) {
    add(world, *tissue);
  }
  ~Scene() {
    if (tissue != nullptr) remove(world, *tissue);
  }
  void step(int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }
  std::vector<std::size_t> top() const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < tissue->node_count(); ++i)
      if (tissue->position(i).z > kSide - 1e-9) found.push_back(i);
    return found;
  }

  World world;
  std::unique_ptr<Tissue> tissue = std::make_unique<Tissue>(tissue_of(block({kSide, kSide, kSide}), 0.005, 2e4));
};

TEST(TissueGrip, HangsTissueByItsHardness) {
  Scene scene;
  Body hand(mass_only(0.0, {}, {{0.01, 0.01, 0.1}, {}}));
  scene.world.add(hand);
  SoftGrip grip({50.0, 1.0});
  for (const std::size_t node : scene.top()) ASSERT_TRUE(grip.hold(hand, *scene.tissue, node));
  ASSERT_GT(grip.held().size(), 3U);
  scene.step(3000);
  Vec3 sum;
  for (const HeldNode& each : grip.held()) {
    const Vec3 gap = grip.target(each) - scene.tissue->position(each.node);
    EXPECT_LT(math::norm(each.force_world - gap * 50.0), 1e-4);
    sum += each.force_world;
  }
  const double weight = scene.tissue->mass() * kG;
  EXPECT_LT(math::norm(sum - Vec3{0, 0, weight}), 1e-3 * weight);
  hand.move_to({{0.01, 0.01, 0.11}, {}});
  const double before = scene.tissue->centre().position.z;
  scene.step(3000);
  EXPECT_NEAR(scene.tissue->centre().position.z - before, 0.01, 1e-5) << "it goes along";
}

TEST(TissueGrip, KeepsTheMomentumOfHandAndTissue) {
  Scene scene(Vec3{});
  Body hand(mass_only(0.02, {2e-6, 2e-6, 2e-6}, {{0.01, 0.01, 0.03}, {}}));
  scene.world.add(hand);
  hand.set_twist({{0.1, -0.05, 0.2}, {}});
  SoftGrip grip({1e5, 10.0});  // stiffer than the hand can bear in a step
  for (const std::size_t node : scene.top()) ASSERT_TRUE(grip.hold(hand, *scene.tissue, node));
  const auto total = [&] { return hand.twist().linear * 0.02 + scene.tissue->momentum(); };
  const Vec3 before = total();
  scene.step(500);
  EXPECT_LT(math::norm(total() - before), 1e-6 * math::norm(before));
  EXPECT_LT(math::norm(hand.twist().linear), 0.2) << "it carries the tissue";
  EXPECT_GT(math::norm(scene.tissue->momentum()), 0.2 * math::norm(before));
  EXPECT_FALSE(scene.tissue->divergence());
}

TEST(TissueGrip, PullsNoHarderThanItMay) {
  Scene scene(Vec3{});
  SoftGrip grip({1000.0, 1.0, 0.05});
  const std::size_t node = scene.top().front();
  ASSERT_TRUE(grip.hold_in_world(scene.world, *scene.tissue, node));
  grip.shift({0, 0, 0.5});
  for (int i = 0; i < 50; ++i) {
    scene.step(1);
    EXPECT_NEAR(math::norm(grip.held()[0].force_world), 0.05, 1e-9);
  }
  EXPECT_NEAR(scene.tissue->momentum().z, 0.05 * 0.05, 1e-4);
}

TEST(TissueGrip, PassesThroughItsHolderOnly) {
  Scene scene;
  Body table(parameters(0.0, {box(0.2, 0.2, 0.02)}, {0.01, 0.01, -0.0105}));
  Body hand(parameters(0.0, {box(0.2, 0.2, 0.01)}, {0.01, 0.01, 0.018}));  // within it
  scene.world.add(table);
  scene.world.add(hand);
  SoftGrip grip({200.0, 1.0});
  for (const std::size_t node : scene.top()) ASSERT_TRUE(grip.hold(hand, *scene.tissue, node));
  scene.step(200);
  EXPECT_LT(scene.tissue->force_on(table).z, -0.01) << "what does not hold it still meets it";
  EXPECT_NEAR(scene.tissue->centre().position.z, 0.01, 0.001) << "nothing pushes it out";
  const std::size_t with_table = scene.tissue->contacts();
  grip.release();
  scene.step(2);
  EXPECT_GT(scene.tissue->contacts(), with_table + 10) << "they meet again";
}

TEST(TissueGrip, EndsWithEitherBodyAndWithResets) {
  Scene scene;
  auto hand = std::make_unique<Body>(mass_only(0.5, {0.01, 0.01, 0.01}, {{0, 0, 0.1}, {}}));
  scene.world.add(*hand);
  SoftGrip grip;
  EXPECT_TRUE(grip.hold(*hand, *scene.tissue, 0));
  EXPECT_FALSE(grip.hold(*hand, *scene.tissue, 0)) << "twice";
  EXPECT_FALSE(grip.hold(*hand, *scene.tissue, scene.tissue->node_count()));
  scene.step(5);
  scene.tissue->reset();
  EXPECT_TRUE(grip.held().empty());
  EXPECT_TRUE(grip.hold(*hand, *scene.tissue, 1));
  scene.tissue->freeze();
  EXPECT_TRUE(grip.held().empty());
  EXPECT_FALSE(grip.hold(*hand, *scene.tissue, 1)) << "it is frozen";
  scene.tissue->reset();
  EXPECT_TRUE(grip.hold(*hand, *scene.tissue, 1));
  scene.world.remove(*hand);
  EXPECT_TRUE(grip.held().empty());
  hand.reset();
  scene.step(5);
  EXPECT_TRUE(grip.hold_in_world(scene.world, *scene.tissue, 1));
  remove(scene.world, *scene.tissue);
  EXPECT_TRUE(grip.held().empty());
  scene.tissue.reset();
  scene.step(5);
}

TEST(TissueRays, MeetItsFacesWhereTheyAre) {
  Scene scene(Vec3{});
  scene.tissue->apply_wrench({{0, 0, 0.01}, {}});
  scene.step(100);
  RayBundle bundle;
  std::vector<BundleHit> hits(1);
  for (std::size_t face = 0; face < scene.tissue->faces().size(); ++face) {
    const auto& nodes = scene.tissue->faces()[face];
    const Vec3 a = scene.tissue->position(nodes[0]), b = scene.tissue->position(nodes[1]),
               c = scene.tissue->position(nodes[2]);
    const Vec3 point = (a + b + c) / 3.0, out = math::normalized(math::cross(b - a, c - a)) * 0.004;
    const Ray rays[] = {{point + out, point - out}};
    bundle.forget();
    bundle.cast(scene.world, {}, rays, {.soft_bodies = true}, hits);
    ASSERT_EQ(hits[0].soft, scene.tissue.get()) << face;
    EXPECT_EQ(hits[0].triangle, static_cast<int>(face));
    EXPECT_LT(math::norm(hits[0].point - point), 1e-12);
  }
  // Cast anew once it moved.
  const Ray down[] = {{{0.011, 0.012, 0.1}, {0.011, 0.012, -0.1}}};
  bundle.cast(scene.world, {}, down, {.soft_bodies = true}, hits);
  const double before = hits[0].point.z;
  scene.tissue->apply_wrench({{0, 0, 0.5}, {}});
  scene.step(50);
  bundle.cast(scene.world, {}, down, {.soft_bodies = true}, hits);
  ASSERT_EQ(hits[0].soft, scene.tissue.get());
  EXPECT_GT(hits[0].point.z, before + 1e-4);
  const auto picked = ray_cast_soft(scene.world, down[0].start, down[0].end);
  ASSERT_TRUE(picked);
  EXPECT_LT(math::norm(picked->point - hits[0].point), 1e-12);
}

}  // namespace
}  // namespace ambf::physics
