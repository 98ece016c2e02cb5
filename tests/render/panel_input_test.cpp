// What the panel takes of the mouse and the keyboard.
#include <gtest/gtest.h>

#include "panel_rig.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

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

TEST(Panel, AClickKnowsItsOwnModifiersWhateverTheLastKeyWas) {
  PanelRig rig;
  rig.tab("Joints");
  rig.key("P", {true, false, false});  // Ctrl is let go unseen: keys of their own it has none
  rig.drag("joint/shoulder", 0.5, 0.75);
  EXPECT_TRUE(rig.model.held.any()) << "the slider was dragged, not typed into";
}

}  // namespace
}  // namespace ambf::render
