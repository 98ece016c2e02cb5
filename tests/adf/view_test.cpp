#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

WorldResult parse_view(const std::string& camera, const std::string& light = "name: l") {
  Options options;
  options.look_for_files = false;
  return parse_world("cameras: [cam]\nlights: [light]\nnamespace: /w/\ncam: {" + camera + "}\nlight: {" + light + "}\n",
                     "world.yaml", options);
}

const scene::Camera& only_camera(const WorldResult& result) {
  static const scene::Camera kNone;
  if (!result.world || result.world->cameras.size() != 1) {
    ADD_FAILURE() << all_of(result.diagnostics);
    return kNone;
  }
  return result.world->cameras.front();
}

TEST(Camera, EveryKeyArrives) {
  const WorldResult result = parse_view(
      "name: c, parent: BODY A, location: {x: 1, y: 2, z: 3}, look at: {x: 0, y: 1, z: 0}, up: {x: 0, y: 1, z: 0}, "
      "clipping plane: {near: 0.5, far: 5},"
      "field view angle: 0.6, orthographic view width: 2, stereo: {mode: Passive, eye separation: 0.1, focal length: "
      "0.3},"
      "controlling devices: [Falcon], monitor: 1, visible: false, publish image: true, publish image interval: 3,"
      "publish image resolution: {width: 320, height: 240}, publish depth: true, publish depth interval: 4, publish "
      "depth noise: {mean: 1, std dev: 2, bias: 3},"
      "preprocessing shaders: {path: s, vertex: v, fragment: f}, multipass: true, mouse control multipliers: {pan: 2, "
      "arcball: 3}");
  const scene::Camera& camera = only_camera(result);
  EXPECT_EQ(camera.parent, "BODY A");
  EXPECT_EQ(camera.location, (math::Vec3{1, 2, 3}));
  EXPECT_EQ(camera.look_at, (math::Vec3{0, 1, 0}));
  EXPECT_EQ(camera.lens.near_m, 0.5);
  EXPECT_EQ(camera.lens.far_m, 5.0);
  EXPECT_EQ(camera.lens.field_of_view_rad, 0.6);
  EXPECT_EQ(camera.lens.orthographic_width_m, 2.0);
  EXPECT_TRUE(camera.lens.stereo);
  EXPECT_TRUE(camera.lens.orthographic);
  EXPECT_EQ(camera.lens.eye_separation_m, 0.1);
  EXPECT_EQ(camera.controlling_devices, (std::vector<std::string>{"Falcon"}));
  EXPECT_EQ(camera.monitor, 1u);
  EXPECT_FALSE(camera.visible);
  EXPECT_TRUE(camera.image.on);
  EXPECT_EQ(camera.image.interval, 3u);
  EXPECT_EQ(camera.image.width, 320u);
  EXPECT_EQ(camera.image.height, 240u);
  EXPECT_TRUE(camera.depth.on);
  EXPECT_EQ(camera.depth.interval, 4u);
  EXPECT_EQ(camera.depth_noise.std_dev, 2.0);
  EXPECT_EQ(camera.preprocessing_shaders.vertex, "v");
  EXPECT_TRUE(camera.multipass);
  EXPECT_EQ(camera.mouse.pan, 2.0);
  EXPECT_EQ(camera.mouse.rotate, 1.0);
  EXPECT_EQ(camera.mouse.arcball, 3.0);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Camera, WithoutDirectionIsDropped) {
  const WorldResult result = parse_view("name: c, location: {x: 1, y: 0, z: 0}, look at: {x: 1, y: 0, z: 0}");
  EXPECT_TRUE(result.world->cameras.empty());
  EXPECT_TRUE(says(result.diagnostics, "error: \\[cam: look at\\] expected a point away from `location`"));
}

TEST(Camera, LookingAlongUpGetsAnotherUp) {
  const WorldResult result = parse_view("name: c, location: {x: 0, y: 0, z: 3}");
  EXPECT_EQ(only_camera(result).up, (math::Vec3{1, 0, 0}));
  EXPECT_TRUE(says(result.diagnostics, "warning: .*looks along its own up direction"));
}

TEST(Camera, NearBeyondFarIsAnError) {
  EXPECT_TRUE(says(parse_view("name: c, location: {x: 1, y: 0, z: 0}, clipping plane: {near: 20}").diagnostics,
                   "error: \\[cam: clipping plane\\] expected near below far"));
}

TEST(Camera, PoseSyntaxOfBodiesIsAnErrorThatNamesTheVector) {
  EXPECT_TRUE(says(parse_view("name: c, location: {position: {x: 1, y: 0, z: 0}}").diagnostics,
                   "error: \\[cam: location\\] expected a vector \\{x, y, z\\}, found no `x`"));
}

TEST(Light, EveryKeyArrives) {
  const WorldResult result =
      parse_view("name: c, location: {x: 1, y: 0, z: 0}",
                 "name: l, namespace: lights/, parent: P, location: {x: 1, y: 2, z: 3}, direction: {x: 0, y: 3, z: 0}, "
                 "spot exponent: 0.3,"
                 "cutoff angle: 1.2, shadow quality: 5, attenuation: {constant: 2, linear: 3, quadratic: 4}");
  ASSERT_EQ(result.world->lights.size(), 1u) << all_of(result.diagnostics);
  const scene::Light& light = result.world->lights[0];
  EXPECT_EQ(light.identity.name_space, "/w/lights/");
  EXPECT_EQ(light.parent, "P");
  EXPECT_EQ(light.direction, (math::Vec3{0, 1, 0}));
  EXPECT_EQ(light.beam.spot_exponent, 0.3);
  EXPECT_EQ(light.beam.cutoff_angle_rad, 1.2);
  EXPECT_EQ(light.beam.shadow_quality, 5);
  EXPECT_EQ(light.beam.attenuation_quadratic, 4.0);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Light, ShadowQualityBeyondFiveIsFive) {
  const WorldResult result = parse_view("name: c, location: {x: 1, y: 0, z: 0}", "name: l, shadow quality: 9");
  EXPECT_EQ(result.world->lights.at(0).beam.shadow_quality, 5);
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[light: shadow quality\\] expected 0 to 5, found 9"));
}

TEST(Views, WhatHasNoEffectYetIsSaid) {
  Options options;
  options.look_for_files = false;
  const WorldResult result = parse_world(
      "cameras: [C]\nplugins: [{name: p, filename: libp.so}]\nC: {name: C, "
      "location: {x: "
      "1, y: 0, z: 0}, depth compute shaders: {path: ., vertex: a.vs, fragment: a.fs}, multipass: false}\n",
      "w.yaml", options);
  ASSERT_TRUE(result.world);
  EXPECT_TRUE(says(result.diagnostics, "w.yaml:2:1: info: \\[plugins\\] plugins are not loaded yet"));
  EXPECT_EQ(all_of(result.diagnostics).find("depth compute"), std::string::npos);
  EXPECT_EQ(all_of(result.diagnostics).find("multipass"), std::string::npos) << "it asks for nothing";
}

}  // namespace
}  // namespace ambf::adf
