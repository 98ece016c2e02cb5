// What a user does in the panel, and what the simulation makes of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "panel_rig.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

std::vector<std::string> said(PanelRig& rig) { return rig.messages->shown(rig.now_ns); }

// --- 1: run control.

TEST(Panel, PausesAndRuns) {
  PanelRig rig;
  ASSERT_TRUE(rig.rig.frame().run.paused);
  rig.click("run/pause");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return !frame.run.paused; }));
  rig.click("run/pause");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.run.paused; }));
}

TEST(Panel, StepsOnceAndManyTimesAndBack) {
  PanelRig rig;
  const std::uint32_t start = rig.rig.frame().sim_step;
  rig.click("run/step");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == start + 1; }));
  const math::Pose before = rig.rig.body("BODY lower").T_world_body;
  rig.enter("run/steps", "25");
  rig.click("run/step_n");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == start + 26; }));
  rig.click("run/back");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == start + 1; }));
  EXPECT_TRUE(rig.rig.body("BODY lower").T_world_body == before);
  rig.click("run/back");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == start; }));
  EXPECT_FALSE(rig.model.can_step_back());
}

TEST(Panel, SetsTheSpeed) {
  PanelRig rig;
  rig.enter("run/speed", "0.5");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.run.speed_factor == 0.5; }));
}

// --- 2: resets and snapshots.

TEST(Panel, ResetsTheWorldAndWhatWasHeld) {
  PanelRig rig;
  rig.tab("Joints");
  rig.drag("joint/shoulder", 0.5, 0.9);
  rig.run(100);
  ASSERT_TRUE(rig.model.held.any());
  rig.click("run/reset");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.sim_step == 0; }));
  EXPECT_FALSE(rig.model.held.any());
}

TEST(Panel, ResetsOneBodyWithItsMechanism) {
  PanelRig rig;
  state::Push push;
  push.force_world = {3, 0, 0};
  push.seconds = 0.2;
  rig.model.push(rig.rig.id("BODY box"), push);
  rig.model.push(rig.rig.id("BODY lower"), push);
  rig.run(400);
  const double box = rig.rig.body("BODY box").T_world_body.position.x;
  rig.model.select(rig.rig.id("BODY lower"));
  EXPECT_EQ(rig.model.mechanism_of(rig.rig.id("BODY lower")).size(), 2u) << "upper and lower; the base is static";
  rig.pictures(2);
  rig.click("object/reset");
  EXPECT_TRUE(rig.until([&](const state::Frame& frame) {
    return frame.joints[rig.slot("elbow", state::ObjectKind::joint)].velocity == 0.0;
  }));
  EXPECT_NEAR(rig.rig.body("BODY lower").T_world_body.position.x, 0.0, 1e-9);
  EXPECT_EQ(rig.rig.body("BODY box").T_world_body.position.x, box);
}

TEST(Panel, TakesAndRestoresSnapshots) {
  PanelRig rig;
  rig.tab("Files");
  rig.click("snapshot/name");
  rig.type("here");
  rig.click("snapshot/take");
  ASSERT_TRUE(rig.rig.wait_until([&](const state::Frame&) { return !rig.model.snapshots().empty(); }));
  EXPECT_EQ(rig.model.snapshots(), std::vector<std::string>{"here"});
  const std::uint32_t step = rig.rig.frame().sim_step;
  rig.run(60);
  ASSERT_GT(rig.rig.frame().sim_step, step);
  rig.click("snapshot/restore/here");
  EXPECT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == step; }));
}

// --- 3, 16: selection and the tree.

TEST(Panel, SelectsInTheTreeAndGoesToTheParent) {
  PanelRig rig;
  rig.click("tree/search");
  rig.type("LOWER");
  rig.pictures(2);
  ASSERT_TRUE(rig.shown("tree//test/lower"));
  EXPECT_FALSE(rig.shown("tree//test/box"));
  rig.click("tree//test/lower");
  EXPECT_EQ(rig.model.selected(), rig.rig.id("BODY lower"));
  rig.click("object/parent");
  EXPECT_EQ(rig.model.selected(), rig.rig.id("BODY upper"));
  rig.click("object/parent");
  EXPECT_EQ(rig.model.selected(), rig.rig.id("BODY base"));
  EXPECT_FALSE(rig.model.parent_of(rig.rig.id("BODY base")).valid());
}

