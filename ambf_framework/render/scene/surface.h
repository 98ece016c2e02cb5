// What a surface looks like to the shader, mixed from the ADF's colour components and the mesh's own material. Pure
// functions, any thread.
#pragma once

#include <array>
#include <string>

#include "mesh/appearance.h"
#include "mesh/mesh.h"
#include "render/images/srgb.h"

namespace ambf::render {

// A material's colours as its file gives them, for users' shaders.
struct GivenColors {
  std::array<float, 3> ambient{}, diffuse{}, specular{}, emission{};
  bool operator==(const GivenColors&) const = default;
};

struct Surface {
  LinearColor diffuse{}, specular{}, emission{};
  float ambient = 1.0F;  // share of the surrounding light
  float alpha = 1.0F;
  float shininess = 64.0F;   // Blinn-Phong exponent
  float metallic = 0.0F;     // 0..1: mirrors in its diffuse colour instead of scattering
  std::string texture_file;  // multiplies diffuse; or empty
  std::string normal_map_file;
  GivenColors given;

  bool operator==(const Surface&) const = default;
  bool transparent() const { return alpha < 0.999F; }
};

// `own` is the mesh's material, `given` the ADF's, which wins but for the texture; either may be null.
Surface surface_of(const mesh::Material* own, const mesh::SurfaceMaterial* given);

}  // namespace ambf::render
