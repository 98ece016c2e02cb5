// Scalars of YAML text as values: numbers, whole numbers, booleans. Pure functions, any thread.
#pragma once

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

// Shortened to 60 characters, control characters and broken bytes shown as '?'.
std::string printable(std::string_view text);

}  // namespace ambf::adf