TEST(Panel, TheTreeShowsJointsBelowTheirBodies) {
  PanelRig rig;
  ObjectTree& tree = rig.model.tree;
  tree.take(rig.rig.simulation.structure());
  EXPECT_EQ(tree.row_of(rig.joint("elbow")), ObjectTree::kNoRow) << "closed at first";
  tree.reveal(rig.joint("elbow"));
  const std::size_t row = tree.row_of(rig.joint("elbow"));
  ASSERT_NE(row, ObjectTree::kNoRow);
  EXPECT_EQ(tree.rows()[row - 1].object, rig.rig.id("BODY upper"));
  tree.search("nothing like it");
  EXPECT_TRUE(tree.rows().empty());
}

TEST(Panel, ASelectionThatIsGoneIsNoSelection) {
  PanelRig rig;
  rig.model.select(rig.rig.id("BODY box"));
  rig.pictures(2);
  rig.click("object/remove");
  rig.click("object/remove_yes");
  EXPECT_TRUE(rig.until([&](const state::Frame& frame) {
    return state::find(*frame.structure, "BODY box", state::ObjectKind::rigid_body) == state::kNone;
  }));
  EXPECT_FALSE(rig.model.selected().valid());
  EXPECT_EQ(rig.model.selected_info(), nullptr);
}

// --- 4, 5: forces.

TEST(Panel, PushesWithForceTorqueAndLength) {
  PanelRig rig;
  rig.rig.simulation.set_gravity({});
  rig.model.select(rig.rig.id("BODY box"));
  rig.pictures(2);
  rig.click("section/Push");
  rig.enter("push/force/z", "2");
  rig.enter("push/seconds", "0.05");
  rig.click("push/go");
  rig.run(100);
  EXPECT_NEAR(rig.rig.body("BODY box").twist_world.linear.z, 0.1, 3e-3);
}

TEST(Panel, ShowsTheNewtonsOfADrag) {
  PanelRig rig;
  const state::ObjectId box = rig.rig.id("BODY box");
  rig.model.select(box);
  EXPECT_EQ(rig.model.pulled_by(box), 0.0);
  const auto port = rig.rig.simulation.make_pick_port();
  port->pick({0.5, 0, 3}, {0.5, 0, 0.5}, nullptr);
  port->drag({0.5, 0, 1.6});
  rig.run(40);
  ASSERT_FALSE(rig.rig.frame().picks.empty());
  EXPECT_TRUE(rig.shown("object/pull"));
  EXPECT_GT(rig.model.pulled_by(box), 0.0);
}

// --- 6: joints.

TEST(Panel, ASliderHoldsAJointUntilItIsLetGo) {
  PanelRig rig;
  rig.tab("Joints");
  rig.drag("joint/shoulder", 0.5, 0.75);
  const auto wanted = rig.model.held.held(rig.model.structure(), rig.slot("shoulder", state::ObjectKind::joint));
  ASSERT_TRUE(wanted);
  EXPECT_EQ(wanted->type, state::JointCommandType::position);
  EXPECT_NEAR(wanted->value, 0.75, 0.05);
  rig.run(2000);  // four times the watchdog's patience
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::position);
  EXPECT_NEAR(rig.joint_state("shoulder").position, wanted->value, 0.02);
  rig.click("joint/shoulder/release");
  rig.run(1000);
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::effort);
  EXPECT_LT(std::abs(rig.joint_state("shoulder").position), 0.7 * wanted->value) << "it hangs down again";
}

TEST(Panel, FieldsCommandVelocityAndEffort) {
  PanelRig rig;
  rig.model.hold_joint(rig.slot("shoulder", state::ObjectKind::joint), {state::JointCommandType::velocity, 0.5});
  rig.run(500);
  EXPECT_NEAR(rig.joint_state("shoulder").velocity, 0.5, 0.02);
  rig.model.hold_joint(rig.slot("shoulder", state::ObjectKind::joint), {state::JointCommandType::effort, 0.25});
  rig.run(20);
  EXPECT_EQ(rig.joint_state("shoulder").commanded, 0.25);
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::effort);
}

