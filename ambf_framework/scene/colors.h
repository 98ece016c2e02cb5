// The colour file's table: names that a body's `color` key may use. Plain data; read by any thread.
#pragma once

#include <map>
#include <string>

namespace ambf::scene {

// 0..1 each.
struct NamedColor {
  double r = 0.0, g = 0.0, b = 0.0, a = 1.0;
};

using ColorTable = std::map<std::string, NamedColor, std::less<>>;

}  // namespace ambf::scene
