// What translated shaders (shader_shim.h) are compiled with: GLSL text that declares the fixed-function state and the
// functions that GLSL 3.30 dropped, and the table of their new names. Constant data; any thread. Used by
// shader_shim.cpp alone.
#pragma once

#include <string>

namespace ambf::render {

// Declarations for both stages; they precede the file's own lines.
extern const char* const kShimDeclarations;
// The fragment stage's main(), which follows the file's own lines and calls its main under the name ambf_their_main.
extern const char* const kShimMain;
// As kShimMain, for shaders that put the result of a shadow look-up into the alpha of gl_FragColor.
extern const char* const kShimShadowMain;

// The replacement of a name that only changed its spelling or became an expression; null for all other words.
const std::string* shim_replacement(const std::string& word);
// Keywords that sources before GLSL 1.30 may use as names.
bool keyword_since_130(const std::string& word);

}  // namespace ambf::render
