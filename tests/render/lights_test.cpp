#include "render/scene/lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "render/shaders/shaders.h"
#include "scenes.h"
#include "state/kinds.h"

namespace ambf::render {
namespace {

std::vector<Light> lights_of(const testing::SceneMaker& scene) {
  ScenePoses poses;
  poses.placed.resize(state::kind_count());
  poses.placed[static_cast<std::size_t>(state::ObjectKind::light)] = scene.lights;
  return render::lights_of(*scene.structure, poses, {});
}

TEST(Lights, ShineAlongXOfTheirFrame) {
  testing::SceneMaker scene;
  scene.light({{1, 2, 3}, math::rotation_between({1, 0, 0}, {0, 0, -1})});
  const std::vector<Light> lights = lights_of(scene);
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_NEAR(lights[0].direction_world.z, -1.0, 1e-12);
  EXPECT_EQ(lights[0].point_world.z, 3.0);
}

TEST(Lights, AWorldWithoutLightsIsNotDark) { EXPECT_EQ(lights_of(testing::SceneMaker()).size(), 1U); }

TEST(Lights, ManyLightsDoNotBurnThePictureOut) {
  testing::SceneMaker scene;
  for (int i = 0; i < 20; ++i) scene.light({{0, 0, 3}, {}}).beam.shadow_quality = i == 0 ? 3 : 0;
  double sum = 0.0;
  const std::vector<Light> lights = lights_of(scene);
  EXPECT_EQ(lights.size(), static_cast<std::size_t>(kMaxLights));
  for (const Light& light : lights) sum += light.intensity;
  EXPECT_LT(sum, 2.0);
  EXPECT_GT(lights[0].intensity, lights[1].intensity);  // the one with shadows is the key light
}

TEST(Lights, TheShadowCameraSeesTheWholeScene) {
  Light light;
  light.point_world = {2, 2, 5};
  light.direction_world = {0, 0, -1};
  light.cutoff_angle_rad = 1.2;
  const Sphere scene{{0.3, -0.2, 0.1}, 1.0};
  for (const state::LightType kind : {state::LightType::spot, state::LightType::point, state::LightType::directional}) {
    light.kind = kind;
    const std::vector<Camera> cameras = shadow_cameras(light, scene);
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].orthographic_width_m > 0.0, kind == state::LightType::directional);
    const Mat4 m = projection_matrix(cameras[0], 1.0) * view_matrix(cameras[0].T_world_camera);
    for (const math::Vec3& axis : {math::Vec3{1, 0, 0}, math::Vec3{0, 1, 0}, math::Vec3{0, 0, 1}}) {
      for (const double side : {-0.99, 0.99}) {
        const auto clip = transform(m, scene.centre + side * scene.radius * axis);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(std::abs(clip[i]), clip[3]);
      }
    }
  }
}

TEST(Lights, InsideTheSceneTheShadowCameraLooksWhereTheLightShines) {
  Light light;
  light.direction_world = {0, 0, -1};
  light.cutoff_angle_rad = 0.5;
  const std::vector<Camera> cameras = shadow_cameras(light, {{0, 0, 0}, 2.0});
  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_NEAR(backward(cameras[0].T_world_camera).z, 1.0, 1e-9);
  EXPECT_NEAR(cameras[0].field_of_view_rad, 1.0, 1e-9);
  EXPECT_GT(cameras[0].near_m, 0.0);
}

TEST(Lights, APointLightInsideTheSceneLooksAllAround) {
  Light light;
  light.kind = state::LightType::point;
  light.point_world = {0.1, 0.2, 0.3};
  const std::vector<Camera> cameras = shadow_cameras(light, {{0, 0, 0}, 2.0});
  ASSERT_EQ(cameras.size(), 6U);
  for (int i = 0; i < 200; ++i) {  // every direction is seen by the view of its greatest component
    const math::Vec3 d{std::sin(1.0 + i), std::sin(2.0 + 1.7 * i), std::sin(0.5 + 2.3 * i)};
    const double size[3] = {std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    const std::size_t axis = static_cast<std::size_t>(std::max_element(size, size + 3) - size);
    const double part[3] = {d.x, d.y, d.z};
    const Camera& camera = cameras[2 * axis + (part[axis] > 0.0 ? 0 : 1)];
    const Mat4 m = projection_matrix(camera, 1.0) * view_matrix(camera.T_world_camera);
    const auto clip = transform(m, light.point_world + math::normalized(d));
    EXPECT_GT(clip[3], 0.0);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_LE(std::abs(clip[k]), clip[3]) << i;
  }
}

TEST(Lights, NothingToSeeNeedsNoShadow) { EXPECT_TRUE(shadow_cameras({}, {{}, -1.0}).empty()); }

}  // namespace
}  // namespace ambf::render
