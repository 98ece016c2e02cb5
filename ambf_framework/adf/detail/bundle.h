// The meshes of a model beside its file: where they are copied, and what the text then says.
#pragma once

#include <string>
#include <vector>

#include "adf/detail/text_edit.h"
#include "adf/save.h"

namespace ambf::adf {

struct Bundle {
  Change change;
  std::vector<Copy> copies;
  std::vector<std::string> missing;  // as the text names them: meshes that are nowhere; they are named as they were
};

// `from`, `to`: the file that was read and the one that is written. The meshes go to a folder beside `to`, NAME_meshes,
// those of the low resolution path to `low` in it; meshes of different folders stay apart.
Bundle bundle_of(const Value& root, const std::string& from, const std::string& to);

// What `more` changes, in addition.
void add_to(Change& change, Change more);

}  // namespace ambf::adf
