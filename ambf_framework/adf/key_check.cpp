#include "adf/detail/key_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "adf/detail/scalars.h"
#include "scene/bounds.h"

namespace ambf::adf {

using scene::Key;
using scene::KeyStatus;
using scene::KeyType;

namespace {

constexpr const char* kVectorParts[3] = {"x", "y", "z"};
constexpr const char* kRotationParts[3] = {"r", "p", "y"};

// A bare vector stands where a map may stand too: it has x, y and z.
bool looks_like_vector(const Value& value) { return value.is_map() && value.find("x").has_value(); }

bool is_part(const std::string& key, const char* const (&parts)[3]) {
  return std::find(std::begin(parts), std::end(parts), key) != std::end(parts);
}

}  // namespace

bool KeyCheck::wrong(Mark at, const std::string& name, const std::string& expected, const std::string& found,
                     std::string hint) const {
  report.add(wrong_value, at, name, "expected " + expected + ", found " + found, std::move(hint));
  return false;
}

bool KeyCheck::map(const Value& map, const scene::Group& group, const std::string& path) const {
  bool good = true;
  std::unordered_map<std::string_view, int> seen;  // key -> line
  for (std::size_t i = 0; i < map.size(); ++i) {
    const auto [name, value] = map.entry(i);
    if (!name.is_scalar()) {
      report.warning(name.mark(), path, "a key must be text, found " + describe(name), "the value is left out");
      continue;
    }
    const std::string full = path + printable(name.text());
    if (const auto [first, is_new] = seen.emplace(name.text(), name.mark().line); !is_new) {
      report.warning(name.mark(), full,
                     "given twice; the first value counts (line " + std::to_string(first->second) + ")",
                     "remove one of them");
      continue;
    }
    const Key* key = scene::find_key(group, name.text());
    if (!key) {
      if (!group.open) unknown(name, group, path);
      continue;
    }
    if (key->status == KeyStatus::ignored) continue;
    if (value.is_absent()) {
      if (value.is_scalar()) continue;
      const std::string default_value = report.full() ? std::string() : scene::default_in(group, *key);
      report.information(name.mark(), full, "has no value; the default counts",
                         default_value.empty() ? "" : "default: " + default_value);
      continue;
    }
    if (key->status == KeyStatus::older && !key->preferred.empty()) {
      report.warning(name.mark(), full, "older spelling", "write `" + std::string(key->preferred) + "`");
    }
    if (key->status == KeyStatus::later) later(name.mark(), *key, value, full);
    if (key->status == KeyStatus::unread) unread(name.mark(), *key, full);
    good &= this->value(value, *key, full);
  }
  for (const Key* key : scene::keys_of(group)) {
    if (!key->required || map.find(key->name)) continue;
    report.add(wrong_value, map.mark(), path + std::string(key->name),
               "missing; expected " + std::string(scene::describe(key->type)), "add `" + std::string(key->name) + "`");
    good = false;
  }
  return good;
}

void KeyCheck::later(Mark at, const Key& key, const Value& value, const std::string& name) const {
  if (key.type == KeyType::boolean && value.is_scalar() && to_boolean(value.text()) == false) return;
  const char* state = key.sub == &scene::group::kPlugin             ? "plugins are not loaded yet"
                      : key.sub == &scene::group::kResistiveSurface ? "not simulated yet"
                                                                    : "has no effect yet";
  report.information(at, name, state, "all else here has");
}

void KeyCheck::unread(Mark at, const Key& key, const std::string& name) const {
  report.information(at, name, "has no effect", std::string(key.meaning));
}

bool KeyCheck::value(const Value& value, const Key& key, const std::string& name) const {
  const std::string expected(scene::describe(key.type));
  const auto sub_map = [&] {
    if (!value.is_map()) return wrong(value.mark(), name, expected, describe(value));
    return map(value, *key.sub, name + "/");
  };
  switch (key.type) {
    case KeyType::boolean:
      return (value.is_scalar() && to_boolean(value.text())) || wrong(value.mark(), name, expected, describe(value));
    case KeyType::integer: return integer(value, key, name);
    case KeyType::number: return number(value, key, name);
    case KeyType::text:
    case KeyType::file:
    case KeyType::folder: return value.is_scalar() || wrong(value.mark(), name, expected, describe(value));
    case KeyType::choice: return choice(value, key, name);
    case KeyType::vector: return numbers(value, key, name, kVectorParts);
    case KeyType::rotation: return numbers(value, key, name, kRotationParts);
    case KeyType::map: return sub_map();
    case KeyType::maps:
    case KeyType::texts:
    case KeyType::integers: return list(value, key, name);
    case KeyType::number_or_vector:
      return value.is_map() ? numbers(value, key, name, kVectorParts) : number(value, key, name);
    case KeyType::number_or_map: return value.is_map() ? sub_map() : number(value, key, name);
    case KeyType::text_or_map: return value.is_scalar() || sub_map();
    case KeyType::matrix: return true;  // an unreadable one is ignored: by the block's parser
    case KeyType::vector_or_map: return looks_like_vector(value) ? numbers(value, key, name, kVectorParts) : sub_map();
  }
  return true;
}

bool KeyCheck::rule(double number, Mark at, const Key& key, const std::string& name) const {
  const std::string found = "the number " + scene::text_of(number);
  if (key.rule == scene::Rule::positive && number <= 0.0) return wrong(at, name, "a number above 0", found);
  if (key.rule == scene::Rule::not_negative && number < 0.0) return wrong(at, name, "a number of at least 0", found);
  if (const std::string bound = scene::out_of_bounds(number, key); !bound.empty()) {
    return wrong(at, name, "a number of " + bound, found, "docs/limits.md lists all bounds");
  }
  if (number > key.max) {
    const std::string max = scene::text_of(key.max);
    report.warning(at, name,
                   "expected " + (key.rule == scene::Rule::not_negative ? "0 to " + max : "at most " + max) +
                       ", found " + scene::text_of(number),
                   max + " is used" + (key.unit == "rad" ? "; the angle is in radians" : ""));
  }
  return true;
}

bool KeyCheck::number(const Value& value, const Key& key, const std::string& name) const {
  const auto number = value.is_scalar() ? to_number(value.text()) : std::nullopt;
  if (!number) return wrong(value.mark(), name, std::string(scene::describe(key.type)), describe(value));
  if (!std::isfinite(*number)) return wrong(value.mark(), name, "a finite number", in_quotes(value.text()));
  return rule(*number, value.mark(), key, name);
}

bool KeyCheck::integer(const Value& value, const Key& key, const std::string& name) const {
  const auto number = value.is_scalar() ? to_integer(value.text()) : std::nullopt;
  if (!number) return wrong(value.mark(), name, "a whole number", describe(value));
  constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
  if (*number > kLargest || *number < -kLargest) {
    return wrong(value.mark(), name, "a whole number below " + std::to_string(kLargest), describe(value));
  }
  return rule(static_cast<double>(*number), value.mark(), key, name);
}

bool KeyCheck::numbers(const Value& value, const Key& key, const std::string& name,
                       const char* const (&parts)[3]) const {
  const std::string expected(scene::describe(key.type));
  if (!value.is_map()) return wrong(value.mark(), name, expected, describe(value));
  bool good = true;
  for (const char* part : parts) {
    const auto component = value.find(part);
    if (!component) {
      good = wrong(value.mark(), name, expected, std::string("no `") + part + "`");
    } else {
      good &= number(*component, key, name + "/" + part);
      if (key.type == KeyType::rotation && std::abs(to_number(component->text()).value_or(0.0)) > kManyTurns)
        report.warning(component->mark(), name + "/" + part, kInRadians);
    }
  }
  std::vector<std::string_view> seen;
  for (std::size_t i = 0; i < value.size() && i < 16; ++i) {
    const Value part = value.entry(i).key;
    const bool known =
        part.is_scalar() && (part.text() == parts[0] || part.text() == parts[1] || part.text() == parts[2]);
    const std::string full = name + "/" + (part.is_scalar() ? printable(part.text()) : "");
    if (!known) {
      report.warning(part.mark(), full, "unknown key", "expected " + expected);
    } else if (std::find(seen.begin(), seen.end(), part.text()) != seen.end()) {
      report.warning(part.mark(), full, "given twice; the first value counts", "remove one of them");
    } else {
      seen.push_back(part.text());
    }
  }
  return good;
}

bool KeyCheck::list(const Value& value, const Key& key, const std::string& name) const {
  if (!value.is_list()) return wrong(value.mark(), name, std::string(scene::describe(key.type)), describe(value));
  bool good = true;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Value item = value.item(i);
    const std::string full = name + "[" + std::to_string(i) + "]";
    if (key.type == KeyType::maps) {
      good &= item.is_map() ? map(item, *key.sub, full + "/") : wrong(item.mark(), full, "a map", describe(item));
    } else if (key.type == KeyType::integers) {
      good &= integer(item, key, full);
    } else if (!item.is_scalar()) {
      good = wrong(item.mark(), full, "a name", describe(item));
    }
  }
  return good;
}

