#include <algorithm>
#include <cmath>
#include <optional>

#include "file_names.h"
#include "scene_converter.h"

namespace ambf::file_reader {

namespace {

using mesh::Color;
using mesh::Material;

// Colours of physically based materials are linear; ours are as files of the other formats give them (sRGB).
float srgb_from_linear(float v) {
  v = std::clamp(v, 0.0F, 1.0F);
  return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1.0F / 2.4F) - 0.055F;
}

std::optional<aiColor4D> color_of(const aiMaterial& from, const char* key, unsigned type, unsigned index) {
  aiColor4D color(0, 0, 0, 1);
  if (from.Get(key, type, index, color) != AI_SUCCESS) return std::nullopt;
  return color;
}

std::optional<float> number_of(const aiMaterial& from, const char* key, unsigned type, unsigned index) {
  ai_real value = 0;
  if (from.Get(key, type, index, value) != AI_SUCCESS || !std::isfinite(value)) return std::nullopt;
  return value;
}

void set(Color& to, const aiColor4D& from, bool linear) {
  const auto part = [linear](float v) { return linear ? srgb_from_linear(v) : std::clamp(v, 0.0F, 1.0F); };
  to = {part(from.r), part(from.g), part(from.b), to.a};
}

// The lobes of Beckmann and Blinn-Phong agree for exponent = 2 / alpha^2 - 2, alpha = roughness^2 (Walter et al. 2007).
float shininess_of(float roughness) {
  const float alpha = std::max(roughness * roughness, 0.04F);
  return std::clamp(2.0F / (alpha * alpha) - 2.0F, 1.0F, 1000.0F);
}

class Converter {
 public:
  Converter(const aiScene& scene, bool names_are_uris, mesh::ReaderAnswer& answer)
      : scene_(scene), names_are_uris_(names_are_uris), answer_(answer) {}

  Material convert(const aiMaterial& from) {
    Material m;
    aiString name;
    if (from.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) m.name = name.C_Str();
    const auto metallic = number_of(from, AI_MATKEY_METALLIC_FACTOR);
    const auto roughness = number_of(from, AI_MATKEY_ROUGHNESS_FACTOR);
    const auto base = color_of(from, AI_MATKEY_BASE_COLOR);
    const bool physical = base.has_value();
    if (const auto color = physical ? base : color_of(from, AI_MATKEY_COLOR_DIFFUSE)) {
      set(m.diffuse, *color, physical);
      m.diffuse.a = std::clamp(color->a, 0.0F, 1.0F);
    }
    if (physical) {
      m.metallic = std::clamp(metallic.value_or(0.0F), 0.0F, 1.0F);
      m.specular = {0.5F, 0.5F, 0.5F, 1.0F};  // 4 % at normal incidence, as such materials reflect
    } else if (const auto color = color_of(from, AI_MATKEY_COLOR_SPECULAR)) {
      set(m.specular, *color, false);
    }
    if (const auto color = color_of(from, AI_MATKEY_COLOR_EMISSIVE)) set(m.emission, *color, physical);
    const auto shininess = number_of(from, AI_MATKEY_SHININESS);
    if (roughness) m.shininess = shininess_of(*roughness);
    if (!roughness && shininess && *shininess > 0.0F) m.shininess = std::clamp(*shininess, 1.0F, 1000.0F);
    read_opacity(from, m);
    m.texture_file = texture(from, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    if (!m.texture_file.empty() && !physical) m.diffuse = {1.0F, 1.0F, 1.0F, m.diffuse.a};
    m.normal_map_file = texture(from, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT});
    for (const aiTextureType type : {aiTextureType_METALNESS, aiTextureType_DIFFUSE_ROUGHNESS, aiTextureType_UNKNOWN,
                                     aiTextureType_EMISSIVE, aiTextureType_OPACITY, aiTextureType_LIGHTMAP}) {
      if (from.GetTextureCount(type) > 0) further_maps_ = true;
    }
    return m;
  }

  void finish() {
    if (further_maps_) {
      answer_.information.push_back(
          "maps of roughness, metal, glow, opacity and ambient light are not drawn; colour and normal maps are");
    }
  }

 private:
  void read_opacity(const aiMaterial& from, Material& m) const {
    aiString mode;
    if (from.Get("$mat.gltf.alphaMode", 0, 0, mode) == AI_SUCCESS) {
      if (std::string(mode.C_Str()) == "OPAQUE") m.diffuse.a = 1.0F;
      return;
    }
    const auto opacity = number_of(from, AI_MATKEY_OPACITY);
    // Exporters disagree so often on what 0 means that an invisible surface counts as opaque.
    if (opacity && *opacity > 0.0F && *opacity <= 1.0F) m.diffuse.a = *opacity;
    if (m.diffuse.a <= 0.0F) m.diffuse.a = 1.0F;
  }

  // The first texture of the first type that has one: a name, or "*N" for a picture within the file.
  std::string texture(const aiMaterial& from, std::initializer_list<aiTextureType> types) {
    for (const aiTextureType type : types) {
      aiString path;
      if (from.GetTextureCount(type) == 0 || from.GetTexture(type, 0, &path) != AI_SUCCESS) continue;
      const aiTexture* within = scene_.GetEmbeddedTexture(path.C_Str());
      if (within != nullptr) return place_of(*within);
      return names_are_uris_ ? decoded_uri(path.C_Str()) : std::string(path.C_Str());
    }
    return {};
  }

  std::string place_of(const aiTexture& texture) {
    if (texture.mHeight != 0 || texture.mWidth == 0) {  // texels instead of an image file
      answer_.warnings.push_back("a texture within the file is neither PNG nor JPEG; the surface is drawn without it");
      return {};
    }
    const auto known = places_.find(&texture);
    if (known != places_.end()) return known->second;
    const std::string place = "*" + std::to_string(answer_.pictures.size());
    answer_.pictures.emplace_back(reinterpret_cast<const char*>(texture.pcData), texture.mWidth);
    places_.emplace(&texture, place);
    return place;
  }

  const aiScene& scene_;
  const bool names_are_uris_;
  mesh::ReaderAnswer& answer_;
  std::map<const aiTexture*, std::string> places_;
  bool further_maps_ = false;
};

}  // namespace

void convert_materials(const aiScene& scene, bool names_are_uris, mesh::ReaderAnswer& answer) {
  Converter converter(scene, names_are_uris, answer);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    answer.raw.materials.push_back(converter.convert(*scene.mMaterials[i]));
  }
  converter.finish();
}

}  // namespace ambf::file_reader
