#include "render/keys.h"

#include <algorithm>

namespace ambf::render {

namespace {

struct MouseLine {
  std::string_view gesture, text;
};

constexpr MouseLine kMouse[] = {
    {"left drag", "pan; in picking mode: drag the body under the pointer"},
    {"Ctrl + left drag", "drag the body under the pointer"},
    {"right drag", "look around: yaw and pitch, no roll"},
    {"middle drag", "turn about the target"},
    {"Shift + middle drag", "the same as left drag"},
    {"wheel", "forwards and backwards; orthographic cameras: width of the view"},
    {"left Shift held", "a tenth of the speed"},
    {"drop ADF files", "load them"},
};

constexpr Modifiers kPlain{}, kControl{true, false, false}, kAlt{false, true, false}, kShift{false, false, true};

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

}  // namespace

const std::vector<KeyBinding>& key_bindings() {
  static const std::vector<KeyBinding> bindings = {
      {"Esc", kPlain, Action::quit, false, "quit"},
      {"Q", kPlain, Action::quit, false, "quit"},
      {"H", kPlain, Action::help, false, "show or hide this help"},
      {"P", kControl, Action::pause, false, "pause or resume"},
      {"Space", kPlain, Action::step_once, true, "while paused: one step"},
      {"Space", kControl, Action::step_ten, true, "while paused: ten steps"},
      {"R", kControl, Action::reset_bodies, false, "bodies back to where they started"},
      {"R", kAlt, Action::reset_world, false, "the whole world back to its start, time included"},
      {"V", kControl, Action::reset_cameras, false, "cameras back to where they started"},
      {"1", kPlain, Action::gravity_on, false, "gravity on: 9.81 m/s^2 towards -z"},
      {"2", kPlain, Action::gravity_off, false, "gravity off"},
      {"P", kPlain, Action::picking, false, "picking mode on or off: the left button drags bodies"},
      {"X", kControl, Action::remove_picked, false, "remove the body picked last, with its joints"},
      {"F", kPlain, Action::full_screen, false, "full screen on or off"},
      {"U", kPlain, Action::labels, false, "times and rates at the lower edge on or off"},
      {"V", kPlain, Action::all_frames, false, "frames of all bodies on or off"},
      {"V", kShift, Action::picked_frame, false, "frame of the body picked last on or off"},
  };
  return bindings;
}

Action action_of(std::string_view key, Modifiers modifiers, bool held) {
  for (const KeyBinding& binding : key_bindings()) {
    if (binding.key == key && binding.modifiers == modifiers && (!held || binding.repeats)) return binding.action;
  }
  return Action::none;
}

std::string name_of(const KeyBinding& binding) {
  std::string name;
  if (binding.modifiers.control) name += "Ctrl+";
  if (binding.modifiers.alt) name += "Alt+";
  if (binding.modifiers.shift) name += "Shift+";
  return name + std::string(binding.key);
}

std::vector<std::string> help_lines() {
  constexpr std::size_t kWidth = 21;
  std::vector<std::string> lines;
  for (const KeyBinding& binding : key_bindings()) {
    lines.push_back(padded(name_of(binding), kWidth) + std::string(binding.text));
  }
  lines.emplace_back();
  for (const MouseLine& line : kMouse)
    lines.push_back(padded(std::string(line.gesture), kWidth) + std::string(line.text));
  return lines;
}

std::string keys_document() {
  std::string out =
      "# Keys and mouse\n\n"
      "In every window. This page is made from the table that the program itself uses "
      "(`ambf_framework/render/keys.cpp`);\n"
      "`h` shows the same list.\n\n"
      "| key | what it does |\n|---|---|\n";
  for (const KeyBinding& binding : key_bindings()) {
    out += "| " + name_of(binding) + " | " + std::string(binding.text) + " |\n";
  }
  out += "\n| mouse | what it does |\n|---|---|\n";
  for (const MouseLine& line : kMouse)
    out += "| " + std::string(line.gesture) + " | " + std::string(line.text) + " |\n";
  out +=
      "\nMoving the view moves the camera itself: others see it on the camera's topic, and when they move it, the view "
      "follows.\n\n"
      "Per pixel or notch: pan 0.01 m, look around 0.3 degrees, turn about the target 0.43 degrees, wheel 0.1 m; each "
      "times\n"
      "the camera's `mouse control multipliers`. Close to the target, pan and wheel are slower than that: what is at "
      "the target never moves\n"
      "faster than the pointer, and a notch goes at most a fifth of the way.\n";
  return out;
}

}  // namespace ambf::render