bool KeyCheck::choice(const Value& value, const Key& key, const std::string& name) const {
  if (!value.is_scalar()) return wrong(value.mark(), name, "one of the known words", describe(value));
  if (scene::find_word(key, value.text()) != nullptr) return true;
  std::vector<std::string> words;
  for (const scene::Word& word : key.words) words.emplace_back(word.text);
  std::string expected;
  for (const std::string& word : words) expected += (expected.empty() ? "one of: " : ", ") + word;
  const std::string near = report.nearest(value.text(), words);
  std::string hint = near.empty() ? "" : "did you mean `" + near + "`?";
  if (key.instead.empty()) return wrong(value.mark(), name, expected, describe(value), std::move(hint));
  hint += hint.empty() ? "" : " ";
  hint += scene::find_word(key, key.instead) == nullptr ? "it is left out" : std::string(key.instead) + " is used";
  report.warning(value.mark(), name, "expected " + expected + ", found " + describe(value), std::move(hint));
  return true;
}

void KeyCheck::unknown(const Value& key, const scene::Group& group, const std::string& path) const {
  if (report.full()) return report.warning(key.mark(), {}, "unknown key");  // counted only
  std::string hint;
  const std::string near = report.nearest(key.text(), scene::key_names(group));
  const std::string others = group.is_block ? scene::other_blocks_with(key.text(), group) : "";
  if (key.text() == "<<") {
    hint = "ADF has no merge keys: repeat the keys, or give each value an anchor";
  } else if (&group == &scene::group::kPose && is_part(key.text(), kVectorParts)) {
    hint = "write `position: {x, y, z}`";
  } else if (&group == &scene::group::kPose && is_part(key.text(), kRotationParts)) {
    hint = "write `orientation: {r, p, y}`";
  } else if (!others.empty()) {
    hint = "it is a key of: " + others;
  } else if (!near.empty()) {
    hint = "did you mean `" + near + "`?";
  } else {
    hint = "known keys: docs/adf.md, section `" + std::string(group.title) + "`";
  }
  report.warning(key.mark(), path + printable(key.text()), "unknown key; it has no effect", hint);
}

}  // namespace ambf::adf
