#include "render/scene/surface.h"

#include <algorithm>
#include <cmath>

namespace ambf::render {

namespace {

LinearColor linear(const std::array<float, 3>& c) {
  return {linear_from_srgb(c[0]), linear_from_srgb(c[1]), linear_from_srgb(c[2])};
}

// Files give anything from 0 to 1 here without thinking of surrounding light: it only dims the shaded side by up to a
// half.
float ambient_share(const std::array<float, 3>& c) {
  return 0.5F + 0.5F * std::clamp(std::max({c[0], c[1], c[2]}), 0.0F, 1.0F);
}

// A specular colour of 1 is a polished plastic, not a mirror: 8 % at normal incidence.
constexpr float kReflectance = 0.08F;

LinearColor reflectance(const std::array<float, 3>& c) {
  return {kReflectance * std::clamp(c[0], 0.0F, 1.0F), kReflectance * std::clamp(c[1], 0.0F, 1.0F),
          kReflectance * std::clamp(c[2], 0.0F, 1.0F)};
}

}  // namespace

Surface surface_of(const mesh::Material* own, const mesh::SurfaceMaterial* given) {
  const mesh::Material material = own != nullptr ? *own : mesh::Material{};
  Surface surface;
  surface.texture_file = material.texture_file;
  surface.normal_map_file = material.normal_map_file;
  GivenColors& colors = surface.given;
  if (given != nullptr) {
    std::copy_n(given->ambient, 3, colors.ambient.begin());
    std::copy_n(given->diffuse, 3, colors.diffuse.begin());
    std::copy_n(given->specular, 3, colors.specular.begin());
    std::copy_n(given->emission, 3, colors.emission.begin());
    surface.alpha = given->alpha;
    surface.shininess = given->shininess;
    surface.metallic = given->metallic;
  } else {
    const auto rgb = [](const mesh::Color& c) { return std::array<float, 3>{c.r, c.g, c.b}; };
    colors = {rgb(material.ambient), rgb(material.diffuse), rgb(material.specular), rgb(material.emission)};
    surface.alpha = material.diffuse.a;
    surface.shininess = material.shininess;
    surface.metallic = material.metallic;
  }
  surface.diffuse = linear(colors.diffuse);
  surface.specular = reflectance(colors.specular);
  surface.emission = linear(colors.emission);
  surface.ambient = ambient_share(colors.ambient);
  surface.alpha = std::clamp(surface.alpha, 0.0F, 1.0F);
  surface.shininess = std::clamp(surface.shininess, 2.0F, 256.0F);
  surface.metallic = std::clamp(surface.metallic, 0.0F, 1.0F);
  return surface;
}

}  // namespace ambf::render
