// The file of known arms, made part of the library by CMake.
#pragma once

namespace ambf::adf {

extern const char* const kArmsText;

}  // namespace ambf::adf
