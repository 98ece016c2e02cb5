// The key `instruments` of a CRTK arm: files of tools that its model may get. One thread.
#pragma once

#include <string>

#include "adf/crtk_arms.h"
#include "adf/document.h"
#include "adf/report.h"

namespace ambf::adf {

// Reads the files, too, but not their meshes. `folder`: where relative paths start. False: a mistake was reported.
bool read_instruments(const Value& arm_map, const std::string& folder, CrtkArm& arm, Report& report);

}  // namespace ambf::adf