TEST(Panel, WhatIsTypedIntoAVelocityFieldCommandsIt) {
  PanelRig rig;
  rig.tab("Joints");
  rig.click("joint/elbow/mode");
  rig.key("Down");  // Velocity follows Position
  rig.key("Enter");
  rig.pictures(2);
  ASSERT_TRUE(rig.shown("joint/elbow/velocity"));
  rig.enter("joint/elbow/velocity", "0.4");
  rig.run(300);
  EXPECT_NEAR(rig.joint_state("elbow").velocity, 0.4, 0.02);
}

TEST(Panel, LettingOneJointGoKeepsTheOthersOfItsBody) {
  PanelRig rig;
  const std::uint32_t shoulder = rig.slot("shoulder", state::ObjectKind::joint);
  const std::uint32_t elbow = rig.slot("elbow", state::ObjectKind::joint);
  rig.model.hold_joint(shoulder, {state::JointCommandType::position, 0.3});
  rig.model.hold_joint(elbow, {state::JointCommandType::position, -0.4});
  rig.run(1500);
  EXPECT_NEAR(rig.joint_state("shoulder").position, 0.3, 0.02);
  EXPECT_NEAR(rig.joint_state("elbow").position, -0.4, 0.02);
  rig.model.held.release(rig.model.structure(), elbow);
  rig.run(1000);
  EXPECT_NEAR(rig.joint_state("shoulder").position, 0.3, 0.1);
  EXPECT_EQ(rig.joint_state("elbow").commanded_type, state::JointCommandType::effort);
  EXPECT_TRUE(rig.model.held.held(rig.model.structure(), shoulder));
}

TEST(Panel, AnotherClientTakesAJointOverByCommandingIt) {
  PanelRig rig;
  const std::uint32_t shoulder = rig.slot("shoulder", state::ObjectKind::joint);
  rig.model.hold_joint(shoulder, {state::JointCommandType::position, 0.3});
  rig.run(100);
  const auto ros = rig.rig.simulation.bind(rig.rig.id("BODY base"), state::Source::ros);
  state::RigidBodyCommand command;
  command.joints = {{state::JointCommandType::position, -0.2}};
  ros->post(command);
  rig.run(20);
  EXPECT_EQ(rig.joint_state("shoulder").commanded, -0.2);
  ros->release();
  rig.run(20);
  EXPECT_EQ(rig.joint_state("shoulder").commanded, 0.3) << "and gives it back";
}

TEST(Panel, PassiveJointsAreNotOffered) {
  PanelRig rig;
  ASSERT_TRUE(rig.rig.load(runtime::test::kScene).success);
  rig.rig.step(1);
  rig.tab("Joints");
  EXPECT_TRUE(rig.shown("joint/base-crank"));
  EXPECT_FALSE(rig.shown("joint/crank-coupler"));
  const std::string why =
      HeldJoints::refusal(rig.model.structure(), rig.slot("coupler-rocker", state::ObjectKind::joint));
  EXPECT_NE(why.find("passive"), std::string::npos);
}

// --- 8: layers.

TEST(Panel, SwitchesLayers) {
  PanelRig rig;
  rig.tab("View");
  rig.click("layer/Contacts", 0.1);
  EXPECT_TRUE(rig.layers.contacts);
  rig.click("layer/Contacts", 0.1);
  EXPECT_FALSE(rig.layers.contacts);
  for (const LayerSwitch& one : kLayerSwitches) EXPECT_TRUE(rig.shown("layer/" + std::string(one.label)));
}

// --- 10: views.

TEST(Panel, LooksFromTheSidesCentresAndCopiesTheCamera) {
  PanelRig rig;
  rig.tab("View");
  rig.click("view/Left");
  const math::Vec3 at = rig.view.camera().T_world_camera.position, target = target_of(rig.view.view());
  EXPECT_LT(at.y, target.y - 0.1);
  EXPECT_NEAR(at.x, target.x, 1e-6);
  rig.model.select(rig.rig.id("BODY box"));
  rig.pictures(2);
  rig.click("view/centre");
  EXPECT_LT(math::norm(target_of(rig.view.view()) - rig.rig.body("BODY box").T_world_body.position), 1e-6);
  rig.click("view/copy");
  EXPECT_NE(rig.clipboard.find("look at: {x: 0.5"), std::string::npos) << rig.clipboard;
}

