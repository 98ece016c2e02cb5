#include <cmath>
#include <sstream>

#include "scene/detail/group_owners.h"

namespace ambf::scene {

namespace {

// '|' ends a table cell in Markdown.
std::string cell(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '|') {
      out += ", ";
    } else {
      out += c;
    }
  }
  return out;
}

std::string anchor(std::string_view title) {
  std::string out;
  for (char c : title) out += c == ' ' ? '-' : c;
  return out;
}

std::string type_of(const Key& key) {
  std::string text(describe(key.type));
  if (key.sub != nullptr) {
    const std::string title(key.sub->title);
    text += ": [" + title + "](#" + anchor(title) + ")";
  }
  return text;
}

std::string meaning_of(const Key& key) {
  std::string text = cell(key.meaning);
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : " ") + more; };
  if (!key.words.empty()) {
    std::string words;
    for (const Word& word : key.words) words += (words.empty() ? "" : ", ") + std::string(word.text);
    add("One of: " + words + ".");
  }
  if (key.rule == Rule::positive) add("> 0.");
  if (key.rule == Rule::not_negative) add(">= 0.");
  if (std::isfinite(key.max)) add("At most " + text_of(key.max) + ".");
  switch (key.status) {
    case KeyStatus::current:
      if (!key.preferred.empty()) add("`" + std::string(key.preferred) + "` goes before it.");
      break;
    case KeyStatus::older:
      add(key.preferred.empty() ? "Older." : "Older spelling of `" + std::string(key.preferred) + "`.");
      break;
    case KeyStatus::ignored:
    case KeyStatus::unread: add("Accepted, without effect."); break;
    case KeyStatus::later: add("Not in effect yet."); break;
  }
  return text;
}

void write_group(std::ostringstream& out, const Group& info, const void* owner) {
  out << "\n### " << info.title << "\n\n";
  if (!info.meaning.empty()) out << info.meaning << "\n\n";
  if (!info.includes.empty()) {
    out << "Also the keys of";
    const char* separator = " ";
    for (const Group* included : info.includes) {
      const std::string title(included->title);
      out << separator << "[" << title << "](#" << anchor(title) << ")";
      separator = ", ";
    }
    out << ".\n\n";
  }
  if (info.keys.empty()) return;  // any key
  out << "| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const Key* key : own_keys(info)) {
    out << "| `" << key->name << "` | " << type_of(*key) << " | " << key->unit << " | "
        << (key->required ? "required" : default_text(*key, owner)) << " | " << meaning_of(*key) << " |\n";
  }
}

constexpr const char* kIntroduction =
    R"(# ADF: the format of models, worlds and launch files

<!-- Written from the table of keys in ambf_framework/scene. To renew it: AMBF_UPDATE_DOCS=1 build/bin/ambf_scene_tests -->

ADF files are YAML. SI units and radians everywhere. `ambf_simulator --check FILE` reports what it finds in a file.

Editors that know JSON Schema complete keys and mark errors with `docs/adf.schema.json`: put
`# yaml-language-server: $schema=PATH/adf.schema.json` on a file's first line.

- Lists at the top of a file name the blocks to load (`bodies: [BODY Base]`); a block that no list names is not loaded. Unknown plain
  values at the top are fine when they carry an anchor (`radius: &r 0.3`).
- A block's key is its identifier, spaces kept; it is how joints, cameras and lights name it. `name`, spaces removed, is what topics carry.
  Before both goes the namespace: the file's, with the block's own behind it, or the block's own alone when it starts with `/`.
- Paths start at the folder of the file they stand in.
- A vector is `{x: , y: , z: }`, a rotation `{r: , p: , y: }`: R = Rz(y) Ry(p) Rx(r). Booleans take YAML's spellings, and 0 and 1.
- The same key twice in one map: the first counts. Numbers must be finite.

What goes wrong costs no more than what it stands in:

| found | effect | `--check` |
|---|---|---|
| YAML syntax, header of a wrong type, unsupported version, unreadable file; a launch, world, colour or input devices file loaded as a model | the file is refused | 1 |
| missing or unreadable mesh | that visual or collision is left out, the body stays | 1 |
| listed but undefined block, NaN or infinity, zero axis, negative mass, absent parent of a joint, joint of a body with itself, unknown type of joint, wrong value type | the block is dropped, the rest loads | 1 |
| an empty text (`''` for a mesh, its type, a parent, ...) | as if the key were not there | 0 |
| unknown word of a choice that has a default | warning, the default | 0 (`--strict`: 1) |
| unknown or duplicate key, block listed twice (made once), duplicate name (the second is renamed), reversed limits (free joint), axis that is no unit vector (normalised), older spelling, a body's FORCE gains that cannot be stable (cut), material that is not there, parent of a camera or light that is itself or hangs on it | warning | 0 (`--strict`: 1) |
| defaults assumed, a parent that is not loaded yet, not simulated yet | information | 0 |

## Keys
)";

}  // namespace

std::string keys_as_markdown(const Defaults& defaults) {
  const GroupOwners owners(defaults);
  std::ostringstream out;
  out << kIntroduction;
  for (const Group* group : all_groups()) write_group(out, *group, owners.of(*group));
  return out.str();
}

}  // namespace ambf::scene
