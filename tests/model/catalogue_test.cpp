// What loading makes of descriptions: names, look-ups, diagnostics, removal, centres of mass.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "math/rotation.h"
#include "mesh/appearance.h"
#include "rig.h"
#include "tests/support/views.h"

namespace ambf::model::test {
namespace {

using state::ObjectKind;

// The one finding of at least this severity, as text.
std::string finding(const base::Diagnostics& found, base::Severity severity) {
  for (const base::Diagnostic& diagnostic : found)
    if (diagnostic.severity == severity) return base::to_string(diagnostic);
  return "";
}

scene::Model pair_of(const std::string& file) {
  return model(file, {box("base", 0.0, {0, 0, 0}), box("arm", 1.0, {0.2, 0, 0})}, {joint("hinge", "base", "arm")});
}

TEST(Names, OfTheSameFileLoadedTwentyTimesGetNumbersAndEachJointItsOwnBodies) {
  Rig rig;
  for (int i = 0; i < 20; ++i) {
    const Prepared prepared = rig.load(pair_of("arm.yaml"));
    EXPECT_FALSE(base::has_errors(prepared.diagnostics));
    EXPECT_FALSE(base::has_warnings(prepared.diagnostics));
    EXPECT_EQ(prepared.model, i == 0 ? "arm.yaml" : "arm.yaml" + std::to_string(i));
  }
  const state::Structure& structure = *rig.live->structure();
  std::set<std::string> names;
  for (const auto& object : structure.objects) names.insert(object.name);
  for (int i = 0; i < 20; ++i) {
    const std::string number = i == 0 ? "" : std::to_string(i);
    EXPECT_EQ(names.count("/test/arm" + number), 1u) << number;
    EXPECT_EQ(rig.children_names("base" + number), (std::vector<std::string>{"/test/arm" + number}));
  }
  EXPECT_EQ(structure.objects.at(rig.object("arm7")).identifier, "/test/BODY arm7");
  EXPECT_EQ(structure.joints.size(), 20u);
  for (const auto& each : structure.joints) EXPECT_EQ(each.name, "hinge");
  rig.step(20);
}

TEST(Names, AreFreeAgainAfterUnloading) {
  Rig rig;
  rig.load(pair_of("arm.yaml"));
  rig.load(pair_of("arm.yaml"));
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_unload("arm.yaml")).success);
  EXPECT_EQ(rig.object("arm"), state::kNone);
  EXPECT_NE(rig.object("arm1"), state::kNone);
  EXPECT_EQ(rig.load(pair_of("arm.yaml")).model, "arm.yaml");
  EXPECT_NE(rig.object("arm"), state::kNone);
}

TEST(Names, OfTheWorldTopicAndOfOtherKindsAreNotTakenTwice) {
  Rig rig;
  scene::Model odd = model("odd.yaml", {box("World", 0.0, {0, 0, 0}), box("eye", 0.0, {1, 0, 0})});
  odd.cameras.push_back(test_camera());
  rig.load(odd);
  EXPECT_EQ(rig.live->structure()->world_name, "/test/World");
  std::set<std::string> names;
  for (const auto& object : rig.live->structure()->objects) names.insert(object.name);
  EXPECT_EQ(names, (std::set<std::string>{"/test/World1", "/test/eye", "/test/eye1"}));
}

TEST(Loading, PrefixesNamesAndPlacesTheModel) {
  Rig rig;
  LoadOptions options;
  options.name_prefix = "/left/";
  options.T_world_model = {{0, 0, 2}, math::from_rpy(0, 0, std::acos(-1.0) / 2)};
  rig.load(pair_of("arm.yaml"), options);
  const std::uint32_t arm = state::find(*rig.live->structure(), "/left/test/arm", ObjectKind::rigid_body);
  ASSERT_NE(arm, state::kNone);
  const math::Vec3 at = rig.frame->bodies[rig.live->structure()->objects[arm].slot].T_world_body.position;
  EXPECT_LT(math::norm(at - math::Vec3{0, 0.2, 2}), 1e-12);
  EXPECT_EQ(rig.live->structure()->joints.size(), 1u);
}

