// Holds a map of the file against the table of keys: unknown, older and repeated keys, missing ones, values of the
// wrong type. What passes can be read without further questions (fields.h). One thread.
#pragma once

#include <string>

#include "adf/document.h"
#include "adf/report.h"
#include "scene/keys.h"

namespace ambf::adf {

struct KeyCheck {
  Report& report;
  // What a wrong value costs: an error drops the block; a warning is enough where nothing is made of the block yet.
  base::Severity wrong_value = base::Severity::error;

  // False when something is wrong with a value, or a required key is missing. `path` is what stands before keys in
  // messages ("controller/").
  bool map(const Value& map, const scene::Group& group, const std::string& path = {}) const;
  // One value against its key.
  bool value(const Value& value, const scene::Key& key, const std::string& name) const;
  // Says that a key has no effect yet; not where its value asks for nothing.
  void later(Mark at, const scene::Key& key, const Value& value, const std::string& name) const;
  // Informs about a key that files of the original carry though it never read it.
  void unread(Mark at, const scene::Key& key, const std::string& name) const;

 private:
  bool wrong(Mark at, const std::string& name, const std::string& expected, const std::string& found,
             std::string hint = {}) const;
  bool number(const Value& value, const scene::Key& key, const std::string& name) const;
  bool integer(const Value& value, const scene::Key& key, const std::string& name) const;
  bool numbers(const Value& value, const scene::Key& key, const std::string& name, const char* const (&parts)[3]) const;
  bool list(const Value& value, const scene::Key& key, const std::string& name) const;
  bool choice(const Value& value, const scene::Key& key, const std::string& name) const;
  bool rule(double number, Mark at, const scene::Key& key, const std::string& name) const;
  void unknown(const Value& key, const scene::Group& group, const std::string& path) const;
};

}  // namespace ambf::adf
