// Scalars of YAML text as values: numbers, whole numbers, booleans. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ambf::adf {

// As YAML spells numbers, .inf and .nan among them (callers check that it is finite); also hexadecimal whole numbers.
std::optional<double> to_number(std::string_view text);
// Whole number, decimal or hexadecimal; "50.0" is one too. None beyond +-2^53.
std::optional<std::int64_t> to_integer(std::string_view text);
// true/false, yes/no, on/off, y/n in YAML's capitalisations, and 0/1.
std::optional<bool> to_boolean(std::string_view text);

constexpr std::size_t kLongestShown = 60;
// Shortened to `longest` bytes, control characters and broken UTF-8 shown as '?'.
std::string printable(std::string_view text, std::size_t longest = kLongestShown);

}  // namespace ambf::adf
