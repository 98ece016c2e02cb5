// Writes a description as ADF text: header and lists first, keys in the order of the table, without those whose values
// are the defaults. For models that were not read from text; what was is edited (adf/save.h). Pure, any thread.
#pragma once

#include <string>

#include "base/diagnostic.h"
#include "scene/description.h"

namespace ambf::adf {

struct WrittenModel {
  std::string text;
  base::Diagnostics diagnostics;  // errors: what no key can say, and what was left out
};

// parse_model() reads the same model from it: numbers to the bit, orientations and directions to the last digit (the
// format has angles, and normalises axes). Paths are absolute, or as the model has them.
WrittenModel write_model(const scene::Model& model);

}  // namespace ambf::adf
