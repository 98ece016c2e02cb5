#include <cmath>

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

// Keys of AMBF 3.0.
WorldResult parse_projection(const std::string& keys) {
  return parse_view("name: c, location: {x: 1, y: 0, z: 0}, field view angle: 0.3, " + keys);
}

TEST(Camera, IntrinsicsGiveTheAngleOfView) {
  const WorldResult middle = parse_projection(
      "window resolution: {width: 800, height: 600}, camera intrinsics: {fx: 500, fy: 500, cx: 400, cy: 300, s: 0}");
  EXPECT_NEAR(only_camera(middle).lens.field_of_view_rad, 2.0 * std::atan(0.6), 1e-12);
  EXPECT_TRUE(no_worse_than_information(middle.diagnostics)) << all_of(middle.diagnostics);
  EXPECT_EQ(only_camera(middle).image.width, 800u) << "of images, too";
  EXPECT_EQ(only_camera(parse_projection("window resolution: {width: 800, height: 600}, publish image resolution: "
                                         "{width: 320, height: 240}"))
                .image.width,
            320u);
  EXPECT_NEAR(only_camera(parse_projection("camera intrinsics: {f: 240}")).lens.field_of_view_rad, 2.0 * std::atan(1.0),
              1e-12);
  EXPECT_EQ(only_camera(parse_projection("window resolution: {width: 8, height: 6}")).lens.field_of_view_rad, 0.3);
}

// As AMBF 3.0's matrix for a window of 640 x 480 has it.
TEST(Camera, IntrinsicsPlaceTheAxisAndTheFocalLengths) {
  const WorldResult result = parse_projection("camera intrinsics: {fx: 600, fy: 500, cx: 368, cy: 216, s: 20}");
  EXPECT_TRUE(no_worse_than_information(result.diagnostics)) << all_of(result.diagnostics);
  const state::Lens& lens = only_camera(result).lens;
  EXPECT_NEAR(lens.field_of_view_rad, 2.0 * std::atan(0.48), 1e-12);
  EXPECT_NEAR(lens.optics.focal_ratio, 1.2, 1e-12);
  EXPECT_NEAR(lens.optics.axis_right, 48.0 / 480.0, 1e-12);
  EXPECT_NEAR(lens.optics.axis_down, -24.0 / 480.0, 1e-12);
  EXPECT_NEAR(lens.optics.skew, -20.0 / 500.0, 1e-12) << "s counts upwards";
  const WorldResult matrix = parse_projection(
      "projection matrix: [[1.875, 0.0625, -0.15, 0], [0, 2.0833333333333333, -0.1, 0], [0, 0, -1.5, -0.25], "
      "[0, 0, -1, 0]]");
  EXPECT_TRUE(no_worse_than_information(matrix.diagnostics)) << all_of(matrix.diagnostics);
  const state::Optics& same = only_camera(matrix).lens.optics;
  EXPECT_NEAR(same.focal_ratio, lens.optics.focal_ratio, 1e-12);
  EXPECT_NEAR(same.axis_right, lens.optics.axis_right, 1e-12);
  EXPECT_NEAR(same.axis_down, lens.optics.axis_down, 1e-12);
  EXPECT_NEAR(same.skew, lens.optics.skew, 1e-12);
  EXPECT_EQ(only_camera(parse_projection("camera intrinsics: {fy: 500}")).lens.optics, state::Optics{})
      << "one focal length is both";
}

TEST(Camera, IntrinsicsOutOfRangeAreErrorsAndTheAngleCounts) {
  for (const auto& [wrong, message] : std::initializer_list<std::pair<const char*, const char*>>{
           {"f: 1e-9", "intrinsics/f\\] expected .* pixels of the `window resolution`, found 1e-09"},
           {"fx: 5, fy: 5000", "intrinsics/fx\\] expected 50 to 5e.05 pixels"},
           {"f: 500, cx: 6000", "intrinsics/cx\\] expected -4480 to 5120 pixels .*found 6000"},
           {"f: 500, cy: -5000", "intrinsics/cy\\] expected -4560 to 5040 pixels"},
           {"fx: 400, fy: 500, s: 450", "intrinsics/s\\] expected -400 to 400 pixels"}}) {
    const WorldResult result = parse_projection("camera intrinsics: {" + std::string(wrong) + "}");
    EXPECT_EQ(only_camera(result).lens.field_of_view_rad, 0.3) << wrong;
    EXPECT_EQ(only_camera(result).lens.optics, state::Optics{}) << wrong;
    EXPECT_TRUE(says(result.diagnostics, "world.yaml:4:[0-9]+: error: \\[cam: camera " + std::string(message)))
        << all_of(result.diagnostics);
  }
  const WorldResult parallel = parse_projection("orthographic view width: 2, camera intrinsics: {f: 500}");
  EXPECT_TRUE(says(parallel.diagnostics, "warning: .*camera intrinsics\\] has no effect beside"));
}

TEST(Camera, ProjectionMatrixGivesAngleOfViewAndClippingPlanes) {
  const auto rows = [](const std::string& third, const std::string& fourth) {
    return parse_projection("projection matrix: [[1.5, 0, 0, 0], [0, 2, 0, 0], " + third + ", " + fourth + "]");
  };
  const WorldResult result = rows("[0, 0, -1.5, -0.25]", "[0, 0, -1, 0]");
  EXPECT_NEAR(only_camera(result).lens.field_of_view_rad, 2.0 * std::atan(0.5), 1e-12);
  EXPECT_NEAR(only_camera(result).lens.near_m, 0.1, 1e-12);
  EXPECT_NEAR(only_camera(result).lens.far_m, 0.5, 1e-12);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics)) << all_of(result.diagnostics);
  for (const WorldResult& ignored :
       {rows("[0, 0, -1, 0]", "[0, 0, 0, 1]"), rows("[0, 0, -0.5, -0.2]", "[0, 0, -1, 0]"),
        rows("[0, 0, .nan, -0.2]", "[0, 0, -1, 0]"), rows("[0, 0, -1.5, -0.25]", "[0, 0.1, -1, 0]"),
        parse_projection("projection matrix: [[1, 2], [3, 4]]"), parse_projection("projection matrix: unit")}) {
    EXPECT_EQ(only_camera(ignored).lens.field_of_view_rad, 0.3);
    EXPECT_TRUE(says(ignored.diagnostics, "error: .*projection matrix\\] expected four rows.*ignored"));
  }
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
