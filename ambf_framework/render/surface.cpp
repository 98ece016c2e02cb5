#include "render/surface.h"

#include <algorithm>
#include <cmath>

namespace ambf::render {

namespace {

LinearColor linear(float r, float g, float b) {
  return {linear_from_srgb(r), linear_from_srgb(g), linear_from_srgb(b)};
}

// Files give anything from 0 to 1 here without thinking of surrounding light: it only dims the shaded side by up to a half.
float ambient_share(float r, float g, float b) { return 0.5F + 0.5F * std::clamp(std::max({r, g, b}), 0.0F, 1.0F); }

// A specular colour of 1 is a polished plastic, not a mirror: 8 % at normal incidence.
constexpr float kReflectance = 0.08F;

LinearColor reflectance(float r, float g, float b) {
  return {kReflectance * std::clamp(r, 0.0F, 1.0F), kReflectance * std::clamp(g, 0.0F, 1.0F),
          kReflectance * std::clamp(b, 0.0F, 1.0F)};
}

}  // namespace

float linear_from_srgb(float value) {
  const float v = std::clamp(value, 0.0F, 1.0F);
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

Surface surface_of(const mesh::Material* own, const mesh::SurfaceMaterial* given) {
  const mesh::Material material = own != nullptr ? *own : mesh::Material{};
  Surface surface;
  surface.texture_file = material.texture_file;
  surface.normal_map_file = material.normal_map_file;
  if (given != nullptr) {
    surface.diffuse = linear(given->diffuse[0], given->diffuse[1], given->diffuse[2]);
    surface.specular = reflectance(given->specular[0], given->specular[1], given->specular[2]);
    surface.emission = linear(given->emission[0], given->emission[1], given->emission[2]);
    surface.ambient = ambient_share(given->ambient[0], given->ambient[1], given->ambient[2]);
    surface.alpha = given->alpha;
    surface.shininess = given->shininess;
  } else {
    surface.diffuse = linear(material.diffuse.r, material.diffuse.g, material.diffuse.b);
    surface.specular = reflectance(material.specular.r, material.specular.g, material.specular.b);
    surface.emission = linear(material.emission.r, material.emission.g, material.emission.b);
    surface.ambient = ambient_share(material.ambient.r, material.ambient.g, material.ambient.b);
    surface.alpha = material.diffuse.a;
    surface.shininess = material.shininess;
  }
  surface.alpha = std::clamp(surface.alpha, 0.0F, 1.0F);
  surface.shininess = std::clamp(surface.shininess, 2.0F, 256.0F);
  return surface;
}

}  // namespace ambf::render
