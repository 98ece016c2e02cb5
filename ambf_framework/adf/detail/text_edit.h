// Changes values of YAML text where they are written; every other byte stays what it was. Pure functions, any thread.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "adf/document.h"

namespace ambf::adf {

struct NamedChange;

// What shall become of a value and of what is in it; without any member, nothing.
struct Change {
  std::optional<std::string> scalar;    // it becomes this text
  std::vector<NamedChange> keys;        // of a map: these values change, or are added
  std::map<std::size_t, Change> items;  // of a list: these items change
  std::set<std::string> without;        // of a list: items of these texts are left out

  Change& key(std::string_view name);  // of a map; valid until the next key is made
  const Change* find(std::string_view name) const;
  bool empty() const;
};

struct NamedChange {
  std::string name;
  Change change;
};

struct EditedText {
  std::optional<std::string> text;
  std::optional<DocumentError> error;  // why there is none, and where
};

// `document` is what was read from `text`. Where an alias stands, what changes is written in its place, in full; the
// aliases of a value that changes keep what they meant likewise. Refuses what would not read back as wanted.
EditedText edit(const std::string& text, const Document& document, const Change& change);

// Whether `after` is `before` with the change, and nothing else (edit_check.cpp).
bool is_edited(const Value& before, const Change& change, const Value& after);

// A value as YAML text in one line, with a change; a text with quotes where it needs some (token.cpp).
std::string in_one_line(const Value& value, const Change& change);
std::string in_one_line(const Change& change);
std::string as_scalar(const std::string& text);

// Where the scalar or alias that starts at `at` ends; npos where that is not known (text over several lines).
// `in_flow`: within [] or {}.
std::size_t end_of_token(std::string_view text, std::size_t at, bool in_flow);
// Behind anchors and tags, where the value itself starts.
std::size_t behind_properties(std::string_view text, std::size_t at);

}  // namespace ambf::adf
