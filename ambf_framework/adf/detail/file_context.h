// What the parsers of one file share: its report, folder, header and options; and what every block goes through before
// its own parser. One thread.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "adf/adf.h"
#include "adf/detail/fields.h"
#include "adf/document.h"
#include "adf/report.h"
#include "scene/keys.h"

namespace ambf::adf {

// Names of one kind of object in one file, so that repeated ones get numbers (Box, Box1, Box2).
class NameBook {
 public:
  // The number that makes the name unique, "" when it is; takes the resulting name.
  std::string take(const std::string& name);

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::size_t> next_;
};

struct FileContext {
  Report& report;
  const Options& options;
  std::string folder;               // of the file
  std::string name_space;           // of the header
  std::string high_path, low_path;  // of the header, as written
};

// A block that a header list names, checked against the table.
struct Block {
  std::string identifier;  // as listed
  Fields fields;
  Mark where;
};

// The top level of a file: what it says, and where its blocks are. The first of repeated keys counts.
class Header {
 public:
  // Checks version, header keys and their values; false when the file is refused.
  static bool check(const Value& root, const scene::Group& group, Report& report);
  explicit Header(const Value& root);

  const Fields& fields() const { return fields_; }
  // The blocks that list `key` names, in order; undefined or wrong ones are reported and left out.
  std::vector<Block> blocks(const std::string& key, const scene::Group& group, Report& report, bool simulated = true);

 private:
  Fields fields_;
  std::unordered_map<std::string_view, Value> by_name_;
  std::vector<std::string> names_;  // of by_name_, for hints
  std::uint64_t work_ = 0;          // values checked so far
};

// The block's identity; `names` keeps the names of its kind apart.
scene::Identity parse_identity(const Block& block, const FileContext& file, NameBook& names);

// A shader pair; none when a file is missing (a warning).
scene::Shaders parse_shaders(const Fields& block, std::string_view key, const FileContext& file);

// Unit vector along an axis key; none (and an error) when it is zero, a warning when it was far from a unit vector.
std::optional<math::Vec3> parse_axis(const Fields& block, std::string_view key, const math::Vec3& fallback,
                                     Report& report);

}  // namespace ambf::adf
