// Meshes with far more triangles near each other than can be compared one by one, as scans of anatomy and tools are:
// about 77,000 triangles each, 0.5 mm long. They rest, slide and resist as solid bodies do, at a cost that hardly
// depends on their number.
#include <gtest/gtest.h>

#include <random>

#include "tests/physics/mesh_scene.h"

namespace ambf::physics {
namespace {

using namespace testing;

const math::Vec3 kSize{0.056, 0.056, 0.04};
constexpr double kSunk = 1e-4;  // m, what docs/solver.md promises

TestMesh floor_mesh() { return sheet_mesh(0.1, 200); }
TestMesh block_mesh() { return box_mesh(kSize, 113); }
TestMesh ring() { return ring_mesh(0.03, 0.01, 240, 160); }

// Hills 3 cm apart.
TestMesh hilly(TestMesh mesh, double height) {
  for (math::Vec3& v : mesh.vertices) v.z += height * std::sin(v.x / 0.005) * std::cos(v.y / 0.0045);
  return mesh;
}

TestMesh noisy(TestMesh mesh, double noise) {
  std::mt19937 random(5);
  const auto draw = [&] { return noise * (2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0); };
  for (math::Vec3& v : mesh.vertices) v = v + math::Vec3{draw(), draw(), draw()};
  return mesh;
}

// A second to settle; then nothing sinks, creeps or trembles for ten.
void expect_rest(Scene& scene, std::size_t i, double moves = 2e-5) {
  run(scene.world, 1.0);
  const math::Pose before = scene[i].com_pose();
  double fastest = 0.0;
  for (int k = 0; k < 10000; ++k) {
    scene.world.step();
    fastest = std::max(fastest, math::norm(scene[i].twist().linear));
  }
  EXPECT_LT(math::norm(scene[i].com_pose().position - before.position), moves);
  EXPECT_LT(fastest, 500.0 * moves);
}

TEST(FineMesh, RestsOnAFineMesh) {
  const math::Quat turned = math::from_rpy(0, 0, 0.3);
  for (const math::Quat& turn : {math::Quat{}, turned}) {
    Scene scene({mesh_body(0.0, floor_mesh(), {}), mesh_body(0.3, block_mesh(), {0.002, 0.003, 0.0225}, turn)});
    expect_rest(scene, 1);
    EXPECT_NEAR(scene[1].com_pose().position.z, 0.5 * kSize.z + 2 * kMargin, kSunk);
  }
  Scene scene({mesh_body(0.0, floor_mesh(), {}), mesh_body(0.3, ring(), {0.002, 0.003, 0.0125})});
  expect_rest(scene, 1);
  EXPECT_NEAR(scene[1].com_pose().position.z, 0.01 + 2 * kMargin, kSunk);
}

// Surfaces with an inside, and one that faces inward.
TEST(FineMesh, RestsOnSolidsAndInARoom) {
  const double half = 0.5 * kSize.z;
  Scene solids(
      {mesh_body(0.0, block_mesh(), {0, 0, -half}), mesh_body(0.3, block_mesh(), {0.003, 0.002, half + 0.0022})});
  expect_rest(solids, 1);
  EXPECT_NEAR(solids[1].com_pose().position.z, half + 2 * kMargin, kSunk);
  Scene rings({mesh_body(0.0, ring(), {0, 0, -0.01}), mesh_body(0.3, ring(), {0, 0, 0.0122})});
  expect_rest(rings, 1);
  EXPECT_NEAR(rings[1].com_pose().position.z, 0.01 + 2 * kMargin, kSunk);
  Scene room({mesh_body(0.0, box_mesh({0.1, 0.1, 0.1}, 200).turned(), {}),
              mesh_body(0.3, block_mesh(), {0.003, 0.002, -0.05 + half + 0.0022})});
  expect_rest(room, 1);
  EXPECT_NEAR(room[1].com_pose().position.z, -0.05 + half + 2 * kMargin, kSunk);
}

TEST(FineMesh, RestsOnHills) {
  Scene on_hills(
      {mesh_body(0.0, hilly(floor_mesh(), 0.003), {}), mesh_body(0.3, block_mesh(), {0.002, 0.003, 0.0275})});
  expect_rest(on_hills, 1);
  EXPECT_NEAR(on_hills[1].com_pose().position.z, 0.003 + 0.02 + 2 * kMargin, 3e-4);  // some of which is a slope
  Scene ring_on_hills({mesh_body(0.0, hilly(floor_mesh(), 0.003), {}), mesh_body(0.3, ring(), {0.002, 0.003, 0.0185})});
  expect_rest(ring_on_hills, 1);
  // Hill on hill and valley in valley: it touches all over.
  Scene fitting(
      {mesh_body(0.0, hilly(floor_mesh(), 0.001), {}), mesh_body(0.3, hilly(block_mesh(), 0.001), {0, 0, 0.023})});
  expect_rest(fitting, 1);
  EXPECT_NEAR(fitting[1].com_pose().position.z, 0.02 + 2 * kMargin, kSunk);
}

TEST(FineMesh, RestsOnABox) {
  const BodyDefinition floor = parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1});
  Scene hills({floor, mesh_body(0.3, hilly(block_mesh(), 0.003), {0, 0, 0.0257})});
  expect_rest(hills, 1);
  EXPECT_NEAR(hills[1].com_pose().position.z, 0.003 + 0.02 + kMargin, kSunk);
  Scene round({floor, mesh_body(0.3, ring(), {0, 0, 0.0117})});
  expect_rest(round, 1);
  EXPECT_NEAR(round[1].com_pose().position.z, 0.01 + kMargin, kSunk);
}

