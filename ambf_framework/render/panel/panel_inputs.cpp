#include "render/panel/detail/panel_inputs.h"

#include <imgui/imgui.h>

#include <algorithm>

#include "render/panel/detail/ui_inputs.h"
#include "render/window/window_part.h"

namespace ambf::render {

bool PanelInputs::inside(std::optional<float> left, double px, double py) const {
  if (!left) return false;
  if (px >= static_cast<double>(*left)) return true;
  return ImGui::GetIO().WantCaptureMouse && !pressed_in_scene_[0] && !pressed_in_scene_[1] && !pressed_in_scene_[2] &&
         py >= 0.0 && ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

bool PanelInputs::take(const WindowSizes& sizes, std::optional<float> left, const Input& input) {
  const double px_x = sizes.width > 0.0 ? sizes.picture_width / sizes.width : 1.0;
  const double px_y = sizes.height > 0.0 ? sizes.picture_height / sizes.height : 1.0;
  const ImGuiIO& io = ImGui::GetIO();
  if (const auto* motion = std::get_if<MotionInput>(&input)) {
    x_ = motion->x * px_x;
    y_ = motion->y * px_y;
    waiting_.push_back(MotionInput{x_, y_, motion->left_shift});
    const bool scene = pressed_in_scene_[0] || pressed_in_scene_[1] || pressed_in_scene_[2];
    const bool here = pressed_here_[0] || pressed_here_[1] || pressed_here_[2];
    return here || (!scene && inside(left, x_, y_));
  }
  if (const auto* button = std::get_if<ButtonInput>(&input)) {
    const int index = button_of(button->button);
    ButtonInput here = *button;
    x_ = here.x = button->x * px_x;
    y_ = here.y = button->y * px_y;
    if (!button->pressed) {
      const bool ours = pressed_here_[index];
      pressed_here_[index] = pressed_in_scene_[index] = false;
      if (ours) waiting_.push_back(here);
      return ours;
    }
    const bool ours = inside(left, x_, y_);
    (ours ? pressed_here_ : pressed_in_scene_)[index] = true;
    if (ours) {
      waiting_.push_back(here);
    } else {
      ImGui::SetWindowFocus(nullptr);  // the scene was clicked: keys are the window's again
    }
    return ours;
  }
  if (const auto* wheel = std::get_if<WheelInput>(&input)) {
    if (!inside(left, x_, y_)) return false;
    waiting_.push_back(*wheel);
    return true;
  }
  if (std::get_if<TextInput>(&input) != nullptr) {
    if (!io.WantTextInput) return false;
    waiting_.push_back(input);
    return true;
  }
  if (const auto* key = std::get_if<KeyInput>(&input)) {
    if (key->released) {
      waiting_.push_back(*key);
      return false;  // nobody acts on it
    }
    const auto is_one_of = [&](std::initializer_list<const char*> names) {
      return std::any_of(names.begin(), names.end(), [&](const char* name) { return key->key == name; });
    };
    const bool plain = !key->modifiers.control && !key->modifiers.alt;
    const bool popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    const bool moves = io.NavActive && is_one_of({"Left", "Right", "Up", "Down", "PgUp", "PgDn", "Home", "End"});
    // What acts does so only where one sees on what.
    const bool acts = (popup || (io.NavActive && io.NavVisible)) && is_one_of({"Space", "Enter", "Esc"});
    if (io.WantTextInput || (plain && (moves || acts))) {
      waiting_.push_back(*key);
      return true;
    }
    return false;
  }
  return false;
}

// Dear ImGui looks at the state of buttons and keys once a picture: what changes twice between two pictures is spread
// over two, so that no quick click is lost where pictures are slow.
void PanelInputs::feed() {
  ImGuiIO& io = ImGui::GetIO();
  const auto hold = [&](const Modifiers& modifiers) {
    io.KeyCtrl = modifiers.control;
    io.KeyShift = modifiers.shift;
    io.KeyAlt = modifiers.alt;
  };
  bool button_changed[3] = {}, key_changed[ImGuiKey_COUNT] = {}, pressed = false, moved = false, keyed = false;
  while (!waiting_.empty()) {
    const Input& input = waiting_.front();
    if (const auto* motion = std::get_if<MotionInput>(&input)) {
      if (pressed) break;
      const ImVec2 to = whole_pixel(motion->x, motion->y);
      moved = moved || to.x != io.MousePos.x || to.y != io.MousePos.y;
      io.MousePos = to;
    } else if (const auto* button = std::get_if<ButtonInput>(&input)) {
      const int index = button_of(button->button);
      const ImVec2 to = whole_pixel(button->x, button->y);
      moved = moved || to.x != io.MousePos.x || to.y != io.MousePos.y;
      io.MousePos = to;
      // It must have seen the pointer over something before that can be pressed.
      if (button_changed[index] || (button->pressed && moved)) break;
      button_changed[index] = pressed = true;
      io.MouseDown[index] = button->pressed;
      hold(button->modifiers);  // those of the last key may have been let go since
    } else if (const auto* wheel = std::get_if<WheelInput>(&input)) {
      io.MouseWheel += static_cast<float>(wheel->notches);
    } else if (const auto* text = std::get_if<TextInput>(&input)) {
      io.AddInputCharacter(text->character);
      keyed = true;
    } else if (const auto* key = std::get_if<KeyInput>(&input)) {
      // With Ctrl nothing is typed, and without it Ctrl+A is a letter: what comes with it and without it is spread,
      // too.
      if (keyed && key->modifiers.control != io.KeyCtrl) break;
      hold(key->modifiers);
      keyed = true;
      const int index = key_of(key->key);
      if (index >= 0 && !key->held) {
        if (key_changed[index]) break;
        key_changed[index] = true;
        io.KeysDown[index] = !key->released;
        // Dear ImGui presses buttons with Space; people do with either.
        if (index == ImGuiKey_Enter && (key->released || !io.WantTextInput))
          io.KeysDown[ImGuiKey_Space] = !key->released;
      }
    }
    waiting_.pop_front();
  }
}

void PanelInputs::clear() {
  waiting_.clear();
  std::fill(std::begin(pressed_here_), std::end(pressed_here_), false);
  ImGuiIO& io = ImGui::GetIO();
  std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
}

}  // namespace ambf::render
