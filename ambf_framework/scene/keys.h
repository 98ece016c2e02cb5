// The one table of ADF keys. A row binds a key to the member that it fills, with unit, range, meaning and other
// spellings; the parser, docs/adf.md and docs/adf.schema.json walk the rows, and what a block is before it is read is
// the default that they show. Constant data once the program has registered its kinds of block; any thread.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/binding.h"
#include "scene/defaults.h"

namespace ambf::scene {

struct Group;

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
  vector_or_map,
  matrix  // four lists of four numbers
};

enum class Rule { none, not_negative, positive };

enum class KeyStatus {
  current,
  older,    // an older spelling or syntax: works, with a warning that names Key::preferred where there is one
  ignored,  // written by tools, never had a meaning
  unread,   // in files of the original, which never read it: information
  later     // known, not simulated yet: information
};

// A word of a choice, and what it means as an enumerator.
struct Word {
  std::string_view text;
  int value = 0;
};

struct Key {
  std::string_view name;
  KeyType type = KeyType::text;
  Binding member =
      {};  // what it fills; none: read by the block's own parser, or a map whose keys fill the same description
  std::string_view unit = {};
  std::string_view fallback = {};  // the default in words, where the member's own value does not say it
  std::string_view meaning = {};
  const Group* sub = nullptr;
  Rule rule = Rule::none;                                // for every number of the value
  double max = std::numeric_limits<double>::infinity();  // what is above is cut, with a warning
  bool required = false;
  KeyStatus status = KeyStatus::current;
  std::string_view preferred = {};   // the key that means the same and goes before this one
  std::span<const Word> words = {};  // choice: the accepted words
  // choice: what an unknown word counts as, after a warning ("none": it is left out); empty: an error
  std::string_view instead = {};
};

// What a map in an ADF file can be: a file's header, a block, or a map inside of one.
struct Group {
  std::string_view title = {};  // "body", as in "a key of bodies"
  std::string_view meaning = {};
  std::span<const Key> keys = {};
  std::span<const Group* const> includes = {};  // groups whose keys belong here too
  bool is_block = false;
  bool is_header = false;
  bool open = false;  // keys that are not in the table belong to somebody else, and are not reported
};

namespace group {
extern const Group kModel, kWorld, kLaunch, kInputDevices;
extern const Group kBody, kJoint, kCamera, kLight, kInputDevice;
extern const Group kIdentity, kVisual, kCollision, kColor;
extern const Group kPose, kColorRgba, kColorComponents, kPlugin, kResistiveSurface;
}  // namespace group

// All groups, in the order in which docs/adf.md shows them; registered kinds come last.
std::vector<const Group*> all_groups();

// The key of that name in the group or in what it includes; null when there is none.
const Key* find_key(const Group& group, std::string_view name);
// All keys of a group, includes and older spellings among them; of a model file also the lists of all kinds of block.
std::vector<const Key*> keys_of(const Group& group);
std::vector<std::string> key_names(const Group& group);
// Kinds of block other than `group` that know this key, e.g. "joint, camera"; "" when none does.
std::string other_blocks_with(std::string_view name, const Group& group);
// The word of a choice; null when it is none of them.
const Word* find_word(const Key& key, std::string_view text);

// Do the keys of the key's map fill the description that holds the key? They do where they are bound and the key itself
// is not.
bool fills_owner(const Key& key);

// What a user reads about a type: "a number", "a vector {x, y, z}".
std::string_view describe(KeyType type);
// A number with as many digits as it takes.
std::string text_of(double number);
// A key's default as text: that of `owner`, the description that the key's group fills.
std::string default_text(const Key& key, const void* owner);
// The default of a key of `group` or of what it includes.
std::string default_in(const Group& group, const Key& key, const Defaults& defaults = {});

// docs/adf.md.
std::string keys_as_markdown(const Defaults& defaults = {});
// docs/adf.schema.json: a JSON Schema of all kinds of ADF file, for completion and hints in editors. Blocks are known
// by their usual prefixes (BODY, JOINT, ..); any other block may hold anything.
std::string keys_as_json_schema(const Defaults& defaults = {});

}  // namespace ambf::scene
