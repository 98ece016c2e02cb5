// The one table of ADF keys: name, type, unit, default, meaning and older spellings of every key of every kind of block. The parser checks
// against it, its hints are drawn from it, and docs/adf.md is written from it. Constant data; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ambf::scene {

// What a map in an ADF file can be: a whole file's header, a block, or a map inside of one.
enum class Group {
  none,
  // headers
  model,
  world,
  launch,
  input_devices,
  // blocks
  body,
  joint,
  camera,
  light,
  soft_body,
  ghost_object,
  vehicle,
  volume,
  sensor,
  actuator,
  input_device,
  // keys that several kinds of block share
  identity,
  visual_keys,
  collision_keys,
  color_keys,
  // maps inside of blocks
  pose,
  geometry,
  placed_shape,
  inertia,
  friction,
  body_damping,
  cartesian_controller,
  gains,
  rates,
  color_rgba,
  rgb,
  color_components,
  ambient,
  shaders,
  plugin,
  joint_limits,
  range_xyz,
  linear_angular,
  clipping_plane,
  stereo,
  resolution,
  depth_noise,
  mouse,
  attenuation,
  enclosure,
  skybox,
  resistive_surface,
  sensor_friction,
  ray,
  parametric,
  soft_config,
  wheel,
  suspension,
  steering_limits,
  images,
  haptic_gain,
  controller_gain,
  button_mapping
};

enum class KeyType {
  boolean,
  integer,
  number,
  text,
  file,
  folder,
  choice,
  vector,    // {x, y, z}
  rotation,  // {r, p, y}, rad, R = Rz(y) Ry(p) Rx(r)
  map,       // of Key::sub
  maps,      // list of maps of Key::sub
  texts,
  integers,          // lists
  number_or_vector,  // one number for all axes, or {x, y, z}
  number_or_map,
  text_or_map,
  vector_or_map
};

enum class Rule { none, not_negative, positive };

enum class KeyStatus {
  current,
  older,    // an older spelling or syntax: works, with a warning that names Key::newer where there is one
  ignored,  // written by tools, never had a meaning
  unread,   // in files of the original, which never read it: information
  later     // known, not simulated yet: information
};

struct Key {
  std::string_view name;
  KeyType type = KeyType::text;
  std::string_view unit = {};
  std::string_view fallback = {};  // the default, as text
  std::string_view meaning = {};
  Group sub = Group::none;
  Rule rule = Rule::none;  // for every number of the value
  bool required = false;
  KeyStatus status = KeyStatus::current;
  std::string_view newer = {};    // older spellings: what to write instead
  std::string_view choices = {};  // choice: the accepted words, separated by '|'
  std::string_view instead = {};  // choice: what an unknown word leads to, after a warning; empty: an error
};

struct GroupInfo {
  Group group = Group::none;
  std::string_view title;  // "body", as in "a key of bodies"
  std::string_view meaning;
  std::span<const Key> keys;
  std::span<const Group> includes = {};  // groups whose keys belong here too
  bool is_block = false;
  bool is_header = false;
  bool open = false;  // keys that are not in the table are passed on to somebody else, and are not reported
};

// All groups, in the order in which docs/adf.md shows them.
std::span<const GroupInfo* const> all_groups();
const GroupInfo& group_info(Group group);

// The key of that name in the group or in what it includes; null when there is none.
const Key* find_key(Group group, std::string_view name);
// Is `word` one of the choices of the key?
bool knows_choice(const Key& key, std::string_view word);
// Names of all keys of a group, includes and older spellings among them.
std::vector<std::string> key_names(Group group);
std::vector<const Key*> keys_of(Group group);
// Kinds of block other than `group` that know this key, e.g. "joint, camera"; "" when none does.
std::string other_blocks_with(std::string_view name, Group group);

// Header lists: their key in the header and the kind of block that they list.
struct HeaderList {
  std::string_view key;
  Group block;
  bool simulated;  // false: known and checked, "not simulated yet"
};
std::span<const HeaderList> model_lists();

// What a user reads about a type: "a number", "a vector {x, y, z}".
std::string_view describe(KeyType type);

// docs/adf.md.
std::string keys_as_markdown();
// docs/adf.schema.json: a JSON Schema of all kinds of ADF file, for completion and hints in editors. Blocks are known by their usual
// prefixes (BODY, JOINT, ..); any other block may hold anything.
std::string keys_as_json_schema();

}  // namespace ambf::scene
