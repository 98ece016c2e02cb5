// Old GLSL (1.10 to 1.50, with the fixed-function names of the compatibility profile) as GLSL 3.30 core: attribute,
// varying, texture2D, gl_Vertex, gl_ModelViewProjectionMatrix, gl_FrontMaterial, gl_LightSource[] ... become inputs
// and uniforms of ours. Line numbers stay what they are in the file, so that a compiler's words point there. Text to
// text, no OpenGL; any thread.
//
// What the sources may use is set by user_shaders.cpp: uniforms ambf_<name without gl_>.
#pragma once

#include <array>
#include <string>

namespace ambf::render {

struct ShimmedShaders {
  std::string vertex, fragment;
  // Name of the attribute at each place (gpu_store.h): the file's own (aPosition ...) where it declares one, else ours.
  std::array<std::string, 10> attributes;
  bool wants_tangents = false;
};

ShimmedShaders shim(const std::string& vertex, const std::string& fragment);

}  // namespace ambf::render
