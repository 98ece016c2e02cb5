// Plots, watch lines and messages in the panel.
#include <gtest/gtest.h>

#include <algorithm>

#include "panel_rig.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

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

}  // namespace
}  // namespace ambf::render
