// The shader sources. Private to render/.
#pragma once

#include <string>

namespace ambf::render {

inline constexpr int kMaxLights = 8;

std::string mesh_vertex_shader();
std::string mesh_fragment_shader();
std::string shadow_vertex_shader();
std::string shadow_fragment_shader();
std::string background_vertex_shader();
std::string background_fragment_shader();
std::string flat_vertex_shader();  // lines and text, in clip coordinates
std::string flat_fragment_shader();

}  // namespace ambf::render