TEST(Loading, GivesAPoolOfFramesThatFit) {
  Rig rig;
  const Prepared prepared = rig.catalogue.prepare_load(pair_of("arm.yaml"));
  ASSERT_EQ(prepared.frames.size(), base::kFramesPerPool);
  for (const auto& frame : prepared.frames) {
    EXPECT_EQ(frame->bodies.size(), 2u);
    EXPECT_EQ(frame->joints.size(), 1u);
    EXPECT_EQ(frame->structure, prepared.structure);
    EXPECT_GE(frame->contacts.capacity(), base::kMaxContactsInFrame);
  }
}

TEST(JointLookUp, FindsBodiesOfAnotherFile) {
  Rig rig;
  rig.load(model("bodies.yaml", {box("base", 0.0, {0, 0, 0}), box("arm", 1.0, {0.2, 0, 0})}));
  const Prepared prepared = rig.load(model("joints.yaml", {}, {joint("hinge", "base", "arm")}));
  EXPECT_FALSE(base::has_errors(prepared.diagnostics));
  ASSERT_EQ(rig.info("base").joints.size(), 1u);
  rig.port("base")->post(joints({to_position(0.3)}));
  rig.step(2);
  EXPECT_GT(rig.joint_state("hinge").velocity, 0.1);
}

TEST(JointLookUp, PrefersTheFilesOwnBodiesAndItsOwnNumberInTheWorld) {
  Rig rig;
  rig.load(pair_of("arm.yaml"));
  rig.load(pair_of("arm.yaml"));
  // A file of joints, loaded twice: the second one's joint gets the number 1 and so finds the bodies with that number.
  scene::Joint second = joint("lock", "base", "arm", state::JointType::fixed);
  rig.load(model("locks.yaml", {}, {second}));
  rig.load(model("locks.yaml", {}, {second}));
  const state::Structure& structure = *rig.live->structure();
  ASSERT_EQ(structure.joints.size(), 4u);
  EXPECT_EQ(structure.joints[2].child_body, rig.slot("arm"));
  EXPECT_EQ(structure.joints[3].child_body, rig.slot("arm1"));
}

TEST(JointLookUp, AbsentAmbiguousAndSelfJointsAreLeftOutWithFileAndLine) {
  Rig rig;
  scene::Model bad = pair_of("bad.yaml");
  bad.joints[0].parent = "BODY bse";
  bad.joints[0].identity.where = {17, 3};
  Prepared prepared = rig.load(bad);
  std::string text = finding(prepared.diagnostics, base::Severity::error);
  EXPECT_NE(text.find("bad.yaml:17:3"), std::string::npos) << text;
  EXPECT_NE(text.find("BODY bse"), std::string::npos) << text;
  EXPECT_NE(text.find("did you mean \"BODY base\""), std::string::npos) << text;
  EXPECT_TRUE(prepared.success);
  EXPECT_EQ(rig.live->structure()->bodies.size(), 2u);
  EXPECT_EQ(rig.live->structure()->joints.size(), 0u);

  scene::Model ambiguous = model("two.yaml", {box("finger1", 1.0, {3, 0, 0}), box("finger2", 1.0, {4, 0, 0})});
  ambiguous.joints.push_back(joint("j", "finger1", "finger2"));
  ambiguous.joints[0].child = "finger";
  text = finding(rig.load(ambiguous).diagnostics, base::Severity::error);
  EXPECT_NE(text.find("ambiguous"), std::string::npos) << text;

  scene::Model self = pair_of("self.yaml");
  self.joints[0].child = "BODY base";
  text = finding(rig.load(self).diagnostics, base::Severity::error);
  EXPECT_NE(text.find("same body"), std::string::npos) << text;

  scene::Model flat = pair_of("flat.yaml");
  flat.joints[0].child_axis = {0, 0, 0};
  text = finding(rig.load(flat).diagnostics, base::Severity::error);
  EXPECT_NE(text.find("child axis"), std::string::npos) << text;
  EXPECT_EQ(rig.live->structure()->joints.size(), 0u);
  rig.step(5);
}

TEST(Removal, OfABodyTakesItsJointsOfAllFilesAndTheDescriptionWithIt) {
  Rig rig;
  rig.load(pair_of("arm.yaml"));
  rig.load(model("tool.yaml", {box("tool", 1.0, {0.4, 0, 0})}, {joint("wrist", "arm", "tool")}));
  EXPECT_EQ(rig.info("base").joints.size(), 2u);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("BODY arm")).success);
  EXPECT_TRUE(rig.live->structure()->joints.empty());
  EXPECT_TRUE(rig.info("base").children.empty());
  const scene::Model* arm = rig.catalogue.description(rig.live->structure()->models[0].id);
  ASSERT_NE(arm, nullptr);
  EXPECT_EQ(arm->bodies.size(), 1u);
  EXPECT_TRUE(arm->joints.empty());
  rig.step(10);
}

