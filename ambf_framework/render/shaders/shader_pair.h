// Files of a user's shaders, as a scene names them. Plain data.
#pragma once

#include <compare>
#include <string>

#include "state/view.h"

namespace ambf::render {

// None: our own shading.
struct ShaderPair {
  std::string vertex, fragment;
  bool empty() const { return vertex.empty() || fragment.empty(); }
  auto operator<=>(const ShaderPair&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs here
};

inline ShaderPair shader_pair(const state::ShaderFiles& files) { return {files.vertex, files.fragment}; }

}  // namespace ambf::render
