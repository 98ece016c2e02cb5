#include "mesh/formats/detail/collada_materials.h"

#include <algorithm>

#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

using Node = ColladaDocument::Node;

// "file:///C:/a%20b.png" -> "/C:/a b.png": what follows is looked up as written and by its last part.
std::string path_of_uri(std::string uri) {
  for (const char* scheme : {"file://localhost", "file://"}) {
    if (starts_with_ignoring_case(uri, scheme)) {
      uri.erase(0, std::string_view(scheme).size());
      break;
    }
  }
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    path += escaped ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    i += escaped ? 2 : 0;
  }
  return path;
}

bool read_numbers(std::string_view text, float* out, int count) {
  WordScanner words(text);
  for (int i = 0; i < count; ++i) {
    if (!parse_float(words.next(), out[i])) return false;
  }
  return true;
}

}  // namespace

std::int32_t ColladaMaterials::index_of(const std::string& reference) {
  constexpr std::size_t kMaxMaterials = 10000;
  const auto known = known_.find(reference);
  if (known != known_.end()) return known->second;
  if (known_.size() >= kMaxMaterials) return -1;
  const Node node = xml_.find(reference, "material");
  if (!node) {
    if (known_.size() < 8) {
      context_.warn("material " + in_quotes(reference) + " is not defined; the default colour is used",
                    "check the library_materials of the file");
    }
    known_.emplace(reference, -1);
    return -1;
  }
  Material material;
  material.name = xml_.attribute(node, "name");
  if (material.name.empty()) material.name = xml_.attribute(node, "id");
  const Node instance = xml_.child(node, "instance_effect");
  read_effect(xml_.find(xml_.attribute(instance, "url"), "effect"), material);
  const auto index = static_cast<std::int32_t>(out_.materials.size());
  out_.materials.push_back(std::move(material));
  known_.emplace(reference, index);
  return index;
}

void ColladaMaterials::read_effect(Node effect, Material& material) {
  const Node profile = xml_.child(effect, "profile_COMMON");
  const Node technique = xml_.child(profile, "technique");
  Node shader;
  for (const char* model : {"phong", "blinn", "lambert", "constant"}) {
    if (!shader) shader = xml_.child(technique, model);
  }
  read_color(shader, "ambient", material.ambient, nullptr, profile);
  read_color(shader, "diffuse", material.diffuse, &material.texture_file, profile);
  read_color(shader, "specular", material.specular, nullptr, profile);
  read_color(shader, "emission", material.emission, nullptr, profile);
  const Node shininess = xml_.child(xml_.child(shader, "shininess"), "float");
  float value = 0.0F;
  if (shininess && read_numbers(xml_.text(shininess), &value, 1)) {
    // Some exporters write a share of 1 instead of an exponent.
    material.shininess = std::clamp(value <= 1.0F ? 128.0F * value : value, 1.0F, 1000.0F);
  }
  read_opacity(shader, material);
  // Normal maps are an extension that several exporters agree on.
  for (const Node& owner : {technique, effect}) {
    const Node extra = xml_.child(xml_.child(owner, "extra"), "technique");
    for (const char* name : {"bump", "normal", "normalmap"}) {
      const Node texture = xml_.child(xml_.child(extra, name), "texture");
      if (texture && material.normal_map_file.empty()) {
        material.normal_map_file = texture_of(profile, xml_.attribute(texture, "texture"));
      }
    }
  }
}

void ColladaMaterials::read_color(Node technique, const char* name, Color& color, std::string* texture, Node profile) {
  const Node node = xml_.child(technique, name);
  const Node plain = xml_.child(node, "color");
  float rgb[3] = {};
  if (plain && read_numbers(xml_.text(plain), rgb, 3)) {
    color.r = std::clamp(rgb[0], 0.0F, 1.0F);
    color.g = std::clamp(rgb[1], 0.0F, 1.0F);
    color.b = std::clamp(rgb[2], 0.0F, 1.0F);
  }
  const Node image = xml_.child(node, "texture");
  if (texture != nullptr && image) {
    *texture = texture_of(profile, xml_.attribute(image, "texture"));
    color = Color{1.0F, 1.0F, 1.0F, color.a};  // the texture alone gives the colour
  }
}

// A_ONE: opacity = alpha * transparency. RGB_ZERO: opacity = 1 - luminance * transparency. Exporters disagree so often
// that an invisible result counts as opaque.
void ColladaMaterials::read_opacity(Node technique, Material& material) const {
  const Node transparent = xml_.child(technique, "transparent");
  const Node factor = xml_.child(xml_.child(technique, "transparency"), "float");
  float rgba[4] = {1.0F, 1.0F, 1.0F, 1.0F}, transparency = 1.0F;
  const Node color = xml_.child(transparent, "color");
  const bool has_color = color && read_numbers(xml_.text(color), rgba, 4);
  const bool has_factor = factor && read_numbers(xml_.text(factor), &transparency, 1);
  if (!has_color && !has_factor) return;
  float opacity = rgba[3] * transparency;
  if (xml_.attribute(transparent, "opaque") == "RGB_ZERO") {
    opacity = 1.0F - transparency * (0.212671F * rgba[0] + 0.715160F * rgba[1] + 0.072169F * rgba[2]);
  }
  material.diffuse.a = opacity > 0.0F && opacity <= 1.0F ? opacity : 1.0F;
}

// texture="sampler sid" -> sampler2D -> surface -> image -> file; or the image directly, as older exporters write.
std::string ColladaMaterials::texture_of(Node profile, const std::string& name) {
  const auto parameter = [this, profile](const std::string& sid) {
    Node p = xml_.child(profile, "newparam");
    for (int i = 0; i < 1000 && p && xml_.attribute(p, "sid") != sid; ++i) p = xml_.next_same(p);
    return p;
  };
  std::string image = name;
  const Node sampler = xml_.child(parameter(name), "sampler2D");
  if (sampler) {
    image = xml_.attribute(xml_.child(sampler, "instance_image"), "url");
    const Node source = xml_.child(sampler, "source");
    if (source) {
      image = xml_.text(xml_.child(xml_.child(parameter(xml_.text(source)), "surface"), "init_from"));
    }
  }
  const Node init = xml_.child(xml_.find(image, "image"), "init_from");
  std::string uri = xml_.text(init);
  if (uri.empty()) uri = xml_.text(xml_.child(init, "ref"));
  if (uri.empty()) {
    context_.warn("image " + in_quotes(image) + " of a texture is not defined; the surface is drawn without it",
                  "check the library_images of the file");
    return {};
  }
  return context_.find_texture(path_of_uri(uri), context_.path(), xml_.line(init));
}

}  // namespace ambf::mesh
