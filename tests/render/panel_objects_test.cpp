// The tree, selection, forces, parameters and contacts in the panel.
#include <gtest/gtest.h>

#include <algorithm>

#include "panel_rig.h"
#include "render/panel/relations.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

// --- 3, 16: selection and the tree.

TEST(Panel, SelectsInTheTreeAndGoesToTheParent) {
  PanelRig rig;
  rig.click("tree/search");
  rig.type("LOWER");
  rig.pictures(2);
  ASSERT_TRUE(rig.shown("tree//test/lower"));
  EXPECT_FALSE(rig.shown("tree//test/box"));
  rig.click("tree//test/lower");
  EXPECT_EQ(rig.model.selection.id(), rig.rig.id("BODY lower"));
  rig.click("object/parent");
  EXPECT_EQ(rig.model.selection.id(), rig.rig.id("BODY upper"));
  rig.click("object/parent");
  EXPECT_EQ(rig.model.selection.id(), rig.rig.id("BODY base"));
  EXPECT_FALSE(parent_of(rig.model.structure(), rig.rig.id("BODY base")).valid());
}

TEST(Panel, TheTreeShowsJointsBelowTheirBodies) {
  PanelRig rig;
  ObjectTree& tree = rig.model.selection.tree;
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
  rig.model.selection.select(rig.rig.id("BODY box"));
  rig.pictures(2);
  rig.click("object/remove");
  rig.click("object/remove_yes");
  EXPECT_TRUE(rig.until([&](const state::Frame& frame) {
    return state::find(*frame.structure, "BODY box", state::ObjectKind::rigid_body) == state::kNone;
  }));
  EXPECT_FALSE(rig.model.selection.id().valid());
  EXPECT_EQ(rig.model.selection.info(), nullptr);
}

// --- 4, 5: forces.

TEST(Panel, PushesWithForceTorqueAndLength) {
  PanelRig rig;
  rig.rig.simulation.set_gravity({});
  rig.model.selection.select(rig.rig.id("BODY box"));
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
  rig.model.selection.select(box);
  EXPECT_EQ(pulled_by(rig.model.frame(), box), 0.0);
  const auto port = rig.rig.simulation.make_pick_port();
  port->pick({0.5, 0, 3}, {0.5, 0, 0.5}, nullptr);
  port->drag({0.5, 0, 1.6});
  rig.run(40);
  ASSERT_FALSE(rig.rig.frame().picks.empty());
  EXPECT_TRUE(rig.shown("object/pull"));
  EXPECT_GT(pulled_by(rig.model.frame(), box), 0.0);
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

TEST(Panel, ShowsWhatDrawingAndPublishingTake) {
  PanelRig rig;
  rig.tab("Physics");
  EXPECT_FALSE(rig.shown("times/drawing")) << "nobody draws";
  EXPECT_FALSE(rig.shown("times/comm"));
  rig.rig.simulation.report_graphics(25.0, 0.012);
  rig.rig.simulation.report_comm(4e-5);
  rig.rig.step(1);
  rig.pictures(2);
  EXPECT_TRUE(rig.shown("times/drawing"));
  EXPECT_TRUE(rig.shown("times/comm"));
  const auto read = [&](const std::string& name) {
    return read_value(rig.rig.frame(), *find_value(rig.model.structure(), name));
  };
  EXPECT_EQ(read("world time of a picture"), 0.012);
  EXPECT_EQ(read("world time of comm"), 4e-5);
  EXPECT_EQ(read("world time of commands"), rig.rig.frame().run.seconds_per_phase[0]);
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
  rig.model.selection.select(box);
  rig.pictures(2);
  rig.click("section/Parameters");
  EXPECT_FALSE(rig.shown("parameter/friction/revert"));
  rig.enter("parameter/friction", "0.125");
  const std::uint32_t slot = rig.slot("BODY box", state::ObjectKind::rigid_body);
  ASSERT_TRUE(
      rig.until([&](const state::Frame& frame) { return frame.body_parameters[slot].surface.friction == 0.125; }));
  ASSERT_EQ(rig.model.tune.changed().size(), 1u);
  EXPECT_EQ(rig.model.tune.changed()[0].loaded.x, 0.5);
  rig.click("parameter/friction/revert");
  EXPECT_TRUE(
      rig.until([&](const state::Frame& frame) { return frame.body_parameters[slot].surface.friction == 0.5; }));
  EXPECT_TRUE(rig.model.tune.changed().empty());
}

TEST(Panel, WhatIsTypedCountsWhenItIsFinished) {
  PanelRig rig;
  rig.model.selection.select(rig.joint("elbow"));
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
  rig.model.tune.set(rig.rig.id("BODY box"), state::Parameter::restitution, {0.9, 0.9, 0.9});
  ASSERT_TRUE(rig.until([&](const state::Frame&) {
    rig.picture();
    return rig.model.tune.changed().size() == 1;
  }));
  ASSERT_TRUE(rig.shown("physics/revert_all"));
  rig.click("physics/revert_all");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.gravity_world.z == -9.81; }));
  EXPECT_TRUE(rig.until([&](const state::Frame&) {
    rig.picture();
    return rig.model.tune.changed().empty();
  }));
}

TEST(Panel, RefusalsAreSaid) {
  PanelRig rig;
  rig.rig.log.expect_warning("cannot be read: no such file");
  rig.rig.log.expect_warning("not loaded: '/no/such/file.yaml'");
  rig.model.tune.set(rig.rig.id("BODY box"), state::Parameter::friction, {-1, -1, -1});
  rig.model.edit.load("/no/such/file.yaml", "");
  bool told = false;
  rig.rig.wait_until([&](const state::Frame&) {
    const auto lines = rig.said();
    told = std::any_of(lines.begin(), lines.end(), [](const auto& l) { return l.find("not loaded") != l.npos; });
    return told;
  });
  EXPECT_TRUE(told);
  const auto lines = rig.said();
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& l) { return l.find("friction must") != l.npos; }));
}

}  // namespace
}  // namespace ambf::render
