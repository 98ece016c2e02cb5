// The text of a URDF file, before its elements are read. Pure functions, any thread.
#pragma once

#include <string>
#include <string_view>

namespace ambf::adf::urdf {

// UTF-16, and Latin-1 where the XML declaration says so, as UTF-8; any other text as it is. Lines stay.
std::string as_utf8(std::string_view text);

// The line of the first element of xacro's outside of comments; 0: there is none.
int line_of_macro(std::string_view text);

}  // namespace ambf::adf::urdf
