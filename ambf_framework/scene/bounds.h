// The numbers that an ADF file may hold, by their unit: one table, which the parser checks and docs/limits.md shows.
// Constant data; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/keys.h"

namespace ambf::scene {

// Of every number with this unit, in either direction from zero.
struct Bound {
  std::string_view unit;  // as in Key::unit; of other numbers than those listed: ""
  std::string_view key;   // only of keys of this name; "": of all
  std::string_view what;  // in words
  double max;
  double min = 0.0;  // of a number that is not zero
};

std::span<const Bound> bounds();
const Bound& bound_of(const Key& key);

// Empty, or what is expected instead of this finite number. A key with a `max` of its own is cut there, with a warning.
std::string out_of_bounds(double number, const Key& key);

}  // namespace ambf::scene
