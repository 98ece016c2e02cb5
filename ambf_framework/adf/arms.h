// Reads files of known arms (the terms: docs/kinematics.md). The one that comes with AMBF is part of the library. Never
// throws. Any thread.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "kinematics/arm.h"

namespace ambf::adf {

struct ArmTable {
  // Every arm with each of its tools, in the order of the file.
  std::vector<kinematics::Arm> arms;
  std::vector<std::string> names;          // of the arms
  std::vector<std::string> default_tools;  // of each of names; empty: the arm has no tools

  // An empty tool is the default one. Null for names that do not exist.
  const kinematics::Arm* find(const std::string& name, const std::string& tool = {}) const;
};

struct ArmsResult {
  ArmTable table;  // without the arms that are wrong
  base::Diagnostics diagnostics;
};

// `path` is used in messages.
ArmsResult parse_arms(const std::string& text, const std::string& path);

// PSM, ECM, MTM, KUKA, Raven: what the Python client reads from arms.yaml.
const ArmTable& known_arms();

}  // namespace ambf::adf