// As scans are: a tenth of a millimetre of noise on a grid of half a millimetre.
TEST(FineMesh, RestsThoughNoisy) {
  for (const bool is_round : {false, true}) {
    Scene scene({mesh_body(0.0, noisy(floor_mesh(), 1e-4), {}),
                 mesh_body(0.3, noisy(is_round ? ring() : block_mesh(), 1e-4), {0, 0, is_round ? 0.0127 : 0.0227})});
    expect_rest(scene, 1, 4e-4);
    EXPECT_NEAR(scene[1].com_pose().position.z, (is_round ? 0.01 : 0.02) + 2 * kMargin, 2e-4 + kSunk);
  }
}

TEST(FineMesh, Stacks) {
  Scene scene({mesh_body(0.0, floor_mesh(), {}), mesh_body(0.3, ring(), {0.002, 0.003, 0.0125}),
               mesh_body(0.3, ring(), {0.002, 0.003, 0.0345}), mesh_body(0.3, block_mesh(), {0.002, 0.003, 0.0665})});
  expect_rest(scene, 3, 1e-4);
  EXPECT_NEAR(scene[3].com_pose().position.z, 0.03 + 0.02 + 8 * kMargin + 0.01 - 2 * kMargin, 3 * kSunk);
}

// Only edges meet, below the COM.
TEST(FineMesh, RestsEdgeOnEdge) {
  const double across = 0.5 * std::hypot(kSize.y, kSize.z), along = 0.5 * std::hypot(kSize.x, kSize.z);
  Scene scene({mesh_body(0.0, block_mesh(), {}, math::from_rpy(std::atan2(kSize.y, kSize.z), 0, 0)),
               mesh_body(0.3, block_mesh(), {0, 0, across + along + 0.003},
                         math::from_rpy(0, std::atan2(kSize.x, kSize.z), 0))});
  run(scene.world, 0.15);
  EXPECT_NEAR(scene[1].com_pose().position.z, across + along + 2 * kMargin, 2e-4);
}

TEST(FineMesh, SlidesAsItsFrictionSays) {
  for (const bool is_round : {false, true}) {
    const double height = (is_round ? 0.01 : 0.02) + 2 * kMargin;
    Scene scene({mesh_body(0.0, sheet_mesh(0.15, 300), {}),
                 mesh_body(0.3, is_round ? ring() : block_mesh(), {-0.02, 0.003, height + 1e-4})});
    run(scene.world, 0.2);
    const math::Vec3 before = scene[1].com_pose().position;
    scene[1].apply_impulse({0.12, 0, 0}, before);
    for (int i = 0; i < 300; ++i) {
      scene.world.step();
      EXPECT_NEAR(scene[1].com_pose().position.z, height, 5e-5);
    }
    // 0.4 m/s and the friction coefficient 0.25.
    const math::Vec3 way = scene[1].com_pose().position - before;
    EXPECT_NEAR(way.x, 0.16 / (2.0 * 0.25 * 9.81), 0.02 * way.x);
    EXPECT_NEAR(way.y, 0.0, 5e-4);
  }
}

TEST(FineMesh, IsNotPushedThrough) {
  for (const bool is_round : {false, true}) {
    const double half = is_round ? 0.01 : 0.02;
    Scene scene({mesh_body(0.0, hilly(floor_mesh(), 0.0005), {}),
                 mesh_body(0.3, is_round ? ring() : block_mesh(), {0.002, 0.003, half + 0.0035})});
    double lowest = 1.0;
    for (int i = 0; i < 2000; ++i) {
      // Pressed down with seventy times its weight, while being pushed about.
      scene[1].apply_force({10.0 * std::sin(0.01 * i), 10.0 * std::cos(0.013 * i), -200.0},
                           scene[1].com_pose().position);
      scene.world.step();
      lowest = std::min(lowest, scene[1].com_pose().position.z);
    }
    EXPECT_GT(lowest, half + kMargin);
  }
  // Falling on it with 1.5 m/s.
  Scene scene({mesh_body(0.0, floor_mesh(), {}),
               mesh_body(0.3, block_mesh(), {0.002, 0.003, 0.045}, math::from_rpy(0.3, 0.2, 0))});
  scene[1].set_twist({{0, 0, -1.5}, {}});
  run(scene.world, 2.0);
  EXPECT_GT(scene[1].com_pose().position.z, 0.02 + kMargin);
}