TEST(Panel, ChangesLensesAndBeamsAndTakesThemBack) {
  PanelRig rig;
  const state::Structure& all = rig.model.structure();
  ASSERT_EQ(all.cameras.size(), 1u);
  ASSERT_EQ(all.lights.size(), 1u);
  rig.tab("View");
  rig.click("view/object//test/eye");
  rig.tab("Objects");
  rig.enter("lens/far", "25");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.cameras[0].lens.far_m == 25.0; }));
  rig.click("lens/revert");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.cameras[0].lens.far_m == 10.0; }));
  rig.enter("lens/near", "50");  // beyond the far plane: said, not done
  EXPECT_EQ(rig.rig.frame().cameras[0].lens.near_m, 0.1);
  const auto lines = said(rig);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& l) { return l.find("lens:") == 0; }));

  rig.model.select(all.objects[all.lights[0].object].id);
  rig.pictures(3);
  rig.enter("beam/cone", "30");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) {
    return std::abs(frame.lights[0].beam.cutoff_angle_rad - 0.5235987755982988) < 1e-9;
  }));
}

TEST(Panel, FollowsABody) {
  PanelRig rig;
  rig.rig.simulation.set_gravity({});
  rig.model.select(rig.rig.id("BODY box"));
  rig.tab("View");
  rig.click("view/follow", 0.1);
  const math::Vec3 before = rig.view.camera().T_world_camera.position;
  state::Push push;
  push.force_world = {0, 0, 5};
  push.seconds = 0.1;
  const double z = rig.rig.body("BODY box").T_world_body.position.z;
  rig.model.push(rig.rig.id("BODY box"), push);
  rig.run(500);
  rig.pictures(2);
  const double risen = rig.rig.body("BODY box").T_world_body.position.z - z;
  ASSERT_GT(risen, 0.1);
  EXPECT_NEAR(rig.view.camera().T_world_camera.position.z - before.z, risen, 1e-3);
}

// --- 9, 12: contacts and times.

TEST(Panel, ShowsContactsAndTimes) {
  PanelRig rig;
  rig.run(100);
  rig.tab("Physics");
  EXPECT_TRUE(rig.shown("physics/contacts"));
  EXPECT_TRUE(rig.shown("physics/rtf"));
  EXPECT_TRUE(rig.shown("physics/phases"));
  rig.pictures(20);
  EXPECT_GE(rig.model.history.samples().size(), 4u);  // 20 pictures are 0.4 s
}

TEST(Panel, KeepsHalfAMinuteOfHistory) {
  History history;
  state::Frame frame;
  for (int i = 0; i < 2000; ++i) {
    frame.run.real_time_factor = i;
    history.take(frame, std::int64_t{50'000'000} * i);
  }
  EXPECT_EQ(history.samples().size(), 300u);
  EXPECT_EQ(history.samples().back().real_time_factor, 1998.0F);
}

// --- 18: parameters.

TEST(Panel, ChangesParametersMarksThemAndTakesThemBack) {
  PanelRig rig;
  const state::ObjectId box = rig.rig.id("BODY box");
  rig.model.select(box);
  rig.pictures(2);
  rig.click("section/Parameters");
  EXPECT_FALSE(rig.shown("parameter/friction/revert"));
  rig.enter("parameter/friction", "0.125");
  const std::uint32_t slot = rig.slot("BODY box", state::ObjectKind::rigid_body);
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.body_parameters[slot].friction == 0.125; }));
  ASSERT_EQ(rig.model.changed().size(), 1u);
  EXPECT_EQ(rig.model.changed()[0].loaded.x, 0.5);
  rig.click("parameter/friction/revert");
  EXPECT_TRUE(rig.until([&](const state::Frame& frame) { return frame.body_parameters[slot].friction == 0.5; }));
  EXPECT_TRUE(rig.model.changed().empty());
}

TEST(Panel, WhatIsTypedCountsWhenItIsFinished) {
  PanelRig rig;
  rig.model.select(rig.joint("elbow"));
  rig.pictures(2);
  const std::uint32_t slot = rig.slot("elbow", state::ObjectKind::joint);
  const std::uint64_t version = rig.rig.frame().parameters_version;
  rig.enter("parameter/damping", "12");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.joint_parameters[slot].damping == 12.0; }));
  EXPECT_EQ(rig.rig.frame().parameters_version, version + 1) << "not first 1, then 12";
}

