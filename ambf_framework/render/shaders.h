// The shader sources. Private to render/.
#pragma once

#include <string>
#include <tuple>

namespace ambf::render {

inline constexpr int kMaxLights = 8;

// What is compiled in, since where the processor draws, what is not needed would be computed all the same.
struct MeshVariant {
  int lights = 1;       // 1 .. kMaxLights
  int shadow_taps = 0;  // 0 (no shadows), 1 or 4; each is four texels, blended
  bool textured = false;
  bool operator<(const MeshVariant& o) const {
    return std::tie(lights, shadow_taps, textured) < std::tie(o.lights, o.shadow_taps, o.textured);
  }
};

std::string mesh_vertex_shader(const MeshVariant& variant);
std::string mesh_fragment_shader(const MeshVariant& variant);
std::string shadow_vertex_shader();
std::string shadow_fragment_shader();
std::string background_vertex_shader();
std::string background_fragment_shader();
std::string flat_vertex_shader();  // lines and text, in clip coordinates
std::string flat_fragment_shader();

}  // namespace ambf::render
