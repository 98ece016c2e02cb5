#include "render/window/keys.h"

#include <algorithm>
#include <iterator>

namespace ambf::render {

namespace {

struct GestureLine {
  std::string_view gesture, text;
};

constexpr GestureLine kMouse[] = {
    {"left drag", "pan; in picking mode: drag the body under the pointer"},
    {"Ctrl + left drag", "drag the body under the pointer"},
    {"right drag", "look around: yaw and pitch, no roll"},
    {"middle drag, Alt + left drag", "turn about the target"},
    {"Shift + middle drag", "the same as left drag"},
    {"wheel", "nearer or farther; orthographic: width of the view"},
    {"left Shift held", "a tenth of the speed"},
    {"drop ADF files", "load them"},
};

// While the hand is moved (G): hand_input.cpp.
constexpr GestureLine kHand[] = {
    {"arrows", "to the left, to the right, up, down"},
    {"E, D", "away, towards you"},
    {"J, L", "yaw: to the left, to the right"},
    {"O, K", "pitch: up, down"},
    {",, .", "roll: to the left, to the right"},
    {"Enter", "close or open the jaw"},
    {"X held", "clutch: the hand moves, the tool stays"},
    {"B held", "camera clutch: the hand moves the camera"},
    {"Shift held", "a tenth of the speed"},
    {"pointer, no button", "along the picture"},
    {"wheel", "away, towards you"},
};

constexpr Modifiers kPlain{}, kControl{true, false, false}, kAlt{false, true, false}, kShift{false, false, true},
    kControlShift{true, false, true};

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

constexpr KeyBinding kBeforeLayers[] = {
    {"Esc", kPlain, Action::quit, false, "quit"},
    {"Q", kPlain, Action::quit, false, "quit"},
    {"H", kPlain, Action::help, false, "show this help, its next page, or hide it"},
    {"P", kControl, Action::pause, false, "pause or resume"},
    {"Space", kPlain, Action::step_once, true, "while paused: one step"},
    {"Space", kControl, Action::step_ten, true, "while paused: ten steps"},
    {"R", kControl, Action::reset_bodies, false, "bodies back to where they started"},
    {"R", kAlt, Action::reset_world, false, "the whole world back to its start, time included"},
    {"V", kControl, Action::reset_cameras, false, "cameras back to where they started"},
    {"F", kControl, Action::frame_loaded, false, "show all of what was loaded"},
    {"1", kPlain, Action::gravity_on, false, "gravity as in the world file"},
    {"2", kPlain, Action::gravity_off, false, "gravity off"},
    {"P", kPlain, Action::picking, false, "picking on or off: the left button drags bodies"},
    {"G", kPlain, Action::hand, false, "move the hand by keyboard and mouse, or leave it"},
    {"X", kControl, Action::remove_picked, false, "remove the body picked last, with its joints"},
    {"F", kPlain, Action::full_screen, false, "full screen on or off, all windows"},
    {"U", kPlain, Action::labels, false, "times and rates at the lower edge on or off"},
    {"I", kPlain, Action::invert_mouse, false, "up and down of the mouse the other way round"},
    {"M", kPlain, Action::mirror, false, "picture upside down, for displays seen in a mirror"},
};

constexpr KeyBinding device_gain(std::string_view key, state::DeviceParameter parameter, double step,
                                 std::string_view text) {
  return {key, kPlain, Action::device_gain, true, text, {}, parameter, step};
}

constexpr KeyBinding kAfterLayers[] = {
    {"D", kShift, Action::measure, false, "measure distances and angles by clicks; Esc ends it"},
    {"Tab", kPlain, Action::panel, false, "panel: show it in this window, or hide it"},
    {"Tab", kControl, Action::next_camera, false, "look through the next camera"},
    {"S", kControl, Action::screenshot, false, "screenshot of this window, without panel and labels"},
    {"S", kControlShift, Action::film, false, "film this window, or end the film"},
    {"B", kControlShift, Action::record_data, false, "record the simulation's data to a bag, or end the recording"},
    {"N", kShift, Action::normal_maps, false, "normal maps on or off"},
    device_gain("3", state::DeviceParameter::haptic_linear, -0.05, "devices: less linear haptic gain"),
    device_gain("4", state::DeviceParameter::haptic_linear, 0.05, "devices: more linear haptic gain"),
    device_gain("5", state::DeviceParameter::haptic_angular, -0.05, "devices: less angular haptic gain"),
    device_gain("6", state::DeviceParameter::haptic_angular, 0.05, "devices: more angular haptic gain"),
    device_gain("7", state::DeviceParameter::linear_stiffness, -50.0, "devices: less linear stiffness of their tools"),
    device_gain("8", state::DeviceParameter::linear_stiffness, 50.0, "devices: more linear stiffness of their tools"),
    device_gain("9", state::DeviceParameter::angular_stiffness, -1.0, "devices: less angular stiffness of their tools"),
    device_gain("0", state::DeviceParameter::angular_stiffness, 1.0, "devices: more angular stiffness of their tools"),
    device_gain("PgUp", state::DeviceParameter::linear_damping, 0.1, "devices: more linear damping of their tools"),
    device_gain("PgDn", state::DeviceParameter::linear_damping, -0.1, "devices: less linear damping of their tools"),
    device_gain("Home", state::DeviceParameter::angular_damping, 0.1, "devices: more angular damping of their tools"),
    device_gain("End", state::DeviceParameter::angular_damping, -0.1, "devices: less angular damping of their tools"),
    {"N", kPlain, Action::device_mode, false, "devices: next mode of their buttons"},
    {"C", kPlain, Action::device_rotation_camera, false, "devices: rotations relative to the camera"},
    {"W", kPlain, Action::device_rotation_world, false, "devices: rotations relative to the world"},
    {"E", kControl, Action::device_forces, false, "devices: forces of all hands on or off"},
    {"T", kPlain, Action::later, false, "devices: gripping assistance on or off"},
};

std::vector<KeyBinding> make_bindings() {
  std::vector<KeyBinding> bindings(std::begin(kBeforeLayers), std::end(kBeforeLayers));
  for (std::size_t i = 0; i < all_layers().size(); ++i) {
    const LayerInfo& layer = all_layers()[i];
    if (layer.key.empty()) continue;
    bindings.push_back(
        {layer.key, layer.shift ? kShift : kPlain, Action::layer, false, layer.help, static_cast<LayerId>(i)});
  }
  bindings.insert(bindings.end(), std::begin(kAfterLayers), std::end(kAfterLayers));
  return bindings;
}

}  // namespace

const std::vector<KeyBinding>& key_bindings() {
  static const std::vector<KeyBinding> bindings = make_bindings();
  return bindings;
}

const KeyBinding* binding_of(std::string_view key, Modifiers modifiers, bool held) {
  for (const KeyBinding& binding : key_bindings()) {
    if (binding.key == key && binding.modifiers == modifiers && (!held || binding.repeats)) return &binding;
  }
  return nullptr;
}

Action action_of(std::string_view key, Modifiers modifiers, bool held) {
  const KeyBinding* binding = binding_of(key, modifiers, held);
  return binding == nullptr ? Action::none : binding->action;
}

std::string name_of(const KeyBinding& binding) {
  std::string name;
  if (binding.modifiers.control) name += "Ctrl+";
  if (binding.modifiers.alt) name += "Alt+";
  if (binding.modifiers.shift) name += "Shift+";
  return name + std::string(binding.key);
}

std::vector<HelpLine> help_table() {
  std::vector<HelpLine> table;
  for (const KeyBinding& binding : key_bindings()) {
    if (binding.action != Action::later) table.push_back({name_of(binding), std::string(binding.text)});
  }
  table.emplace_back();
  for (const GestureLine& line : kMouse) table.push_back({std::string(line.gesture), std::string(line.text)});
  table.emplace_back();
  for (const GestureLine& line : kHand) table.push_back({"hand: " + std::string(line.gesture), std::string(line.text)});
  return table;
}

std::vector<std::string> help_lines() {
  constexpr std::size_t kWidth = 21;
  std::vector<std::string> lines;
  for (const HelpLine& line : help_table())
    lines.push_back(line.name.empty() ? "" : padded(line.name, kWidth) + line.text);
  return lines;
}

std::string later_text(std::string_view key, Modifiers modifiers) {
  for (const KeyBinding& binding : key_bindings()) {
    if (binding.action != Action::later || binding.key != key || binding.modifiers != modifiers) continue;
    const std::string_view part = binding.text.substr(0, binding.text.find(':'));
    return "'" + name_of(binding) + "' is for " + std::string(part) + ", which this version does not have yet";
  }
  return {};
}

std::string keys_document() {
  std::string out =
      "# Keys and mouse\n\n"
      "In every window. This page is made from the table that the program itself uses "
      "(`ambf_framework/render/window/keys.cpp`);\n"
      "`h` shows the same list.\n\n"
      "| key | what it does |\n|---|---|\n";
  const auto add_keys = [&out](bool later) {
    for (const KeyBinding& binding : key_bindings()) {
      if ((binding.action == Action::later) != later) continue;
      out += "| " + name_of(binding) + " | " + std::string(binding.text) + " |\n";
    }
  };
  add_keys(false);
  out += "\n| mouse | what it does |\n|---|---|\n";
  for (const GestureLine& line : kMouse)
    out += "| " + std::string(line.gesture) + " | " + std::string(line.text) + " |\n";
  out += "\n| while the hand is moved (`G`) | what it does |\n|---|---|\n";
  for (const GestureLine& line : kHand)
    out += "| " + std::string(line.gesture) + " | " + std::string(line.text) + " |\n";
  out +=
      "\nThese belong to what the simulator does not have yet; pressing them says so, once:\n\n"
      "| key | what it will do |\n|---|---|\n";
  add_keys(true);
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
