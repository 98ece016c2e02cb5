// One input of a user in a window, as plain data. Positions in window units from the upper left corner. Any thread.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "render/window/keys.h"

namespace ambf::render {

enum class MouseButton { left, middle, right };

struct KeyInput {
  std::string key;  // as KeyBinding::key
  Modifiers modifiers;
  bool held = false;  // a repeat
  bool released = false;
};
struct TextInput {
  char32_t character = 0;  // in the user's layout
};
struct ButtonInput {
  MouseButton button = MouseButton::left;
  bool pressed = false;
  Modifiers modifiers;
  double x = 0.0, y = 0.0;
};
struct MotionInput {
  double x = 0.0, y = 0.0;
  bool left_shift = false;
};
struct WheelInput {
  double notches = 0.0;  // positive: away from the user
  bool left_shift = false;
};
struct DropInput {
  std::vector<std::string> paths;
};
struct FocusInput {
  bool focused = false;  // the window has the keyboard
};

using Input = std::variant<KeyInput, TextInput, ButtonInput, MotionInput, WheelInput, DropInput, FocusInput>;

}  // namespace ambf::render
