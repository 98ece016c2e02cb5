#include "render/scene/scene_batches.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace ambf::render {
namespace {

using testing::matte;
using testing::SceneMaker;

const mesh::SurfaceMaterial kRed = matte(1, 0, 0), kBlue = matte(0, 0, 1);

TEST(SceneBatches, BodiesOfEqualMeshAndMaterialShareABatch) {
  SceneMaker scene;
  for (int i = 0; i < 5; ++i) scene.body(mesh::make_box(1, 1, 1), {{1.0 * i, 0, 0}, {}}, &kRed);
  scene.body(mesh::make_box(1, 1, 1), {}, &kBlue);
  scene.body(mesh::make_box(1, 1, 2), {}, &kRed);
  MeshIdentity meshes;
  const SceneBatches drawn = make_scene_batches(*scene.structure, meshes);
  ASSERT_EQ(drawn.batches.size(), 3U);
  EXPECT_EQ(drawn.batches[0].instances.size(), 5U);
  EXPECT_EQ(drawn.batches[0].mesh, drawn.batches[1].mesh);
}

TEST(SceneBatches, PartsHaveColoursOfTheirOwn) {
  SceneMaker scene;
  const std::uint32_t body = scene.body(mesh::make_box(1, 1, 1), {}, &kRed);
  auto look = std::make_shared<mesh::Appearance>(*scene.structure->bodies[body].appearance);
  look->parts.push_back({look->parts[0].mesh, {}, 1.0, kBlue});
  scene.structure->bodies[body].appearance = look;
  MeshIdentity meshes;
  const SceneBatches drawn = make_scene_batches(*scene.structure, meshes);
  ASSERT_EQ(drawn.batches.size(), 2U) << "the same mesh in two colours";
  EXPECT_EQ(drawn.batches[0].surface.diffuse[0], 1.0F);
  EXPECT_EQ(drawn.batches[1].surface.diffuse[2], 1.0F);
}

TEST(SceneBatches, MeshesThatAreNoLongerNamedAreLetGo) {
  auto mesh = std::make_shared<mesh::Mesh>(mesh::make_box(1, 1, 1));
  const std::weak_ptr<const mesh::Mesh> watch = mesh;
  MeshIdentity meshes;
  {
    SceneMaker scene;
    scene.body(std::move(mesh), {}, &kRed);
    make_scene_batches(*scene.structure, meshes);
  }
  EXPECT_FALSE(watch.expired());
  make_scene_batches(*SceneMaker().structure, meshes);
  EXPECT_TRUE(watch.expired());
}

TEST(SceneBatches, ARepresentativeStaysWhileItsEqualsAreNamed) {
  const auto first = std::make_shared<mesh::Mesh>(mesh::make_box(1, 1, 1));
  const auto second = std::make_shared<mesh::Mesh>(mesh::make_box(1, 1, 1));
  MeshIdentity meshes;
  SceneMaker both, one;
  both.body(first, {}, &kRed);
  both.body(second, {}, &kRed);
  one.body(second, {}, &kRed);
  const auto shared = make_scene_batches(*both.structure, meshes).batches.at(0).mesh;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(make_scene_batches(*one.structure, meshes).batches.at(0).mesh, shared);
}

TEST(SceneBatches, TransparentThingsComeFarToNear) {
  mesh::SurfaceMaterial glass = kRed;
  glass.alpha = 0.5F;
  SceneMaker scene;
  for (const double x : {1.0, -3.0, 2.0}) scene.body(mesh::make_box(0.1, 1, 1), {{x, 0, 0}, {}}, &glass);
  MeshIdentity meshes;
  const SceneBatches drawn = make_scene_batches(*scene.structure, meshes);
  DrawList list;
  fill_draw_list(drawn, scene.bodies, nullptr, {5.0, 0, 0}, {}, list);
  ASSERT_EQ(list.transparent.size(), 3U);
  std::vector<float> x;
  for (const DrawCommand& command : list.transparent) x.push_back(list.instances[command.first].rows[3]);
  EXPECT_EQ(x, (std::vector<float>{-3.0F, 1.0F, 2.0F}));
}

TEST(SceneBatches, OpaqueThingsComeNearToFarAndTheGroundLast) {
  SceneMaker maker;
  const mesh::SurfaceMaterial grey = testing::matte(0.5F, 0.5F, 0.5F);
  maker.body(mesh::make_box(10.0, 10.0, 0.1), {}, &grey);
  for (const double x : {-1.0, 1.0, 0.0}) maker.body(mesh::make_box(0.1, 0.1, 0.1), {{x, 0, 0.1}, {}}, &grey);
  maker.body(mesh::make_sphere(0.1), {{1.5, 0, 0.1}, {}}, &grey);
  MeshIdentity meshes;
  DrawList list;
  fill_draw_list(make_scene_batches(*maker.structure, meshes), maker.bodies, nullptr, {3, 0, 0.1}, {}, list);
  EXPECT_EQ(list.bodies, (std::vector<std::uint32_t>{0, 2, 3, 1, 4}));  // of each batch from near to far
  ASSERT_EQ(list.opaque.size(), 3U);
  std::vector<std::uint32_t> order;
  for (const DrawCommand& command : list.opaque) order.push_back(list.bodies[command.first]);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{4, 2, 0}));
  EXPECT_GE(list.opaque[0].reach_m, 1.6);
  EXPECT_LT(list.opaque[0].reach_m, 1.7);
}