TEST(Removal, OfAJointLeavesItsBodies) {
  Rig rig({0, 0, -9.8});
  rig.load(pair_of("arm.yaml"));
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("/test/JOINT hinge")).success);
  EXPECT_EQ(rig.live->structure()->bodies.size(), 2u);
  rig.step(100);
  EXPECT_LT(rig.body("arm").T_world_body.position.z, -0.04);  // falls
}

TEST(Removal, OfWhatIsNotThereSaysSoAndChangesNothing) {
  Rig rig;
  rig.load(pair_of("arm.yaml"));
  const auto before = rig.catalogue.structure();
  for (const Prepared& refused : {rig.catalogue.prepare_remove("nobody"), rig.catalogue.prepare_unload("none.yaml"),
                                  rig.catalogue.prepare_remove("")}) {
    EXPECT_FALSE(refused.success);
    EXPECT_TRUE(base::has_errors(refused.diagnostics));
  }
  EXPECT_EQ(rig.catalogue.structure(), before);
}

TEST(World, HasItsOwnCameraAndLightEvenWhereTheFileNamesNone) {
  Rig rig;
  scene::World world;
  world.name_space = "/test/";
  rig.apply(rig.catalogue.prepare_world(world));
  ASSERT_EQ(rig.live->structure()->cameras.size(), 1u);
  ASSERT_EQ(rig.live->structure()->lights.size(), 1u);
  EXPECT_EQ(rig.live->structure()->objects[0].name, "/test/default_camera");
  EXPECT_EQ(rig.live->structure()->objects[0].model, state::kWorldModel);
  // A light shines along +x of its frame: the default one towards the ground.
  const math::Vec3 direction = math::rotate(rig.frame->lights[0].T_world_light.orientation, {1, 0, 0});
  EXPECT_LT(direction.z, -0.5);
}

// An open tetrahedron's worth of corners: the mean of the file's vertices is not its middle.
std::string write_stl(const std::string& name, const math::Vec3& shift) {
  const std::string path = (std::filesystem::path(testing::TempDir()) / name).string();
  std::ofstream out(path);
  const math::Vec3 v[4] = {shift, shift + math::Vec3{0.1, 0, 0}, shift + math::Vec3{0, 0.1, 0},
                           shift + math::Vec3{0, 0, 0.1}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  out << "solid t\n";
  for (const auto& face : faces) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) out << "vertex " << v[corner].x << ' ' << v[corner].y << ' ' << v[corner].z << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid t\n";
  return path;
}

TEST(CentreOfMass, IsTheMeanOfTheCollisionMeshWhereAbsentAndTheShapeMovesWithIt) {
  Rig rig;
  scene::Body body = box("a", 1.0, {0, 0, 0});
  body.collision.shapes.clear();
  body.visual.shapes.clear();
  body.collision.mesh_file = body.visual.mesh_file = write_stl("model_com.stl", {0.3, 0, 0});
  body.collision.mesh_type = scene::CollisionMeshType::convex_hull;
  body.scale = body.visual.scale = body.collision.scale = 2.0;
  rig.load(model("a", {body}));
  // Every corner belongs to three faces: the mean of the corners, twice as large.
  const math::Vec3 mean{2 * (0.3 + 0.1 / 4), 2 * 0.1 / 4, 2 * 0.1 / 4};
  EXPECT_LT(math::norm(rig.info("a").T_body_com.position - mean), 1e-6);
  // The body frame is the mesh's, and so is where the shape is: a ray along x meets it from x = 0.6 on.
  EXPECT_LT(math::norm(rig.body("a").T_world_body.position), 1e-9);
  rig.step();
  state::PickHit hit;
  ASSERT_TRUE(rig.live->pick(0, 1, {-1, 0.02, 0.02}, {2, 0.02, 0.02}, hit));
  EXPECT_NEAR(hit.point_world.x, 0.6, 0.003);
}