// What moves is looked at anew in every step or two; four times the triangles cost hardly more.
TEST(FineMesh, CostsNoMoreForMoreTriangles) {
  const auto cost = [](int cells) {
    Scene scene(
        {mesh_body(0.0, sheet_mesh(0.1, cells), {}), mesh_body(0.3, box_mesh(kSize, cells / 2), {-0.01, 0, 0.0221})});
    double sum = 0.0;
    for (int i = 0; i < 300; ++i) {
      scene[1].apply_force({0.2 * 9.81 * 0.3 * std::sin(0.1 * i) * 4.0, 0, 0}, scene[1].com_pose().position);
      const double start = thread_cpu_s();
      scene.world.step();
      if (i >= 100) sum += thread_cpu_s() - start;
    }
    return sum / 200;
  };
  const double coarser = cost(200), finer = cost(400);
  EXPECT_LT(finer, 2.5 * coarser) << coarser << " " << finer;
}

BodyDefinition floating(const SharedShape& shape, const math::Pose& at) {
  BodyDefinition p;
  p.mass = 0.2;
  p.shape = shape;
  p.T_world_body = at;
  p.gravity = math::Vec3{0, 0, 0};
  return p;
}

// Fine rings that cross each other all over take all the time there is for contacts; what rests elsewhere stays where
// it is.
TEST(FineMesh, CrowdsForgetNobody) {
  const SharedShape crossing = ring_mesh(0.05, 0.02, 256, 128).shape();
  const TestMesh brick = box_mesh({0.04, 0.04, 0.02}, 30);
  std::vector<BodyDefinition> all{mesh_body(0.0, sheet_mesh(0.3, 150), {})};
  for (int i = 0; i < 12; ++i) {
    BodyDefinition ring =
        floating(crossing, {{1.0 + 0.001 * i, 0.0004 * i, 1.0}, math::from_rpy(0.7 * i, 0.4 * i, 0.0)});
    all.push_back(ring);
    all.push_back(mesh_body(0.2, brick, {0.06 * (i % 4) - 0.09, 0.06 * (i / 4) - 0.06, 0.0121}));
  }
  Scene scene(all);
  double fastest = 0.0, lowest = 1.0;
  for (int i = 0; i < 3000; ++i) {
    for (std::size_t k = 1; k < all.size(); k += 2) {
      scene[k].set_twist({{}, {0.0, 0.0, k % 4 == 1 ? 0.5 : -0.5}});
      scene[k + 1].apply_force({0.2 * std::sin(0.02 * i), 0, 0}, scene[k + 1].com_pose().position);
    }
    scene.world.step();
    if (i < 500) continue;
    for (std::size_t k = 2; k < all.size(); k += 2) {
      lowest = std::min(lowest, scene[k].com_pose().position.z);
      fastest = std::max(fastest, math::norm(scene[k].twist().linear));
    }
  }
  EXPECT_GT(scene.world.crowded_steps(), 1000u);
  EXPECT_GT(lowest, 0.01 + 2 * kMargin - 3e-4);
  EXPECT_LT(fastest, 0.1);
}

std::vector<BodyDefinition> pile() {
  return {mesh_body(0.0, hilly(floor_mesh(), 0.002), {}), mesh_body(0.3, ring(), {0.002, 0.003, 0.0165}),
          mesh_body(0.3, block_mesh(), {0.006, 0.003, 0.0505}, math::from_rpy(0.1, 0, 0.2))};
}

TEST(FineMesh, IsDeterministicAndContinuesAlikeAfterASnapshot) {
  Scene one(pile()), other(pile());
  for (Scene* scene : {&one, &other}) run(scene->world, 0.5);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(one[i].com_pose() == other[i].com_pose());
  std::vector<std::byte> saved;
  one.world.save_state(saved);
  run(other.world, 0.1);
  ASSERT_TRUE(other.world.restore_state(saved));
  for (Scene* scene : {&one, &other}) run(scene->world, 0.5);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(one[i].com_pose() == other[i].com_pose());
}

}  // namespace
}  // namespace ambf::physics