TEST(Panel, ChangesGravityAndTakesAllBack) {
  PanelRig rig;
  rig.tab("Physics");
  rig.enter("gravity/z", "-1.5");
  ASSERT_TRUE(rig.until([](const state::Frame& frame) { return frame.gravity_world.z == -1.5; }));
  rig.model.set_parameter(rig.rig.id("BODY box"), state::Parameter::restitution, {0.9, 0.9, 0.9});
  ASSERT_TRUE(rig.until([&](const state::Frame&) {
    rig.picture();
    return rig.model.changed().size() == 1;
  }));
  ASSERT_TRUE(rig.shown("physics/revert_all"));
  rig.click("physics/revert_all");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.gravity_world.z == -9.81; }));
  EXPECT_TRUE(rig.until([&](const state::Frame&) {
    rig.picture();
    return rig.model.changed().empty();
  }));
}

// --- 14, 15: plots.

TEST(Panel, PlotsAndWatchesNamedValuesAndWritesCsv) {
  PanelRig rig;
  rig.tab("Plots");
  rig.click("values/search");
  rig.type("box position z");
  rig.pictures(2);
  const std::string name = "/test/box position z";
  rig.click("values/plot/" + name, 0.1);
  rig.click("values/watch/" + name, 0.1);
  ASSERT_TRUE(rig.model.traces.has(name));
  EXPECT_TRUE(rig.model.watched(name));
  rig.run(200);
  ASSERT_GE(rig.model.traces.times().size(), 10u);
  EXPECT_NEAR(rig.model.traces.traces()[0].numbers.back(), rig.rig.body("BODY box").T_world_body.position.z, 1e-12);

  rig.click("plots/pause");
  const std::size_t samples = rig.model.traces.times().size();
  rig.run(100);
  EXPECT_EQ(rig.model.traces.times().size(), samples);

  const std::string csv = rig.model.traces.csv();
  EXPECT_EQ(csv.rfind("time [s],\"/test/box position z [m]\"\n", 0), 0u) << csv.substr(0, 80);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), samples + 1);
}

TEST(Panel, APlottedValueIsFoundAgainAndMissedWhileItIsGone) {
  PanelRig rig;
  ASSERT_TRUE(rig.model.traces.add("/test/box position x"));
  EXPECT_FALSE(rig.model.traces.add("/test/box position x")) << "once is enough";
  rig.run(40);
  rig.rig.wait_for([&](auto done) { rig.rig.simulation.remove("/test/box", done); });
  rig.run(40);
  EXPECT_FALSE(rig.model.traces.traces()[0].value);
  EXPECT_TRUE(std::isnan(rig.model.traces.traces()[0].numbers.back()));
}

TEST(Panel, EveryValueReadsWhatItsNameSays) {
  PanelRig rig;
  rig.model.hold_joint(rig.slot("elbow", state::ObjectKind::joint), {state::JointCommandType::velocity, 0.25});
  rig.run(200);
  const state::Frame& frame = rig.rig.frame();
  const auto read = [&](const std::string& name) { return read_value(frame, *find_value(*frame.structure, name)); };
  EXPECT_EQ(read("/test/elbow velocity"), frame.joints[1].velocity);
  EXPECT_EQ(read("/test/elbow commanded"), 0.25);
  EXPECT_EQ(read("/test/lower position z"), rig.rig.body("BODY lower").T_world_body.position.z);
  EXPECT_EQ(read("/test/lower angular velocity y"), rig.rig.body("BODY lower").twist_world.angular.y);
  EXPECT_EQ(read("world contacts"), frame.contacts_total);
  EXPECT_FALSE(find_value(*frame.structure, "/test/nobody position x"));
}

// --- 21: messages.

TEST(Panel, FiltersMessages) {
  PanelRig rig;
  rig.tail.add({base::Severity::information, 1, false, "all is well"});
  rig.tail.add({base::Severity::warning, 2, false, "take care"});
  rig.tail.add({base::Severity::error, 3, false, "it broke"});
  rig.tab("Log");
  const auto shown = [&] { return static_cast<int>(rig.ui.place("messages/shown")->left); };
  EXPECT_EQ(shown(), 3);
  rig.click("messages/information", 0.1);
  EXPECT_EQ(shown(), 2);
  rig.click("messages/search");
  rig.type("broke");
  rig.pictures(2);
  EXPECT_EQ(shown(), 1);
}

