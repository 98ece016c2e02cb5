#include "render/window/hand_input.h"

#include <string_view>
#include <utility>

namespace ambf::render {

namespace {

using state::HandKey;

struct HandBinding {
  std::string_view key;
  HandKey effect;
};
// The help and docs/keys.md describe them (keys.cpp).
constexpr HandBinding kHandKeys[] = {
    {"E", HandKey::away},     {"D", HandKey::towards},       {"Left", HandKey::left},   {"Right", HandKey::right},
    {"Up", HandKey::up},      {"Down", HandKey::down},       {",", HandKey::roll_left}, {".", HandKey::roll_right},
    {"O", HandKey::pitch_up}, {"K", HandKey::pitch_down},    {"J", HandKey::yaw_left},  {"L", HandKey::yaw_right},
    {"X", HandKey::clutch},   {"B", HandKey::camera_clutch}, {"Shift", HandKey::slow},
};

std::uint32_t bit_of(std::string_view key) {
  for (const HandBinding& binding : kHandKeys) {
    if (binding.key == key) return std::uint32_t{1} << static_cast<unsigned>(binding.effect);
  }
  return 0;
}

}  // namespace

HandInput::~HandInput() {
  release();
  input_.open = false;
  slot_.publish(input_);
}

bool HandInput::on_input(const WindowMoment& moment, const Input& input) {
  if (const auto* key = std::get_if<KeyInput>(&input)) return on_key(moment.window, *key);
  if (moment.window != window_ || !input_.controls) return false;
  if (const auto* focus = std::get_if<FocusInput>(&input); focus != nullptr && !focus->focused) {
    release();
    messages_->add("hand left: the window lost the keyboard");
  } else if (const auto* button = std::get_if<ButtonInput>(&input)) {
    const unsigned bit = 1U << static_cast<unsigned>(button->button);
    pressed_ = button->pressed ? pressed_ | bit : pressed_ & ~bit;
  } else if (const auto* motion = std::get_if<MotionInput>(&input)) {
    on_motion(moment, *motion);
  } else if (const auto* wheel = std::get_if<WheelInput>(&input)) {
    input_.wheel_away_notches += wheel->notches;
    return true;
  }
  return false;
}

// The pointer over the panel moves no hand, nor does its way back make up for it.
void HandInput::on_consumed(const WindowMoment& moment, const Input& input) {
  if (moment.window == window_ && std::get_if<MotionInput>(&input) != nullptr) placed_ = false;
}

bool HandInput::on_key(unsigned window, const KeyInput& key) {
  if (key.released) {
    input_.held &= ~bit_of(key.key);  // in whichever window: none stays down for ever
    return false;
  }
  if (key.modifiers.control || key.modifiers.alt) return false;
  if (action_of(key.key, key.modifiers, key.held) == Action::hand) {
    const bool on = !input_.controls || window != window_;
    release();
    input_.controls = on;
    window_ = window;
    messages_->add(on ? "hand: arrows, E, D, the pointer and the wheel move it, Enter is the jaw; H has all, G ends it"
                      : "hand left");
    return true;
  }
  if (!input_.controls || window != window_) return false;
  if (key.key == "Enter" && !key.held) input_.jaw_closed = !input_.jaw_closed;
  input_.held |= bit_of(key.key);
  return key.key == "Enter" || bit_of(key.key) != 0;
}

void HandInput::on_motion(const WindowMoment& moment, const MotionInput& motion) {
  const double up = moment.sizes.mirrored ? motion.y - y_ : y_ - motion.y;
  if (placed_ && pressed_ == 0) {
    input_.pointer_right_px += motion.x - x_;
    input_.pointer_up_px += up;
  }
  placed_ = true;
  x_ = motion.x;
  y_ = motion.y;
}

void HandInput::on_close(unsigned window) {
  if (window == window_) release();
}

void HandInput::release() {
  input_.held = 0;
  input_.controls = false;
  placed_ = false;
  pressed_ = 0;
}

void HandInput::publish(std::int64_t now_ns) {
  input_.open = true;
  input_.stamp_ns = now_ns;
  slot_.publish(input_);
}

}  // namespace ambf::render
