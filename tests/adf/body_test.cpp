#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

const scene::Body& only_body(const ModelResult& result) {
  static const scene::Body kNone;
  if (!result.model || result.model->bodies.size() != 1) {
    ADD_FAILURE() << all_of(result.diagnostics);
    return kNone;
  }
  return result.model->bodies.front();
}

TEST(Body, DefaultsAreThoseOfTheReference) {
  const ModelResult result = parse_body_keys("mass: 2.5");
  const scene::Body& body = only_body(result);
  EXPECT_EQ(body.mass, 2.5);
  EXPECT_EQ(body.scale, 1.0);
  EXPECT_EQ(body.surface.friction, 0.5);
  EXPECT_EQ(body.surface.rolling_friction, 0.01);
  EXPECT_EQ(body.surface.restitution, 0.1);
  EXPECT_EQ(body.surface.linear_damping, 0.04);
  EXPECT_EQ(body.surface.angular_damping, 0.1);
  EXPECT_EQ(body.collision.margin, 0.001);
  EXPECT_FALSE(body.inertia);
  EXPECT_FALSE(body.inertial_offset);
  EXPECT_FALSE(body.gravity);
  EXPECT_FALSE(body.visual.material);
  EXPECT_EQ(body.identity.rate_low_hz, 50.0);
  EXPECT_EQ(body.identity.rate_high_hz, 1000.0);
  EXPECT_TRUE(body.publish_joint_names);
  EXPECT_FALSE(body.publish_children_names);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Body, EveryKeyArrives) {
  const ModelResult result = parse_body_keys(
      "mass: 3, inertia: {ix: 1, iy: 2, iz: 3}, inertial offset: {position: {x: 1, y: 0, z: 0}, orientation: {r: 0, p: "
      "0, y: 0}},"
      "gravity: {x: 0, y: 0, z: -1}, location: {position: {x: 1, y: 2, z: 3}, orientation: {r: 0.1, p: 0.2, y: 0.3}}, "
      "scale: 2,"
      "friction: {static: 0.1, rolling: 0.2}, restitution: 0.3, damping: {linear: 0.4, angular: 0.5}, collision "
      "margin: 0.002,"
      "collision groups: [1, 5, 1], passive: true, publish frequency: {low: 10, high: 20}, publish children names: 1,"
      "publish joint names: 'False', publish joint positions: off, visible: no");
  const scene::Body& body = only_body(result);
  EXPECT_EQ(*body.inertia, (math::Vec3{1, 2, 3}));
  EXPECT_EQ(body.inertial_offset->position, (math::Vec3{1, 0, 0}));
  EXPECT_EQ(*body.gravity, (math::Vec3{0, 0, -1}));
  EXPECT_EQ(body.T_world_body.position, (math::Vec3{1, 2, 3}));
  EXPECT_NEAR(body.T_world_body.orientation.w, 0.9833, 1e-4);
  EXPECT_EQ(body.scale, 2.0);
  EXPECT_EQ(body.visual.scale, 2.0);
  EXPECT_EQ(body.collision.scale, 2.0);
  EXPECT_EQ(body.surface.friction, 0.1);
  EXPECT_EQ(body.surface.rolling_friction, 0.2);
  EXPECT_EQ(body.surface.restitution, 0.3);
  EXPECT_EQ(body.surface.linear_damping, 0.4);
  EXPECT_EQ(body.surface.angular_damping, 0.5);
  EXPECT_EQ(body.collision.margin, 0.002);
  EXPECT_EQ(body.collision.groups, (std::vector<int>{1, 5}));
  EXPECT_TRUE(body.identity.passive);
  EXPECT_EQ(body.identity.rate_high_hz, 20.0);
  EXPECT_TRUE(body.publish_children_names);
  EXPECT_FALSE(body.publish_joint_names);
  EXPECT_FALSE(body.publish_joint_positions);
  EXPECT_FALSE(body.visual.visible);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(BodyController, GivenChannelMakesForcesAndTheAbsentOneKeepsVelocity) {
  const ModelResult result = parse_body_keys("mass: 1, controller: {linear: {P: 50, D: 5}}");
  const scene::Body& body = only_body(result);
  EXPECT_EQ(body.linear.output, scene::ControllerOutput::force);
  EXPECT_EQ(body.linear.p, (math::Vec3{50, 50, 50}));
  EXPECT_EQ(body.linear.i, (math::Vec3{0, 0, 0}));
  EXPECT_EQ(body.angular.output, scene::ControllerOutput::velocity);
  EXPECT_EQ(body.angular.p, (math::Vec3{10, 10, 10}));
  EXPECT_EQ(body.angular.d, (math::Vec3{1, 1, 1}));
}

TEST(BodyController, OutputTypeSetsBothChannelsAndGainsMayDifferByAxis) {
  const ModelResult result =
      parse_body_keys("mass: 1, controller: {angular: {P: {x: 1, y: 2, z: 3}}}, controller output type: POSITION");
  const scene::Body& body = only_body(result);
  EXPECT_EQ(body.linear.output, scene::ControllerOutput::position);
  EXPECT_EQ(body.angular.output, scene::ControllerOutput::position);
  EXPECT_EQ(body.angular.p, (math::Vec3{1, 2, 3}));
}

TEST(BodyController, OutputTypeAloneHasNoEffectAndIsSaid) {
  const ModelResult result = parse_body_keys("mass: 1, controller output type: FORCE");
  EXPECT_EQ(only_body(result).linear.output, scene::ControllerOutput::velocity);
  EXPECT_TRUE(
      says(result.diagnostics, "warning: \\[BODY A: controller output type\\] has no effect without `controller`"));
}

TEST(Shapes, CollisionShapeGoesBeforeCompoundAndCompoundBeforeMesh) {
  const std::string both =
      "mass: 1, mesh: a.stl, compound collision shape: [{shape: SPHERE, geometry: {radius: 2}, offset: {position: {x: "
      "0, y: 0, z: 1}}}]";
  const ModelResult compound = parse_body_keys(both);
  ASSERT_EQ(only_body(compound).collision.shapes.size(), 1u);
  EXPECT_EQ(only_body(compound).collision.shapes[0].geometry.shape, scene::Shape::sphere);
  EXPECT_EQ(only_body(compound).collision.shapes[0].offset.position, (math::Vec3{0, 0, 1}));
  EXPECT_EQ(only_body(compound).collision.mesh_file, "");
  EXPECT_EQ(only_body(compound).visual.mesh_file, "a.stl");
  const ModelResult single =
      parse_body_keys(both + ", collision shape: box, collision geometry: {x: 1, y: 2, z: 3}, collision offset: {}");
  ASSERT_EQ(only_body(single).collision.shapes.size(), 1u);
  EXPECT_EQ(only_body(single).collision.shapes[0].geometry.shape, scene::Shape::box);
  EXPECT_EQ(only_body(single).collision.shapes[0].geometry.size, (math::Vec3{1, 2, 3}));
  EXPECT_TRUE(only_body(single).collision.offset);
}

TEST(Shapes, CompoundsHoldMeshesBesidePrimitives) {
  const ModelResult result = parse_body_keys(
      "mass: 1, scale: 2, high resolution path: high, low resolution path: low, compound shape: [{shape: MESH, "
      "geometry: "
      "{mesh: a.stl, scale: 0.5}, offset: {position: {x: 1, y: 2, z: 3}}}, {shape: sphere, geometry: {radius: 1}}, "
      "{shape: mesh, geometry: {mesh: b.stl, scale: {x: 1, y: -2, z: 3}}}], "
      "compound collision shape: [{shape: MESH, geometry: {mesh: c.stl}}]");
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
  const scene::Body& body = only_body(result);
  ASSERT_EQ(body.visual.meshes.size(), 2u);
  EXPECT_EQ(body.visual.shapes.size(), 1u);
  EXPECT_EQ(body.visual.meshes[0].file, "high/a.stl");
  EXPECT_EQ(body.visual.meshes[0].scale, (math::Vec3{0.5, 0.5, 0.5}));
  EXPECT_EQ(body.visual.meshes[0].offset.position, (math::Vec3{1, 2, 3}));
  EXPECT_EQ(body.visual.meshes[1].scale, (math::Vec3{1, -2, 3}));
  ASSERT_EQ(body.collision.meshes.size(), 1u);
  EXPECT_EQ(body.collision.meshes[0].file, "low/c.stl");
  EXPECT_EQ(body.collision.meshes[0].scale, (math::Vec3{1, 1, 1}));
}

TEST(Shapes, WrongMeshesOfCompoundsAreSaid) {
  const auto said = [](const std::string& geometry) {
    return parse_body_keys("mass: 1, compound shape: [{shape: MESH, geometry: " + geometry + "}]").diagnostics;
  };
  EXPECT_TRUE(says(said("{scale: 2}"), "3:.*error: .*compound shape\\[0\\]/geometry/mesh\\] missing"));
  EXPECT_TRUE(says(said("{mesh: a.stl, scale: {x: 1, y: 0, z: 1}}"), "error: .*geometry/scale\\] expected no 0"));
  EXPECT_TRUE(says(said("{mesh: a.stl, radius: 1}"), "warning: .*radius\\] has no effect"));
  EXPECT_TRUE(says(parse_body_keys("mass: 1, shape: BOX, geometry: {x: 1, y: 1, z: 1, mesh: a.stl}").diagnostics,
                   "warning: .*mesh\\] has no effect"));
}

TEST(Shapes, AllSixAreRead) {
  const ModelResult result = parse_body_keys(
      "mass: 1, compound shape: [{shape: Box, geometry: {x: 1, y: 1, z: 1}}, {shape: sphere, geometry: {radius: 1}},"
      "{shape: CYLINDER, geometry: {radius: 1, height: 2, axis: X}}, {shape: Cone, geometry: {radius: 1, height: 2}},"
      "{shape: capsule, geometry: {radius: 1, height: 4, axis: y}}, {shape: PLANE, geometry: {normal: {x: 0, y: 1, z: "
      "0}, offset: 3}}]");
  const auto& shapes = only_body(result).visual.shapes;
  ASSERT_EQ(shapes.size(), 6u);
  EXPECT_EQ(shapes[2].geometry.axis, scene::Axis::x);
  EXPECT_EQ(shapes[3].geometry.axis, scene::Axis::z);
  EXPECT_EQ(shapes[4].geometry.height, 4.0);
  EXPECT_EQ(shapes[5].geometry.normal, (math::Vec3{0, 1, 0}));
  EXPECT_EQ(shapes[5].geometry.offset, 3.0);
}

TEST(Shapes, ShapeWithoutItsSizesDropsTheBodyAndNamesThem) {
  EXPECT_TRUE(says(parse_body_keys("mass: 1, collision shape: BOX").diagnostics,
                   "error: \\[BODY A: collision shape\\] expected `collision geometry` beside it"));
  const ModelResult sphere = parse_body_keys("mass: 1, shape: SPHERE, geometry: {x: 1}");
  EXPECT_TRUE(says(sphere.diagnostics, "error: \\[BODY A: geometry/radius\\] missing; 'SPHERE' needs it"));
  EXPECT_TRUE(sphere.model->bodies.empty());
}

TEST(Shapes, FlatShapeGetsATenthOfAMillimetreAndANegativeSizeIsAnError) {
  const ModelResult flat = parse_body_keys("mass: 1, collision shape: BOX, collision geometry: {x: 1, y: 1, z: 0.0}");
  EXPECT_EQ(only_body(flat).collision.shapes[0].geometry.size, (math::Vec3{1, 1, 1e-4}));
  EXPECT_TRUE(says(flat.diagnostics, "warning: \\[BODY A: collision geometry/z\\] nearly 0"));
  EXPECT_TRUE(parse_body_keys("mass: 1, shape: SPHERE, geometry: {radius: -1}").model->bodies.empty());
}

TEST(Shapes, DrawnOnlyBodySaysThatItCollidesWithNothing) {
  EXPECT_TRUE(says(parse_body_keys("mass: 1, shape: BOX, geometry: {x: 1, y: 1, z: 1}").diagnostics,
                   "info: .*collides with nothing"));
}

TEST(Shapes, UnknownAxisFallsBackToZWithAWarning) {
  const ModelResult result =
      parse_body_keys("mass: 1, collision shape: cylinder, collision geometry: {radius: 1, height: 1, axis: w}");
  EXPECT_EQ(only_body(result).collision.shapes[0].geometry.axis, scene::Axis::z);
  EXPECT_TRUE(says(result.diagnostics, "warning: .*collision geometry/axis\\] expected x, y or z, found 'w'"));
}

TEST(Body, CollisionMeshTypesOfAllSpellings) {
  const std::pair<const char*, scene::CollisionMeshType> spellings[] = {
      {"CONVEX_HULL", scene::CollisionMeshType::convex_hull},
      {"hull", scene::CollisionMeshType::convex_hull},
      {"convex_mesh", scene::CollisionMeshType::convex_mesh},
      {"trimesh", scene::CollisionMeshType::triangle_mesh},
      {"CONCAVE_MESH", scene::CollisionMeshType::triangle_mesh},
      {"point_cloud", scene::CollisionMeshType::point_cloud}};
  for (const auto& [word, type] : spellings) {
    EXPECT_EQ(only_body(parse_body_keys(std::string("mass: 1, collision mesh type: ") + word)).collision.mesh_type,
              type)
        << word;
  }
}

TEST(Body, WhatIsNotSimulatedYetIsSaid) {
  const ModelResult result = parse_body_keys("mass: 1, plugins: [{name: a, filename: b}]");
  EXPECT_TRUE(says(result.diagnostics, "info: \\[BODY A: plugins\\] plugins are not loaded yet"));
  EXPECT_EQ(only_body(result).mass, 1.0);
}

TEST(Body, ValuesThatAreHardlyMeantAreSaid) {
  EXPECT_TRUE(says(parse_body_keys("mass: 1, shape: Box, geometry: {x: 1, y: 1, z: 1, radius: 3}").diagnostics,
                   "warning: \\[BODY .*: geometry/radius\\] has no effect on a shape of type 'Box' .*`x`, `y`, `z`"));
  const ModelResult turned =
      parse_body_keys("mass: 1, location: {position: {x: 100, y: 0, z: 0}, orientation: {r: 90, p: 12, y: 0}}");
  EXPECT_TRUE(says(turned.diagnostics, "warning: \\[BODY .*: location/orientation/r\\] more than two turns"));
  EXPECT_FALSE(says(turned.diagnostics, "orientation/p"));
  EXPECT_FALSE(says(turned.diagnostics, "position"));
  EXPECT_TRUE(says(parse_body_keys("mass: 1, controller: {linear: {P: -5, D: 1}}").diagnostics,
                   "warning: \\[BODY .*: controller/linear/P\\] a negative gain"));
}

TEST(Body, OfSeveralWaysToSayWhatIsDrawnOrCollidesThoseThatDoNotCountAreTold) {
  const std::string box = "shape: BOX, geometry: {x: 1, y: 1, z: 1}";
  const ModelResult both =
      parse_body_keys("mass: 1, mesh: a.stl, " + box +
                      ", collision shape: SPHERE, collision geometry: {radius: 1}, collision mesh: b.stl");
  EXPECT_TRUE(says(both.diagnostics, "info: \\[BODY .*: mesh\\] not used: `shape` counts"));
  EXPECT_TRUE(says(both.diagnostics, "info: \\[BODY .*: collision mesh\\] not used: `collision shape` counts"));
  // Drawn as a box, it collides as the mesh; and drawn as the mesh, as a box.
  EXPECT_FALSE(says(parse_body_keys("mass: 1, mesh: a.stl, " + box).diagnostics, "not used"));
  EXPECT_FALSE(says(
      parse_body_keys("mass: 1, mesh: a.stl, collision shape: BOX, collision geometry: {x: 1, y: 1, z: 1}").diagnostics,
      "not used"));
}

}  // namespace
}  // namespace ambf::adf
