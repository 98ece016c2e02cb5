// Relative paths in a model file that moves to another folder.
#pragma once

#include <string>

#include "adf/detail/text_edit.h"

namespace ambf::adf {

// What must change so that a file in folder `to` names the same files as the one in folder `from`. Looks at what is
// there; what does not lead anywhere stays as it is.
Change moved_paths(const Value& root, const std::string& from, const std::string& to);

}  // namespace ambf::adf
