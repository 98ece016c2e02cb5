#include <algorithm>
#include <set>
#include <sstream>

#include "scene/block_kinds.h"
#include "scene/detail/group_owners.h"

namespace ambf::scene {

namespace {

std::string json(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string reference(const Group& group) {
  return "{\"$ref\": " + json("#/definitions/" + std::string(group.title)) + "}";
}

std::string words(std::span<const Word> choices) {
  std::string out;
  for (const Word& word : choices) {
    out += (out.empty() ? "" : ", ") + json(word.text);
    if (word.text == "true" || word.text == "false") out += ", " + std::string(word.text);  // as YAML reads it
  }
  return "{\"enum\": [" + out + "]}";
}

constexpr std::string_view kNumber = R"({"type": "number"})";
constexpr std::string_view kText = R"({"type": ["string", "number"]})";

std::string three(std::string_view a, std::string_view b, std::string_view c) {
  std::string out = "{\"type\": \"object\", \"properties\": {";
  for (std::string_view part : {a, b, c}) out += (part == a ? "" : ", ") + json(part) + ": " + std::string(kNumber);
  return out + "}, \"required\": [" + json(a) + ", " + json(b) + ", " + json(c) + "], \"additionalProperties\": false}";
}

std::string list_of(std::string_view items) {
  return "{\"type\": [\"array\", \"null\"], \"items\": " + std::string(items) + "}";
}

std::string either(std::string_view one, std::string_view other) {
  return "{\"anyOf\": [" + std::string(one) + ", " + std::string(other) + "]}";
}

std::string type_of(const Key& key) {
  switch (key.type) {
    case KeyType::boolean: return R"({"enum": [true, false, 0, 1, "True", "False", "true", "false"]})";
    case KeyType::integer: return R"({"type": "integer"})";
    case KeyType::number: return std::string(kNumber);
    case KeyType::text:
    case KeyType::file:
    case KeyType::folder: return std::string(kText);
    case KeyType::choice: return words(key.words);
    case KeyType::vector: return three("x", "y", "z");
    case KeyType::rotation: return three("r", "p", "y");
    case KeyType::map: return reference(*key.sub);
    case KeyType::maps: return list_of(reference(*key.sub));
    case KeyType::texts: return list_of(kText);
    case KeyType::integers: return list_of(R"({"type": "integer"})");
    case KeyType::number_or_vector: return either(kNumber, three("x", "y", "z"));
    case KeyType::number_or_map: return either(kNumber, reference(*key.sub));
    case KeyType::text_or_map: return either(kText, reference(*key.sub));
    case KeyType::matrix: return list_of(list_of(kNumber));
    case KeyType::vector_or_map: return either(three("x", "y", "z"), reference(*key.sub));
  }
  return "{}";
}

std::string description_of(const Key& key, const void* owner) {
  std::string text(key.meaning);
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : " ") + more; };
  if (!key.unit.empty()) add("[" + std::string(key.unit) + "]");
  const std::string fallback = default_text(key, owner);
  if (!fallback.empty()) add("Default: " + fallback + ".");
  return text;
}

// A key with the description whose default it shows.
struct OwnedKey {
  const Key* key;
  const void* owner;
};

std::vector<OwnedKey> owned_keys(const Group& group, const GroupOwners& owners) {
  std::vector<OwnedKey> keys;
  for (const Key* key : own_keys(group)) keys.push_back({key, owners.of(group)});
  for (const Group* included : group.includes) {
    for (const Key& key : included->keys) keys.push_back({&key, owners.of(*included)});
  }
  return keys;
}

// `"key": {"allOf": [type], "description": ".."}` for each key, with `indent` before it.
void write_properties(std::ostringstream& out, const std::vector<OwnedKey>& keys, const std::string& indent) {
  const char* separator = "\n";
  for (const auto& [key, owner] : keys) {
    out << separator << indent << json(key->name) << ": {\"allOf\": [" << type_of(*key)
        << "], \"description\": " << json(description_of(*key, owner)) << "}";
    separator = ",\n";
  }
}

void write_definition(std::ostringstream& out, const Group& group, const GroupOwners& owners) {
  const std::vector<OwnedKey> keys = owned_keys(group, owners);
  out << "    " << json(group.title)
      << ": {\"type\": \"object\", \"additionalProperties\": " << (group.open ? "true" : "false")
      << ", \"properties\": {";
  write_properties(out, keys, "      ");
  out << "\n    }";
  std::string required;
  for (const auto& [key, owner] : keys) {
    if (key->required) required += (required.empty() ? "" : ", ") + json(key->name);
  }
  out << (required.empty() ? "}" : ", \"required\": [" + required + "]}");
}

// Blocks by their prefixes; several kinds may share one.
void write_prefixes(std::ostringstream& out) {
  std::vector<std::pair<std::string_view, std::string>> types;
  for (const BlockKind* kind : block_kinds()) {
    if (kind->prefix.empty()) continue;
    const auto known =
        std::find_if(types.begin(), types.end(), [kind](const auto& type) { return type.first == kind->prefix; });
    if (known == types.end()) {
      types.emplace_back(kind->prefix, reference(*kind->group));
    } else {
      known->second = either(known->second, reference(*kind->group));
    }
  }
  const char* separator = "";
  for (const auto& [prefix, type] : types) {
    out << separator << "    " << json("^" + std::string(prefix)) << ": " << type;
    separator = ",\n";
  }
}

}  // namespace

std::string keys_as_json_schema(const Defaults& defaults) {
  const GroupOwners owners(defaults);
  std::ostringstream out;
  out << "{\n  \"$schema\": \"http://json-schema.org/draft-07/schema#\",\n  \"title\": \"AMBF Description Format\",\n  "
         "\"type\": \"object\",\n"
      << "  \"properties\": {";
  std::vector<OwnedKey> header_keys;
  std::set<std::string_view> seen;
  for (const Group* group : all_groups()) {
    if (!group->is_header) continue;
    for (const OwnedKey& key : owned_keys(*group, owners)) {
      if (seen.insert(key.key->name).second) header_keys.push_back(key);
    }
  }
  write_properties(out, header_keys, "    ");
  out << "\n  },\n  \"patternProperties\": {\n";
  write_prefixes(out);
  out << "\n  },\n  \"definitions\": {\n";
  const char* separator = "";
  for (const Group* group : all_groups()) {
    if (group->is_header) continue;
    out << separator;
    write_definition(out, *group, owners);
    separator = ",\n";
  }
  out << "\n  }\n}\n";
  return out.str();
}

}  // namespace ambf::scene
