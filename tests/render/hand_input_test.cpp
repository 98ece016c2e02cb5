// Keyboard and mouse as an input device: what a window publishes for its driver.
#include "render/window/hand_input.h"

#include <gtest/gtest.h>

#include <memory>

namespace ambf::render {
namespace {

using state::HandKey;

class HandInputTest : public ::testing::Test {
 protected:
  state::WindowInput published() {
    hand.publish(++now_ns);
    state::WindowInput input;
    EXPECT_TRUE(slot.read(input));
    return input;
  }
  bool press(const char* key, Modifiers modifiers = {}) { return hand.on_input(moment, KeyInput{key, modifiers}); }
  void release(const char* key) { hand.on_input(moment, KeyInput{key, {}, false, true}); }
  void move(double x, double y) { hand.on_input(moment, MotionInput{x, y, false}); }

  exchange::Broadcast<state::WindowInput> slot;
  HandInput hand{slot, std::make_shared<Messages>()};
  HandInputTest() { moment.window = 1; }
  WindowMoment moment;
  std::int64_t now_ns = 0;
};

TEST_F(HandInputTest, NothingMovesBeforeItIsSwitchedOn) {
  EXPECT_FALSE(press("E"));
  EXPECT_FALSE(press("Enter"));
  move(10, 10);
  move(50, 50);
  EXPECT_FALSE(hand.on_input(moment, WheelInput{1.0, false})) << "the view's";
  const state::WindowInput input = published();
  EXPECT_TRUE(input.open);
  EXPECT_FALSE(input.controls || input.jaw_closed);
  EXPECT_EQ(input.held, 0U);
  EXPECT_EQ(input.pointer_right_px, 0.0);
  EXPECT_FALSE(press("G", {true, false, false}));
  EXPECT_FALSE(published().controls);
}

TEST_F(HandInputTest, KeysActWhileTheyAreHeld) {
  EXPECT_TRUE(press("G"));
  EXPECT_TRUE(press("E"));
  EXPECT_TRUE(press("Left"));
  EXPECT_TRUE(press("Shift"));
  state::WindowInput input = published();
  EXPECT_TRUE(input.controls && is_held(input, HandKey::away) && is_held(input, HandKey::left));
  EXPECT_TRUE(is_held(input, HandKey::slow));
  release("E");
  input = published();
  EXPECT_TRUE(!is_held(input, HandKey::away) && is_held(input, HandKey::left));
  EXPECT_TRUE(press("D", {false, false, true})) << "slowly, too";
  press("Enter");
  EXPECT_TRUE(published().jaw_closed);
  press("Enter");
  EXPECT_FALSE(published().jaw_closed);
  EXPECT_FALSE(press("Q")) << "the window's keys go on";
  EXPECT_FALSE(press("X", {true, false, false})) << "Ctrl+X is not the clutch";
  press("G");
  input = published();
  EXPECT_FALSE(input.controls);
  EXPECT_EQ(input.held, 0U);
}

TEST_F(HandInputTest, ThePointerMovesItOnlyWithoutAButtonAndOverTheScene) {
  press("G");
  move(100, 100);
  EXPECT_EQ(published().pointer_right_px, 0.0) << "where it comes in is no motion";
  move(130, 90);
  EXPECT_EQ(published().pointer_right_px, 30.0);
  EXPECT_EQ(published().pointer_up_px, 10.0);
  EXPECT_FALSE(hand.on_input(moment, ButtonInput{MouseButton::right, true, {}, 130, 90})) << "the view's";
  move(300, 300);
  hand.on_input(moment, ButtonInput{MouseButton::right, false, {}, 300, 300});
  EXPECT_EQ(published().pointer_right_px, 30.0) << "a drag moves the view";
  move(301, 300);
  EXPECT_EQ(published().pointer_right_px, 31.0);
  hand.on_consumed(moment, MotionInput{500, 300, false});
  move(290, 500);
  EXPECT_EQ(published().pointer_right_px, 31.0) << "the way over the panel does not count";
  EXPECT_TRUE(hand.on_input(moment, WheelInput{-2.0, false}));
  EXPECT_EQ(published().wheel_away_notches, -2.0);
  moment.sizes.mirrored = true;
  move(290, 510);
  EXPECT_EQ(published().pointer_up_px, 10.0 + 10.0);
}

TEST_F(HandInputTest, TheEndOfTheFocusOrOfTheWindowReleasesAll) {
  for (const bool closed : {false, true}) {
    press("G");
    press("Up");
    EXPECT_TRUE(published().controls);
    WindowMoment other = moment;
    other.window = 2;
    hand.on_input(other, FocusInput{false});
    EXPECT_TRUE(published().controls) << "another window's focus";
    closed ? hand.on_close(1) : void(hand.on_input(moment, FocusInput{false}));
    const state::WindowInput input = published();
    EXPECT_FALSE(input.controls);
    EXPECT_EQ(input.held, 0U);
    release("Up");
  }
}

TEST_F(HandInputTest, WithoutAWindowThereIsNoDevice) {
  state::WindowInput input;
  {
    HandInput last(slot, std::make_shared<Messages>());
    last.on_input(moment, KeyInput{"G", {}});
    last.publish(1);
    ASSERT_TRUE(slot.read(input) && input.open && input.controls);
  }
  ASSERT_TRUE(slot.read(input));
  EXPECT_FALSE(input.open || input.controls);
}

}  // namespace
}  // namespace ambf::render