TEST(LogTail, KeepsTheLastLines) {
  base::LogTail tail(3);
  for (int i = 0; i < 5; ++i) tail.add({base::Severity::information, i, false, std::to_string(i)});
  EXPECT_EQ(tail.count(), 5u);
  ASSERT_EQ(tail.lines().size(), 3u);
  EXPECT_EQ(tail.lines().front().text, "2");
}

// --- 24: loading.

TEST(Panel, LoadsAFileAndRemembersIt) {
  const auto folder = std::filesystem::temp_directory_path() / "ambf_panel_test";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "ball.yaml").string(), settings = (folder / "panel.conf").string();
  std::filesystem::remove(settings);
  std::ofstream(file)
      << "bodies: [BODY ball]\nnamespace: /test/\nBODY ball: {name: ball, mass: 1, collision shape: SPHERE, "
         "collision geometry: {radius: 0.1}, location: {position: {x: 0, y: 0, z: 5}, orientation: {r: 0, p: 0, "
         "y: 0}}}\n";
  {
    PanelRig rig(settings);
    rig.tab("Files");
    rig.click("load/path");
    rig.type(file.substr(0, file.size() - 6));
    rig.pictures(2);
    ASSERT_TRUE(rig.shown("load/complete/" + file)) << "offers what begins so";
    rig.click("load/complete/" + file);
    rig.click("load/go");
    EXPECT_TRUE(rig.until([&](const state::Frame& frame) {
      return state::find(*frame.structure, "BODY ball", state::ObjectKind::rigid_body) != state::kNone;
    }));
    ASSERT_TRUE(rig.shown("models/unload/ball.yaml"));
    rig.click("models/unload/ball.yaml");
    EXPECT_TRUE(rig.until([&](const state::Frame& frame) {
      return state::find(*frame.structure, "BODY ball", state::ObjectKind::rigid_body) == state::kNone;
    }));
  }
  EXPECT_EQ(read_settings(settings).recent_files, std::vector<std::string>{file});
  std::filesystem::remove_all(folder);
}

// --- 25: what is remembered.

TEST(PanelSettings, AreReadAsTheyWereWritten) {
  const auto folder = std::filesystem::temp_directory_path() / "ambf_panel_settings";
  std::filesystem::remove_all(folder);
  const std::string path = (folder / "deeper" / "panel.conf").string();
  PanelSettings settings;
  settings.dark = false;
  settings.degrees = true;
  settings.width_points = 512.5;
  settings.tab = 3;
  settings.recent_files = {"/a b/\u00fc.yaml", "c.yaml"};
  settings.watched = {"/test/box position x"};
  ASSERT_TRUE(write_settings(path, settings));
  EXPECT_TRUE(read_settings(path) == settings);
  std::ofstream(path) << "width nonsense\nwidth -5\ntab 9999999999\nunknown thing\n\ntheme light\n";
  const PanelSettings read = read_settings(path);
  EXPECT_EQ(read.width_points, 0.0);
  EXPECT_FALSE(read.dark);
  EXPECT_TRUE(read_settings("/nowhere/at/all") == PanelSettings{});
  EXPECT_FALSE(write_settings("/proc/nowhere/panel.conf", settings));
  std::filesystem::remove_all(folder);
}

// --- The window around it.

TEST(Panel, TakesOnlyWhatIsMeantForIt) {
  PanelRig rig;
  const double left = 0.5 * rig.ui.left_edge();
  EXPECT_FALSE(rig.put(MotionInput{left - 50, 100, false}));
  EXPECT_FALSE(rig.put(ButtonInput{MouseButton::left, true, {}, left - 50, 100}));
  EXPECT_FALSE(rig.put(MotionInput{left + 50, 100, false})) << "a drag that began in the scene stays the scene's";
  EXPECT_FALSE(rig.put(ButtonInput{MouseButton::left, false, {}, left + 50, 100}));
  rig.picture();
  EXPECT_TRUE(rig.put(MotionInput{left + 50, 500, false}));
  EXPECT_TRUE(rig.put(WheelInput{1.0, false}));
  EXPECT_TRUE(rig.put(ButtonInput{MouseButton::left, true, {}, left + 50, 500}));
  EXPECT_TRUE(rig.put(MotionInput{left - 50, 500, false})) << "and the other way round";
  EXPECT_TRUE(rig.put(ButtonInput{MouseButton::left, false, {}, left - 50, 500}));
  rig.pictures(2);
  EXPECT_FALSE(rig.put(KeyInput{"P", {true, false, false}, false, false})) << "the window's keys go on";
  EXPECT_FALSE(rig.put(DropInput{{"file"}}));

  rig.click("tree/search");
  EXPECT_TRUE(rig.put(KeyInput{"Q", {}, false, false})) << "while typing, letters are letters";
  rig.ui.set_open(false);
  rig.picture();
  EXPECT_FALSE(rig.put(MotionInput{left + 50, 500, false}));
  EXPECT_EQ(rig.ui.drawing(), nullptr);
}

