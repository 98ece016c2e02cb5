// What files made for the original carry beside the reference, and what is made of each: no such value costs the
// object.
#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

const scene::Body& only_body(const ModelResult& result) {
  EXPECT_TRUE(result.model) << all_of(result.diagnostics);
  EXPECT_EQ(result.model->bodies.size(), 1u) << all_of(result.diagnostics);
  return result.model->bodies.at(0);
}

WorldResult parse_world_text(const std::string& text) {
  Options options;
  options.look_for_files = false;
  return parse_world(text, "/w/world.yaml", options);
}

TEST(Habits, EmptyTextsAreAsIfTheKeysWereNotThere) {
  const ModelResult result = parse_body_keys(
      "mesh: '', collision mesh: '', collision mesh type: '', shape: '', collision shape: '', color: '', "
      "controller output type: '', high resolution path: '', mass: '', passive: '', namespace: '', scale: '', "
      "collision margin: '', visible: '', location: '', inertia: '', friction: {static: ''}, collision groups: ''");
  const scene::Body& body = only_body(result);
  EXPECT_EQ(body.collision.mesh_type, scene::CollisionMeshType::triangle_mesh);
  EXPECT_EQ(body.mass, 1.0);
  EXPECT_EQ(body.scale, 1.0);
  EXPECT_EQ(body.surface.friction, 0.5);
  EXPECT_FALSE(body.inertia);
  EXPECT_TRUE(body.visual.visible);
  EXPECT_EQ(result.diagnostics.size(), 1u) << all_of(result.diagnostics);  // of the mass, as where it is absent
  EXPECT_TRUE(says(result.diagnostics, "info: \\[BODY A: mass\\] missing; 1 kg is assumed"));
}

TEST(Habits, EmptyTextsOfHeadersAndListsAreAsIfTheyWereNotThere) {
  const ModelResult model = parse(
      "adf version: ''\nnamespace: /t/\nbodies: [BODY A, '']\njoints: ''\ngravity: ''\nhigh resolution path: ''\n"
      "shaders: ''\nBODY A: {name: A, mass: 1}\n");
  EXPECT_EQ(only_body(model).identity.name, "A");
  EXPECT_FALSE(model.model->gravity);
  EXPECT_TRUE(model.diagnostics.empty()) << all_of(model.diagnostics);
  const WorldResult world =
      parse_world_text("namespace: /t/\nenvironment: ''\nsolver: ''\nskybox: ''\nenclosure: ''\nlights: ''\n");
  ASSERT_TRUE(world.world);
  EXPECT_TRUE(world.diagnostics.empty()) << all_of(world.diagnostics);
}

TEST(Habits, JointWithoutABodyIsDroppedAlsoWhenItsNameIsEmpty) {
  const ModelResult result = parse(
      "joints: [J]\nnamespace: /t/\nJ: {name: J, type: fixed, parent: '', child: B, parent pivot: {x: 0, y: 0, z: 0}, "
      "child pivot: {x: 0, y: 0, z: 0}, parent axis: {x: 0, y: 0, z: 1}, child axis: {x: 0, y: 0, z: 1}}\n");
  EXPECT_TRUE(result.model->joints.empty());
  EXPECT_TRUE(says(result.diagnostics, "error: \\[J: parent\\] missing; expected text"));
}

TEST(Habits, UnknownCollisionMeshTypeIsAWarningAndTheBodyStays) {
  const ModelResult result = parse_body_keys("mass: 1, collision mesh type: CONVEX");
  EXPECT_EQ(only_body(result).collision.mesh_type, scene::CollisionMeshType::triangle_mesh);
  EXPECT_TRUE(says(result.diagnostics,
                   "warning: \\[BODY A: collision mesh type\\] expected one of: CONVEX_HULL.*found the text 'CONVEX' "
                   "\\(.*CONCAVE_MESH is used\\)"));
}

TEST(Habits, UnknownShapeIsLeftOutWithAWarningAndTheBodyStays) {
  const ModelResult result = parse_body_keys(
      "mass: 1, shape: Spere, geometry: {radius: 1}, compound collision shape: [{shape: BOX, geometry: {x: 1, y: 1, z: "
      "1}}, {shape: Torus, geometry: {radius: 1}}]");
  const scene::Body& body = only_body(result);
  EXPECT_TRUE(body.visual.shapes.empty());
  ASSERT_EQ(body.collision.shapes.size(), 1u);
  EXPECT_EQ(body.collision.shapes[0].geometry.shape, scene::Shape::box);
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[BODY A: shape\\] .*did you mean `Sphere`\\? it is left out"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[BODY A: compound collision shape\\[1\\]/shape\\] .*'Torus'"));
}

TEST(Habits, UnknownSolverIsAWarningAndTheDefault) {
  const WorldResult result = parse_world_text("solver: nncg\n");
  ASSERT_TRUE(result.world);
  EXPECT_EQ(result.world->solver, "");
  EXPECT_TRUE(
      says(result.diagnostics, "warning: \\[solver\\] expected one of: direct, si, mlcp, found the text 'nncg'"));
}

TEST(Habits, OutputTypeGoesBeforeControllerAndAnUnknownOneIsForce) {
  const auto joint = [](const std::string& keys) { return parse_joint_keys(keys).model->joints.at(0).controller; };
  EXPECT_EQ(joint("controller: {P: 20, D: 1}, controller output type: VELOCITY").output,
            scene::ControllerOutput::velocity);
  EXPECT_EQ(joint("controller: {P: 20, D: 1}, controller output type: TORQUE").output, scene::ControllerOutput::force);
  EXPECT_TRUE(says(parse_joint_keys("controller output type: TORQUE").diagnostics,
                   "warning: \\[JOINT J: controller output type\\] .*FORCE is used"));
  const ModelResult body =
      parse_body_keys("mass: 1, controller: {linear: {P: 20, D: 1}}, controller output type: VELOCITY");
  EXPECT_EQ(only_body(body).linear.output, scene::ControllerOutput::velocity);
}

