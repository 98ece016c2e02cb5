// The shader sources. Private to render/.
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "state/view.h"

namespace ambf::render {

inline constexpr int kMaxLights = 8;

// How the edges of shadows are softened: texture reads a fragment. `contact` widens the edge with the distance to
// what throws it.
enum class ShadowFilter { none, hard, soft4, soft16, contact };

struct LightVariant {
  state::LightType kind = state::LightType::spot;
  ShadowFilter filter = ShadowFilter::none;
  int shadow_views = 0;                                   // 0, 1, or 6 (a point light that is inside the scene)
  bool focused = false;                                   // a spot light weaker off its axis
  bool attenuated = false;                                // weaker with the distance
  auto operator<=>(const LightVariant&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs here
};

// What is compiled in, since where the processor draws, what is not needed would be computed all the same.
struct MeshVariant {
  std::vector<LightVariant> lights;  // 1 .. kMaxLights
  bool textured = false;
  bool cut_out = false;  // the texture's alpha is a mask
  bool normal_mapped = false;
  bool metallic = false;
  bool sky = false;                                      // mirrors the skybox
  bool fades = false;                                    // reaches where things fade into the background
  bool peeled = false;                                   // draws what lies behind a first layer (peeling.h)
  auto operator<=>(const MeshVariant&) const = default;  // NOLINT(modernize-use-nullptr)
};

std::string mesh_vertex_shader(const MeshVariant& variant);
std::string mesh_fragment_shader(const MeshVariant& variant);
std::string shadow_vertex_shader();
std::string shadow_fragment_shader();
std::string background_vertex_shader();
std::string background_fragment_shader(bool sky);  // the skybox, else the calm gradient
std::string screen_vertex_shader();                // one triangle over the whole picture
std::string occlusion_fragment_shader();           // how much of the surroundings each point sees, from depths
std::string occlusion_blur_fragment_shader();
std::string layer_fragment_shader();  // a picture as it is

}  // namespace ambf::render