TEST(Panel, AClickFasterThanAPictureCounts) {
  PanelRig rig;
  const auto at = rig.at("run/pause");
  rig.put(MotionInput{at.x, at.y, false});
  rig.put(ButtonInput{MouseButton::left, true, {}, at.x, at.y});
  rig.put(ButtonInput{MouseButton::left, false, {}, at.x, at.y});
  rig.put(MotionInput{10, 10, false});
  rig.pictures(4);
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return !frame.run.paused; }));
}

TEST(Panel, AClickRightAfterTheMoveCounts) {
  PanelRig rig;
  for (const char* name : {"Joints", "View", "Physics", "Objects"}) {
    const auto at = rig.at(std::string("tab/") + name);
    rig.put(MotionInput{at.x, at.y, false});
    rig.put(ButtonInput{MouseButton::left, true, {}, at.x, at.y});
    rig.put(ButtonInput{MouseButton::left, false, {}, at.x, at.y});
    rig.pictures(4);
  }
  EXPECT_TRUE(rig.shown("tree/search"));
  EXPECT_FALSE(rig.shown("layer/Contacts"));
}

TEST(Panel, IsReachedByKeysAlone) {
  PanelRig rig;
  ASSERT_TRUE(rig.rig.frame().run.paused);
  rig.key("Up");  // the first key shows where one is
  ASSERT_FALSE(rig.put(KeyInput{"Q", {}, false, false})) << "letters are still the window's keys";
  rig.key("Space");
  bool ran = rig.rig.wait_until([](const state::Frame& frame) { return !frame.run.paused; });
  EXPECT_TRUE(ran) << "the first thing in the panel is the button that runs";
}

TEST(Panel, ItsEdgeIsDraggedAndRemembered) {
  PanelRig rig;
  const float left = rig.ui.left_edge();
  const auto at = rig.at("panel/edge");
  rig.put(MotionInput{at.x, at.y, false});
  rig.picture();
  rig.put(ButtonInput{MouseButton::left, true, {}, at.x, at.y});
  rig.picture();
  rig.put(MotionInput{at.x - 40, at.y, false});
  rig.pictures(2);
  rig.put(ButtonInput{MouseButton::left, false, {}, at.x - 40, at.y});
  rig.pictures(2);
  EXPECT_NEAR(rig.ui.left_edge(), left - 80.0F, 3.0F);
  EXPECT_GT(rig.model.settings.width_points, 0.0);
}

TEST(Panel, HeldJointsAreKeptAliveWhileItIsHidden) {
  PanelRig rig;
  rig.model.hold_joint(rig.slot("shoulder", state::ObjectKind::joint), {state::JointCommandType::position, 0.4});
  rig.ui.set_open(false);
  rig.run(1500);
  EXPECT_EQ(rig.joint_state("shoulder").commanded_type, state::JointCommandType::position);
  EXPECT_NEAR(rig.joint_state("shoulder").position, 0.4, 0.02);
  rig.now_ns += 2'000'000'000;  // no picture for two seconds: the watchdog has let go
  rig.picture();
  EXPECT_FALSE(rig.model.held.any());
}

TEST(Panel, RefusalsAreSaid) {
  PanelRig rig;
  rig.model.set_parameter(rig.rig.id("BODY box"), state::Parameter::friction, {-1, -1, -1});
  rig.model.load("/no/such/file.yaml", "");
  bool told = false;
  rig.rig.wait_until([&](const state::Frame&) {
    const auto lines = said(rig);
    told = std::any_of(lines.begin(), lines.end(), [](const auto& l) { return l.find("not loaded") != l.npos; });
    return told;
  });
  EXPECT_TRUE(told);
  const auto lines = said(rig);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& l) { return l.find("friction must") != l.npos; }));
}

}  // namespace
}  // namespace ambf::render
