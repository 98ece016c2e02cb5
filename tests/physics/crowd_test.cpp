// Hundreds of bodies at one place: bounded work, and they come apart.
#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures.h"
#include "physics/detail/world_data.h"

namespace ambf::physics::testing {
namespace {

struct Pile {
  explicit Pile(int count, const std::vector<scene::PlacedGeometry>& parts = {box(0.1, 0.1, 0.1)}) {
    world.add(floor);
    for (int i = 0; i < count; ++i)
      world.add(*bodies.emplace_back(std::make_unique<Body>(parameters(0.1, parts, {0, 0, 0.5}))));
  }
  ~Pile() {
    for (const auto& body : bodies) world.remove(*body);
    world.remove(floor);
  }
  int manifolds() const { return world.data().dispatcher->getNumManifolds(); }
  // The widest extent of the pile, m.
  double width() const {
    math::Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (const auto& body : bodies) {
      const math::Vec3 at = body->pose().position;
      low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
    }
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  }

  World world;
  Body floor{parameters(0.0, {ground()}, {})};
  std::vector<std::unique_ptr<Body>> bodies;
};

TEST(Crowd, ContactsOfBoxesAtOnePointGrowWithTheirNumberAndTheyComeApart) {
  Pile pile(200);
  pile.world.step();
  EXPECT_GE(pile.world.crowd().steps, 1u);
  EXPECT_EQ(pile.world.crowd().near_bodies, 199u);
  EXPECT_NE(pile.world.crowd().body, nullptr);
  int most = 0;
  for (int i = 0; i < 500; ++i) {
    pile.world.step();
    most = std::max(most, pile.manifolds());
  }
  EXPECT_LE(most, 200 * 16);  // of 19900 pairs
  EXPECT_EQ(pile.world.first_diverged(), nullptr);
  EXPECT_GT(pile.width(), 0.5);
}

TEST(Crowd, FewBodiesAtOnePointMeetEachOther) {
  Pile pile(30);
  pile.world.step();
  EXPECT_EQ(pile.world.crowd().steps, 0u);
  EXPECT_GE(pile.manifolds(), 30 * 29 / 2);
}

// A body that lies on something is near it and a few others, whatever goes on elsewhere.
TEST(Crowd, WhatIsBesideACrowdRestsAsEver) {
  Pile pile(150);
  Body tray(parameters(1.0, {box(2.0, 2.0, 0.1)}, {5, 0, 0.05}));
  pile.world.add(tray);
  std::vector<std::unique_ptr<Body>> load;
  for (int i = 0; i < 49; ++i) {
    load.push_back(std::make_unique<Body>(
        parameters(0.1, {box(0.1, 0.1, 0.1)}, {5.0 + 0.25 * (i % 7 - 3), 0.25 * (i / 7 - 3), 0.15})));
    pile.world.add(*load.back());
  }
  for (int i = 0; i < 100; ++i) pile.world.step();
  EXPECT_GE(pile.world.crowd().steps, 50u);
  for (const auto& body : load) EXPECT_NEAR(body->pose().position.z, 0.15, 1e-4);
  for (const auto& body : load) pile.world.remove(*body);
  pile.world.remove(tray);
}

}  // namespace
}  // namespace ambf::physics::testing