TEST(Meshes, ThatAreMissingLeaveTheBodyWithoutThem) {
  Rig rig;
  scene::Body body = box("a", 1.0, {0, 0, 1});
  body.visual.shapes.clear();
  body.collision.shapes.clear();
  body.visual.mesh_file = body.collision.mesh_file = "/nowhere/at_all.stl";
  body.identity.where = {5, 1};
  const Prepared prepared = rig.load(model("a.yaml", {body}));
  EXPECT_EQ(std::count_if(prepared.diagnostics.begin(), prepared.diagnostics.end(),
                          [](const auto& found) { return found.severity == base::Severity::error; }),
            1);
  EXPECT_NE(finding(prepared.diagnostics, base::Severity::error).find("a.yaml:5"), std::string::npos);
  rig.step(10);
  EXPECT_EQ(rig.info("a").appearance, nullptr);
}

TEST(Meshes, OfEqualBodiesAreShared) {
  Rig rig;
  const std::string file = write_stl("model_shared.stl", {0, 0, 0});
  scene::Model many = model("many.yaml", {});
  for (int i = 0; i < 5; ++i) {
    scene::Body body = box("a" + std::to_string(i), 1.0, {1.0 * i, 0, 0});
    body.visual.shapes.clear();
    body.collision.shapes.clear();
    body.visual.mesh_file = body.collision.mesh_file = file;
    many.bodies.push_back(body);
  }
  rig.load(many);
  rig.load(many);
  EXPECT_EQ(rig.meshes.statistics().decodes, 1u);
  EXPECT_EQ(rig.info("a0").appearance->parts[0].mesh, rig.info("a41").appearance->parts[0].mesh);
}

TEST(Collisions, AreIgnoredWithinAFileThatSaysSo) {
  for (const bool ignore : {false, true}) {
    Rig rig;
    scene::Model pile = model("pile.yaml", {box("a", 1.0, {0, 0, 0}), box("b", 1.0, {0.05, 0, 0})});
    pile.ignore_inter_collision = ignore;
    rig.load(pile);
    rig.step(2);
    EXPECT_EQ(rig.frame->contacts_total == 0, ignore);
  }
}

TEST(Rates, AreTheFilesOrTheCommandLines) {
  CommandTable commands;
  mesh::MeshCache meshes;
  CatalogueOptions options;
  options.rate_high_hz = 250.0;
  Catalogue catalogue(options, commands, meshes);
  scene::Body body = box("a", 1.0, {0, 0, 0});
  body.identity.rate_low_hz = 20.0;
  const Prepared prepared = catalogue.prepare_load(model("a", {body}));
  EXPECT_EQ(prepared.structure->objects[0].rate_low_hz, 20.0);
  EXPECT_EQ(prepared.structure->objects[0].rate_high_hz, 250.0);
}

TEST(Passive, JointsAreInTheLineageButNotInTheListOfJoints) {
  Rig rig;
  scene::Model arm = chain(3);
  arm.joints[0].identity.passive = true;
  rig.load(arm);
  EXPECT_EQ(rig.info("link0").children.size(), 2u);
  ASSERT_EQ(rig.info("link0").joints.size(), 1u);
  EXPECT_EQ(rig.live->structure()->joints[rig.info("link0").joints[0]].name, "j2");
}

// The lists of a chain's bodies are parts of one, whichever way it is loaded.
TEST(Catalogue, TheListsOfAChainTakeTheRoomOfOne) {
  for (const bool reversed : {false, true}) {
    Rig rig;
    scene::Model long_chain = chain(200);
    if (reversed) {
      std::reverse(long_chain.joints.begin(), long_chain.joints.end());
      std::reverse(long_chain.bodies.begin(), long_chain.bodies.end());
    }
    rig.load(long_chain);
    for (int i = 0; i < 199; ++i) {
      const state::BodyInfo& info = rig.info("link" + std::to_string(i));
      ASSERT_EQ(info.children.size(), static_cast<std::size_t>(199 - i));
      ASSERT_EQ(info.joints.size(), static_cast<std::size_t>(199 - i));
      EXPECT_TRUE(info.children.shares_storage_with(rig.info("link0").children)) << i;
      EXPECT_TRUE(info.joints.shares_storage_with(rig.info("link0").joints)) << i;
    }
  }
}

}  // namespace
}  // namespace ambf::model::test