TEST(Habits, BodyListedTwiceIsMadeOnceWithAWarning) {
  const ModelResult result =
      parse("bodies: [A, B, A]\nnamespace: /t/\nA: {name: Box, mass: 1}\nB: {name: B, mass: 1}\n");
  ASSERT_EQ(result.model->bodies.size(), 2u);
  EXPECT_EQ(result.model->bodies[0].identity.name, "Box");
  EXPECT_EQ(result.diagnostics.size(), 1u) << all_of(result.diagnostics);
  EXPECT_TRUE(says(result.diagnostics, "model.yaml:1:16: warning: \\[A\\] listed twice in `bodies`"));
}

TEST(Habits, UnlistedBlocksAndMapsWithAnchorsAtTheTopAreSilent) {
  const ModelResult result = parse(
      "bodies: [A]\nnamespace: /t/\ncam common configs: {near: &n 0.1}\ncollision geometry: &g {radius: 1}\n"
      "shape geometry: {a: &a {radius: 1}}\ncontroller: {P: &p 10}\nshader: {x: [&x 1]}\n"
      "A: {name: A, mass: 1, collision shape: SPHERE, collision geometry: *g, controller: {linear: {P: *p}}}\n"
      "light3: {name: light3}\n");
  EXPECT_EQ(only_body(result).linear.p.x, 10.0);
  EXPECT_TRUE(result.diagnostics.empty()) << all_of(result.diagnostics);
}

TEST(Habits, KeysThatTheOriginalNeverReadAreInformation) {
  EXPECT_TRUE(
      says(parse_world_text("conversion factor: 0.1\n").diagnostics, "info: \\[conversion factor\\] has no effect"));
  EXPECT_TRUE(says(parse_body_keys("mass: 1, color: random").diagnostics, "info: \\[BODY A: color\\] .*never read"));
}

TEST(Habits, GainsUnderAnotherKeyAreAWarningWhateverStandsInThem) {
  const ModelResult result = parse_joint_keys("controller gains: {P: 20, I, 0., D: 0.1}");
  EXPECT_EQ(result.model->joints.size(), 1u);
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[JOINT J: controller gains\\] unknown key"));
}

TEST(Habits, KeysOfExportersAreRead) {
  const ModelResult p2p =
      parse_joint_keys("detached: False, redundant: True, offset: \"0.5\", joint offset: 0.25", "p2p");
  EXPECT_EQ(p2p.model->joints.at(0).child_offset, 0.5);
  EXPECT_EQ(p2p.model->joints.at(0).joint_offset, 0.25);
  EXPECT_TRUE(no_worse_than_information(p2p.diagnostics));
  const ModelResult item = parse_body_keys(
      "mass: \"2\", passive: True, compound collision shape: [{name: 5, shape: SPHERE, geometry: {radius: 1}}]");
  EXPECT_EQ(only_body(item).mass, 2.0);
  EXPECT_TRUE(only_body(item).identity.passive);
  EXPECT_TRUE(no_worse_than_information(item.diagnostics));
}

TEST(Habits, NamesKeepSlashesAndNamespacesOfWorldCamerasAreAppended) {
  EXPECT_EQ(
      only_body(parse("bodies: [B]\nnamespace: ambf/env/psm/\nB: {name: tool id/400006, mass: 1}\n")).identity.name,
      "toolid/400006");
  const WorldResult world = parse_world_text(
      "namespace: /ambf/env/\ncameras: [c]\nc: {name: c, namespace: cameras/, location: {x: 1, y: 0, z: 0}}\n");
  EXPECT_EQ(world.world->cameras.at(0).identity.name_space, "/ambf/env/cameras/");
}

TEST(Habits, CollisionGroupsBeyondTheirRangeAreLeftOut) {
  const ModelResult result = parse_body_keys("mass: 1, collision groups: [0, 1000, -1]");
  EXPECT_EQ(only_body(result).collision.groups, std::vector<int>{0});
  EXPECT_EQ(count(result.diagnostics, base::Severity::warning), 2u) << all_of(result.diagnostics);
  EXPECT_TRUE(no_worse_than_information(parse_body_keys("mass: 1, collision groups: []").diagnostics));
}

TEST(Habits, FurtherKeysOfPluginsAreTheirOwn) {
  const ModelResult result =
      parse_body_keys("mass: 1, plugins: [{name: a, filename: b, path: c, crtk_config: d, blackout: true}]");
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Habits, MissingColourFileIsAWarningAndATableWithoutNames) {
  const ColorsResult result = load_colors("/no/such/colors.yaml");
  ASSERT_TRUE(result.colors);
  EXPECT_TRUE(result.colors->empty());
  EXPECT_FALSE(base::has_errors(result.diagnostics));
  EXPECT_TRUE(says(result.diagnostics, "/no/such/colors.yaml: warning: cannot be read: no such file"));
}

TEST(Habits, ListsAtTheIndentOfTheirKeyAndMapsOverLinesAreAccepted) {
  const ModelResult result = parse(
      "namespace: /t/\nbodies:\n- BODY A\nBODY A:\n  name: A\n  mass: 1\n  friction: {static: 0.3,\n    rolling: 0}\n");
  EXPECT_EQ(only_body(result).surface.friction, 0.3);
}

}  // namespace
}  // namespace ambf::adf
