// Key bindings of a window: one table from which the handler, the help and docs/keys.md are made. Pure data and
// functions, any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/marks/layers.h"
#include "state/devices.h"

namespace ambf::render {

enum class Action {
  none,
  quit,
  help,
  frame_loaded,
  pause,
  step_once,
  step_ten,
  reset_bodies,
  reset_world,
  reset_cameras,
  gravity_on,
  gravity_off,
  picking,
  hand,  // a part's (hand_input.h), where a device is moved by keyboard and mouse
  remove_picked,
  full_screen,
  layer,  // switches KeyBinding::layer
  measure,
  panel,
  next_camera,
  screenshot,
  film,
  record_data,
  labels,
  invert_mouse,
  mirror,
  normal_maps,
  device_gain,  // changes KeyBinding::parameter by KeyBinding::step
  device_mode,
  device_rotation_camera,
  device_rotation_world,
  device_forces,
  later,  // belongs to a part of the simulator that does not exist yet
};

struct Modifiers {
  bool control = false, alt = false, shift = false;
  bool operator==(const Modifiers&) const = default;
};

struct KeyBinding {
  std::string_view key;  // "Q", "1", "Space", "Esc": what is printed on it
  Modifiers modifiers;
  Action action;
  bool repeats;  // acts repeatedly while held
  std::string_view text;
  LayerId layer = {};                     // of Action::layer
  state::DeviceParameter parameter = {};  // of Action::device_gain, as the next
  double step = 0.0;                      // in the parameter's unit, on each axis
};

// Those of all layers (marks/layers.h) among them.
const std::vector<KeyBinding>& key_bindings();

// What a key does; null: nothing. `held`: a repeat event while the key stays down.
const KeyBinding* binding_of(std::string_view key, Modifiers modifiers, bool held);
Action action_of(std::string_view key, Modifiers modifiers, bool held);

std::string name_of(const KeyBinding& binding);  // "Ctrl+P"

// The help: keys with an action, an empty line, mouse gestures.
struct HelpLine {
  std::string name, text;
};
std::vector<HelpLine> help_table();
std::vector<std::string> help_lines();  // the same for a terminal
// Message for a key whose part of the simulator does not exist yet; empty for other keys.
std::string later_text(std::string_view key, Modifiers modifiers);
std::string keys_document();  // docs/keys.md

}  // namespace ambf::render
