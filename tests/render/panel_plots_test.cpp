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
  ASSERT_TRUE(rig.model.plots.traces.has(name));
  EXPECT_TRUE(rig.model.plots.watched(name));
  rig.run(200);
  ASSERT_GE(rig.model.plots.traces.times().size(), 10u);
  EXPECT_NEAR(rig.model.plots.traces.traces()[0].numbers.back(), rig.rig.body("BODY box").T_world_body.position.z,
              1e-12);

  rig.click("plots/pause");
  const std::size_t samples = rig.model.plots.traces.times().size();
  rig.run(100);
  EXPECT_EQ(rig.model.plots.traces.times().size(), samples);

  const std::string csv = rig.model.plots.traces.csv();
  EXPECT_EQ(csv.rfind("time [s],\"/test/box position z [m]\"\n", 0), 0u) << csv.substr(0, 80);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), samples + 1);
}

TEST(Panel, APlottedValueIsFoundAgainAndMissedWhileItIsGone) {
  PanelRig rig;
  ASSERT_TRUE(rig.model.plots.traces.add("/test/box position x"));
  EXPECT_FALSE(rig.model.plots.traces.add("/test/box position x")) << "once is enough";
  rig.run(40);
  rig.rig.wait_for([&](auto done) { rig.rig.simulation.remove("/test/box", done); });
  rig.run(40);
  EXPECT_FALSE(rig.model.plots.traces.traces()[0].value);
  EXPECT_TRUE(std::isnan(rig.model.plots.traces.traces()[0].numbers.back()));
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

TEST(Panel, ARectangleInAPlotZoomsTimeAndValueAndADoubleClickShowsAll) {
  PanelRig rig;
  rig.tab("Plots");
  const std::string name = "/test/box position z", other = "/test/box position x";
  rig.model.plots.plot(name, true);
  rig.model.plots.plot(other, true);
  rig.run(400);
  const double first = rig.model.plots.traces.times().front(), last = rig.model.plots.traces.times().back();
  const WidgetPlace place = *rig.ui.place("plot/" + name);
  const auto at = [&](double right, double down) {
    return PanelRig::At{(place.left + right * (place.right - place.left)) / rig.density,
                        (place.top + down * (place.bottom - place.top)) / rig.density};
  };
  const auto drag = [&](const PanelRig::At& a, const PanelRig::At& b) {
    rig.put(MotionInput{a.x, a.y, false});
    rig.picture();
    rig.put(ButtonInput{MouseButton::left, true, {}, a.x, a.y});
    rig.picture();
    rig.put(MotionInput{b.x, b.y, false});
    rig.pictures(2);
    rig.put(ButtonInput{MouseButton::left, false, {}, b.x, b.y});
    rig.pictures(2);
    rig.pictures(30);  // the next press is no double click
  };
  drag(at(0.25, 0.2), at(0.75, 0.6));
  ASSERT_TRUE(rig.model.plots.zoom().time_s);
  const double span = last - first, pixel = 2.0 / (place.right - place.left);
  EXPECT_NEAR(rig.model.plots.zoom().time_s->from, first + 0.25 * span, pixel * span);
  EXPECT_NEAR(rig.model.plots.zoom().time_s->to, first + 0.75 * span, pixel * span);
  ASSERT_EQ(rig.model.plots.zoom().values.size(), 1u) << "the other keeps all its values";
  const PlotSpan values = rig.model.plots.zoom().values.at(name);
  EXPECT_LT(values.from, values.to);
  EXPECT_TRUE(rig.model.plots.traces.paused()) << "held still";
  const std::size_t samples = rig.model.plots.traces.times().size();
  rig.run(100);
  EXPECT_EQ(rig.model.plots.traces.times().size(), samples);

  // Again within what is shown; flat: the values stay as they are.
  drag(at(0.5, 0.5), at(1.0, 0.5));
  EXPECT_NEAR(rig.model.plots.zoom().time_s->from, first + 0.5 * span, pixel * span);
  EXPECT_NEAR(rig.model.plots.zoom().time_s->to, first + 0.75 * span, pixel * span);
  EXPECT_EQ(rig.model.plots.zoom().values.at(name), values);

  const PanelRig::At middle = at(0.5, 0.5);
  for (int i = 0; i < 2; ++i) {
    rig.put(ButtonInput{MouseButton::left, true, {}, middle.x, middle.y});
    rig.picture();
    rig.put(ButtonInput{MouseButton::left, false, {}, middle.x, middle.y});
    rig.picture();
  }
  rig.pictures(2);
  EXPECT_FALSE(rig.model.plots.zoom().any());
  EXPECT_FALSE(rig.model.plots.traces.paused()) << "they go on";
}

TEST(Panel, PlotsThatWereHeldStayHeldWhenAllIsShownAgain) {
  PanelRig rig;
  rig.tab("Plots");
  rig.model.plots.plot("/test/box position z", true);
  rig.run(100);
  rig.click("plots/pause");
  rig.model.plots.zoom_in("/test/box position z", PlotSpan{0.02, 0.05}, std::nullopt);
  rig.pictures(2);
  rig.click("plots/all");
  EXPECT_FALSE(rig.model.plots.zoom().any());
  EXPECT_TRUE(rig.model.plots.traces.paused());
}

TEST(Panel, ASignBesideAValuePlotsIt) {
  PanelRig rig;
  rig.model.selection.select(rig.rig.id("BODY box"));
  rig.pictures(3);
  rig.click("plot_it//test/box velocity x");
  EXPECT_TRUE(rig.model.plots.traces.has("/test/box velocity x"));
  EXPECT_TRUE(rig.model.plots.traces.has("/test/box velocity y"));
  EXPECT_TRUE(rig.model.plots.traces.has("/test/box velocity z"));
  rig.click("plot_it//test/box velocity x");
  EXPECT_TRUE(rig.model.plots.traces.traces().empty());

  rig.model.selection.select(rig.joint("elbow"));
  rig.pictures(3);
  rig.click("plot_it//test/elbow effort");
  EXPECT_TRUE(rig.model.plots.traces.has("/test/elbow effort"));
  rig.tab("Joints");
  rig.click("plot_it//test/elbow position");
  ASSERT_TRUE(rig.model.plots.traces.has("/test/elbow position"));
  rig.run(40);
  for (const Traces::Trace& trace : rig.model.plots.traces.traces()) EXPECT_TRUE(trace.value) << trace.name;
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