TEST(SceneBatches, WhatTheNearPlaneCutsIsNotSeenFromOutside) {
  Camera camera;
  camera.T_world_camera = {{3.0, 0.0, 0.0}, {}};
  camera.near_m = 0.5;
  const Frustum frustum(projection_matrix(camera, 1.0) * view_matrix(camera.T_world_camera));
  for (const auto& [x, outside] : {std::pair{2.0, true}, std::pair{2.4, false}, std::pair{2.6, false}}) {
    SceneMaker scene;
    scene.body(mesh::make_sphere(0.2), {{x, 0, 0}, {}}, &kRed);
    MeshIdentity meshes;
    DrawList list;
    fill_draw_list(make_scene_batches(*scene.structure, meshes), scene.bodies, &frustum, camera.T_world_camera.position,
                   {}, list);
    ASSERT_EQ(list.opaque.size(), 1U) << x;
    EXPECT_EQ(list.opaque[0].seen_from_outside, outside) << x;
  }
}

TEST(SceneBatches, HiddenBodiesAreLeftOutAndSeeThroughOnesComeLast) {
  SceneMaker scene;
  for (int i = 0; i < 4; ++i) scene.body(mesh::make_box(1, 1, 1), {{1.0 * i, 0, 0}, {}}, &kRed);
  MeshIdentity meshes;
  const SceneBatches drawn = make_scene_batches(*scene.structure, meshes);
  DrawList list;
  fill_draw_list(drawn, scene.bodies, nullptr, {}, {{}, {false, false, 0.4F}, {true, false, 1.0F}}, list);
  EXPECT_EQ(list.bodies, (std::vector<std::uint32_t>{0, 3, 1})) << "beyond the list: as loaded";
  ASSERT_EQ(list.opaque.size(), 1U);
  EXPECT_EQ(list.opaque[0].count, 2U);
  ASSERT_EQ(list.transparent.size(), 1U);
  EXPECT_EQ(list.transparent[0].first, 2U);
  EXPECT_EQ(list.transparent[0].opacity, 0.4F);
}

TEST(SceneBatches, AHugeFloorDoesNotCountAsTheSceneUnlessItIsAlone) {
  SceneMaker scene;
  scene.body(mesh::make_plane({0, 0, 1}, 0.0), {}, &kRed);
  MeshIdentity meshes;
  EXPECT_GT(bounds_of(make_scene_batches(*scene.structure, meshes), scene.bodies).radius, 50.0);
  scene.body(mesh::make_sphere(0.2), {{1, 1, 1}, {}}, &kRed);
  const Sphere bounds = bounds_of(make_scene_batches(*scene.structure, meshes), scene.bodies);
  EXPECT_LT(bounds.radius, 0.5);
  EXPECT_NEAR(bounds.centre.x, 1.0, 1e-9);
}

TEST(Surface, AdfColoursWinOverTheMeshButItsTextureStays) {
  mesh::Material own;
  own.diffuse = {0, 1, 0, 0.5F};
  own.texture_file = "wood.png";
  EXPECT_EQ(surface_of(&own, nullptr).diffuse[1], 1.0F);
  EXPECT_EQ(surface_of(&own, nullptr).alpha, 0.5F);
  const Surface given = surface_of(&own, &kRed);
  EXPECT_EQ(given.diffuse[0], 1.0F);
  EXPECT_EQ(given.diffuse[1], 0.0F);
  EXPECT_EQ(given.alpha, 1.0F);
  EXPECT_EQ(given.texture_file, "wood.png");
}

}  // namespace
}  // namespace ambf::render
