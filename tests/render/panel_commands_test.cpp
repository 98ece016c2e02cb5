// Who commands what, as the panel shows it.
#include <gtest/gtest.h>

#include "panel_rig.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

// --- 22: commands.

TEST(PanelCommands, ShowsWhoCommandsWhatAndForHowLong) {
  PanelRig rig;
  rig.tab("Physics");
  EXPECT_TRUE(rig.model.commands.list().empty());
  const std::uint32_t elbow = rig.slot("elbow", state::ObjectKind::joint);
  rig.model.hold_joint(elbow, {state::JointCommandType::position, 0.5});
  rig.run(100);
  ASSERT_EQ(rig.model.commands.list().size(), 1u);
  EXPECT_EQ(rig.model.commands.list()[0].object, rig.rig.id("BODY upper")) << "through the body above the joint";
  EXPECT_EQ(rig.model.commands.list()[0].joints, std::vector<std::uint32_t>{elbow});
  EXPECT_TRUE(rig.shown("commands//test/upper/this panel"));
  const double so_far_s = rig.model.commands.list()[0].for_s;
  rig.pictures(50);
  EXPECT_NEAR(rig.model.commands.list()[0].for_s - so_far_s, 1.0, 0.05);
  EXPECT_NEAR(rig.model.commands.list()[0].unchanged_s - so_far_s, 1.0, 0.05);
  rig.model.hold_joint(elbow, {state::JointCommandType::position, 0.6});
  rig.run(40);
  EXPECT_LT(rig.model.commands.list()[0].unchanged_s, 0.1) << "told something else";
  EXPECT_GT(rig.model.commands.list()[0].for_s, 1.0);
  rig.model.held.release_all();
  rig.run(100);
  EXPECT_TRUE(rig.model.commands.list().empty());
}

TEST(PanelCommands, OfAnotherClientAreNotThePanels) {
  PanelRig rig;
  rig.tab("Physics");
  const auto port = rig.rig.simulation.bind(rig.rig.id("BODY box"), state::Source::ros);
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::force;
  command.wrench_world.force = {0, 0, 1};
  port->post(command);
  rig.run(40);
  EXPECT_TRUE(rig.shown("commands//test/box/a client"));
  rig.click("commands//test/box", 0.1);
  EXPECT_EQ(rig.model.selected(), rig.rig.id("BODY box"));
}

}  // namespace
}  // namespace ambf::render
