#include <set>
#include <sstream>

#include "scene/keys.h"

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

std::string reference(Group group) {
  return "{\"$ref\": " + json("#/definitions/" + std::string(group_info(group).title)) + "}";
}

std::string words(std::string_view choices) {
  std::string out = "{\"enum\": [";
  while (true) {
    const std::size_t end = choices.find('|');
    out += json(choices.substr(0, end));
    if (end == std::string_view::npos) return out + "]}";
    out += ", ";
    choices.remove_prefix(end + 1);
  }
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
    case KeyType::choice: return words(key.choices);
    case KeyType::vector: return three("x", "y", "z");
    case KeyType::rotation: return three("r", "p", "y");
    case KeyType::map: return reference(key.sub);
    case KeyType::maps: return list_of(reference(key.sub));
    case KeyType::texts: return list_of(kText);
    case KeyType::integers: return list_of(R"({"type": "integer"})");
    case KeyType::number_or_vector: return either(kNumber, three("x", "y", "z"));
    case KeyType::number_or_map: return either(kNumber, reference(key.sub));
    case KeyType::text_or_map: return either(kText, reference(key.sub));
    case KeyType::vector_or_map: return either(three("x", "y", "z"), reference(key.sub));
  }
  return "{}";
}

std::string description_of(const Key& key) {
  std::string text(key.meaning);
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : " ") + more; };
  if (!key.unit.empty()) add("[" + std::string(key.unit) + "]");
  if (!key.fallback.empty()) add("Default: " + std::string(key.fallback) + ".");
  return text;
}

// `"key": {"allOf": [type], "description": ".."}` for each key, with `indent` before it.
void write_properties(std::ostringstream& out, const std::vector<const Key*>& keys, const std::string& indent) {
  const char* separator = "\n";
  for (const Key* key : keys) {
    out << separator << indent << json(key->name) << ": {\"allOf\": [" << type_of(*key)
        << "], \"description\": " << json(description_of(*key)) << "}";
    separator = ",\n";
  }
}

void write_definition(std::ostringstream& out, const GroupInfo& info) {
  const std::vector<const Key*> keys = keys_of(info.group);
  out << "    " << json(info.title)
      << ": {\"type\": \"object\", \"additionalProperties\": " << (info.open ? "true" : "false")
      << ", \"properties\": {";
  write_properties(out, keys, "      ");
  out << "\n    }";
  const char* separator = ", \"required\": [";
  bool any = false;
  for (const Key* key : keys) {
    if (!key->required) continue;
    out << separator << json(key->name);
    separator = ", ";
    any = true;
  }
  out << (any ? "]}" : "}");
}

}  // namespace

std::string keys_as_json_schema() {
  std::ostringstream out;
  out << "{\n  \"$schema\": \"http://json-schema.org/draft-07/schema#\",\n  \"title\": \"AMBF Description Format\",\n  "
         "\"type\": \"object\",\n"
      << "  \"properties\": {";
  std::vector<const Key*> header_keys;
  std::set<std::string_view> seen;
  for (const GroupInfo* info : all_groups()) {
    if (!info->is_header) continue;
    for (const Key& key : info->keys) {
      if (seen.insert(key.name).second) header_keys.push_back(&key);
    }
  }
  write_properties(out, header_keys, "    ");
  out << "\n  },\n  \"patternProperties\": {\n";
  const std::pair<const char*, Group> prefixes[] = {{"^BODY ", Group::body},       {"^JOINT ", Group::joint},
                                                    {"^SENSOR ", Group::sensor},   {"^ACTUATOR ", Group::actuator},
                                                    {"^VEHICLE ", Group::vehicle}, {"^GHOST ", Group::ghost_object}};
  const char* separator = "";
  for (const auto& [prefix, group] : prefixes) {
    // Soft bodies are called BODY too.
    const std::string type =
        group == Group::body ? either(reference(group), reference(Group::soft_body)) : reference(group);
    out << separator << "    " << json(prefix) << ": " << type;
    separator = ",\n";
  }
  out << "\n  },\n  \"definitions\": {\n";
  separator = "";
  for (const GroupInfo* info : all_groups()) {
    if (info->is_header) continue;
    out << separator;
    write_definition(out, *info);
    separator = ",\n";
  }
  out << "\n  }\n}\n";
  return out.str();
}

}  // namespace ambf::scene
