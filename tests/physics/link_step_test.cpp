// Soft bodies of links whose step is ours move as those whose step is Bullet's, to the bit; what they touch, too.
#include <gtest/gtest.h>

#include "physics/soft_grip.h"
#include "tests/physics/bare_soft_world.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_sheet.h"

namespace ambf::physics {
namespace {

using namespace testing;

SoftDefinition cloth_above_things() {
  SoftDefinition cloth = sheet(9, 0.3);
  cloth.config.kDP = 0.01;
  cloth.config.bending_distance = 2;
  cloth.config.piterations = 3;
  cloth.config.kDF = 0.6;
  cloth.fixed = {0};
  cloth.margin = 0.004;
  cloth.T_world_body = {{-0.15, -0.15, 0.12}, {}};
  return cloth;
}

// Flags 16 let it meet soft bodies, of which there is none, and its step is Bullet's.
TEST(LinkStep, IsBulletsToTheBit) {
  const auto moved = [](int flags) {
    SoftDefinition cloth = cloth_above_things();
    cloth.config.flags = flags;
    World world{WorldOptions{}};
    Body still(parameters(0.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0.02})),
        falling(parameters(0.2, {sphere(0.03)}, {0, 0, 0.3})),
        carried(parameters(0.0, {sphere(0.02)}, {0.1, 0.1, 0.05})),
        hand(mass_only(0.5, {0.1, 0.1, 0.1}, {{0.1, -0.1, 0.2}, {}}));
    for (Body* body : {&still, &falling, &carried, &hand}) world.add(*body);
    SoftBody ours(cloth);
    add(world, ours);
    SoftGrip grip;
    std::vector<double> state, all;
    for (int i = 0; i < 600; ++i) {
      if (i == 50) {
        EXPECT_TRUE(grip.hold(hand, ours, 8));
      }
      if (i == 400) grip.release();
      carried.move_to({{0.1, 0.1, 0.05 + 0.0002 * i}, {}});
      ours.carry_fixed({{-0.15, -0.15, 0.12 + 0.0001 * i}, {}}, 10.0);
      ours.apply_force(40, {0.02, 0, 0.01});
      ours.apply_wrench({{0, 0.01, 0}, {0.001, 0, 0.002}});
      world.step();
      if (i % 100 != 99) continue;
      ours.get_state(state);
      all.insert(all.end(), state.begin(), state.end());
      const math::Vec3 ball = falling.pose().position, at = hand.pose().position;
      all.insert(all.end(), {ball.x, ball.y, ball.z, at.x, at.y, at.z});
    }
    EXPECT_LT(falling.pose().position.z, 0.25) << "it fell on the cloth";
    remove(world, ours);
    return all;
  };
  EXPECT_EQ(moved(1), moved(0x11));
}

TEST(LinkStep, MovesNodeForNodeAsInBulletsWorld) {
  SoftDefinition cloth = cloth_above_things();
  cloth.randomize_constraints = true;
  World world{WorldOptions{}};
  SoftBody ours(cloth);
  add(world, ours);
  BareSoftWorld bare(cloth);
  double largest = 0.0, fell = 0.0;
  for (int i = 0; i < 2000; ++i) {
    world.step();
    bare.step();
    for (std::size_t node = 0; node < ours.node_count(); ++node) {
      largest = std::max(largest, math::norm(ours.position(node) - bare.position(node)));
      fell = std::max(fell, 0.12 - ours.position(node).z);
    }
  }
  EXPECT_LT(largest, 1e-9);
  EXPECT_GT(fell, 0.2);
  remove(world, ours);
}

}  // namespace
}  // namespace ambf::physics
