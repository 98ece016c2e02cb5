// Shorthand for tests of adf/: parse a text, and look for findings by regular expression.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>

#include "adf/adf.h"

namespace ambf::adf {

inline std::string all_of(const base::Diagnostics& diagnostics) {
  std::string text;
  for (const base::Diagnostic& diagnostic : diagnostics) text += base::to_string(diagnostic) + "\n";
  return text;
}

inline std::size_t count(const base::Diagnostics& diagnostics, base::Severity severity) {
  return static_cast<std::size_t>(std::count_if(diagnostics.begin(), diagnostics.end(),
                                                [severity](const auto& d) { return d.severity == severity; }));
}

// Does one finding, as users read it, hold the expression?
inline ::testing::AssertionResult says(const base::Diagnostics& diagnostics, const std::string& expression) {
  const std::regex regex(expression);
  for (const base::Diagnostic& diagnostic : diagnostics) {
    if (std::regex_search(base::to_string(diagnostic), regex)) return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "no finding like '" << expression << "' in:\n" << all_of(diagnostics);
}

inline ::testing::AssertionResult no_worse_than_information(const base::Diagnostics& diagnostics) {
  if (!base::has_errors(diagnostics) && !base::has_warnings(diagnostics)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << all_of(diagnostics);
}

inline ModelResult parse(const std::string& text) {
  Options options;
  options.look_for_files = false;
  return parse_model(text, "model.yaml", options);
}

// A model of one body, `keys` being flow style: "mass: 1, mesh: a.stl".
inline ModelResult parse_body_keys(const std::string& keys) {
  return parse("bodies: [BODY A]\nnamespace: /t/\nBODY A: {name: A, " + keys + "}\n");
}

// Two bodies and one joint with the given keys on top of complete ones.
inline ModelResult parse_joint_keys(const std::string& keys, const std::string& type = "revolute") {
  return parse(
      "bodies: [BODY A, BODY B]\njoints: [JOINT J]\nnamespace: /t/\n"
      "BODY A: {name: A, mass: 1}\nBODY B: {name: B, mass: 1}\n"
      "JOINT J: {name: J, parent: BODY A, child: BODY B, type: " +
      type +
      ", parent pivot: {x: 1, y: 2, z: 3}, child pivot: {x: 4, y: 5, z: 6}, parent axis: {x: 0, y: 0, z: 1}, child "
      "axis: {x: 0, y: 1, z: 0}" +
      (keys.empty() ? "" : ", " + keys) + "}\n");
}

}  // namespace ambf::adf
