// The keys of a window: one table that the handler, the help and docs/keys.md are made from. Pure data and functions, any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ambf::render {

enum class Action {
  none,
  quit,
  help,
  pause,
  step_once,
  step_ten,
  reset_bodies,
  reset_world,
  reset_cameras,
  gravity_on,
  gravity_off,
  picking,
  remove_picked,
  full_screen,
  all_frames,
  picked_frame,
  collision_shapes,
  joints,
  contacts,
  masses,
  wireframe,
  names,
  velocities,
  no_visuals,
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
  later,  // belongs to a part of the simulator that is still to come
};

struct Modifiers {
  bool control = false, alt = false, shift = false;
  bool operator==(const Modifiers&) const = default;
};

struct KeyBinding {
  std::string_view key;  // "Q", "1", "Space", "Esc": what is printed on it
  Modifiers modifiers;
  Action action;
  bool repeats;  // acts again while it is held
  std::string_view text;
};

const std::vector<KeyBinding>& key_bindings();

// What a key does; none when nothing. `held` for the events that follow while it stays down.
Action action_of(std::string_view key, Modifiers modifiers, bool held);

std::string name_of(const KeyBinding& binding);  // "Ctrl+P"

// What the help shows: keys that do something, then the mouse; an empty line between them.
struct HelpLine {
  std::string name, text;
};
std::vector<HelpLine> help_table();
std::vector<std::string> help_lines();  // the same for a terminal
// What to tell who presses a key that belongs to what is still to come; empty for others.
std::string later_text(std::string_view key, Modifiers modifiers);
std::string keys_document();  // docs/keys.md

}  // namespace ambf::render
