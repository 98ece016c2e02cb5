#include "mesh/formats/detail/collada_materials.h"

#include <algorithm>

#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

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

ColladaIds::ColladaIds(const XmlTree& xml) : xml_(xml) {
  for (std::uint32_t node = 0; node < xml.size(); ++node) {
    if (xml[node].name.empty() || xml[node].content.empty()) continue;
    std::string id = xml.attribute(node, "id");
    if (!id.empty()) by_id_.emplace(std::move(id), node);
  }
}

std::uint32_t ColladaIds::find(const std::string& reference, std::string_view name) const {
  const std::string_view id =
      std::string_view(reference).substr(!reference.empty() && reference.front() == '#' ? 1 : 0);
  const auto found = by_id_.find(id);
  return found != by_id_.end() && xml_[found->second].name == name ? found->second : XmlTree::kNone;
}

std::int32_t ColladaMaterials::index_of(const std::string& reference) {
  constexpr std::size_t kMost = 10000;
  const auto known = known_.find(reference);
  if (known != known_.end()) return known->second;
  if (known_.size() >= kMost) return -1;
  const std::uint32_t node = ids_.find(reference, "material");
  if (node == XmlTree::kNone) {
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
  const std::uint32_t instance = xml_.child(node, "instance_effect");
  read_effect(ids_.find(xml_.attribute(instance, "url"), "effect"), material);
  const auto index = static_cast<std::int32_t>(out_.materials.size());
  out_.materials.push_back(std::move(material));
  known_.emplace(reference, index);
  return index;
}

void ColladaMaterials::read_effect(std::uint32_t effect, Material& material) {
  const std::uint32_t profile = xml_.child(effect, "profile_COMMON");
  const std::uint32_t technique = xml_.child(profile, "technique");
  std::uint32_t shader = XmlTree::kNone;
  for (const char* model : {"phong", "blinn", "lambert", "constant"}) {
    if (shader == XmlTree::kNone) shader = xml_.child(technique, model);
  }
  read_color(shader, "ambient", material.ambient, nullptr, profile);
  read_color(shader, "diffuse", material.diffuse, &material.texture_file, profile);
  read_color(shader, "specular", material.specular, nullptr, profile);
  read_color(shader, "emission", material.emission, nullptr, profile);
  const std::uint32_t shininess = xml_.child(xml_.child(shader, "shininess"), "float");
  float value = 0.0F;
  if (shininess != XmlTree::kNone && read_numbers(xml_.text(shininess), &value, 1)) {
    // Some exporters write a share of 1 instead of an exponent.
    material.shininess = std::clamp(value <= 1.0F ? 128.0F * value : value, 1.0F, 1000.0F);
  }
  read_opacity(shader, material);
  // Normal maps are an extension that several exporters agree on.
  for (std::uint32_t owner : {technique, effect}) {
    const std::uint32_t extra = xml_.child(xml_.child(owner, "extra"), "technique");
    for (const char* name : {"bump", "normal", "normalmap"}) {
      const std::uint32_t texture = xml_.child(xml_.child(extra, name), "texture");
      if (texture != XmlTree::kNone && material.normal_map_file.empty()) {
        material.normal_map_file = texture_of(profile, xml_.attribute(texture, "texture"));
      }
    }
  }
}

void ColladaMaterials::read_color(std::uint32_t technique, const char* name, Color& color, std::string* texture,
                                  std::uint32_t profile) {
  const std::uint32_t node = xml_.child(technique, name);
  const std::uint32_t plain = xml_.child(node, "color");
  float rgb[3] = {};
  if (plain != XmlTree::kNone && read_numbers(xml_.text(plain), rgb, 3)) {
    color.r = std::clamp(rgb[0], 0.0F, 1.0F);
    color.g = std::clamp(rgb[1], 0.0F, 1.0F);
    color.b = std::clamp(rgb[2], 0.0F, 1.0F);
  }
  const std::uint32_t image = xml_.child(node, "texture");
  if (texture != nullptr && image != XmlTree::kNone) {
    *texture = texture_of(profile, xml_.attribute(image, "texture"));
    color = Color{1.0F, 1.0F, 1.0F, color.a};  // the texture alone gives the colour
  }
}

// A_ONE: opacity = alpha * transparency. RGB_ZERO: opacity = 1 - luminance * transparency. Exporters disagree so often that
// an invisible result counts as opaque.
void ColladaMaterials::read_opacity(std::uint32_t technique, Material& material) const {
  const std::uint32_t transparent = xml_.child(technique, "transparent");
  const std::uint32_t factor = xml_.child(xml_.child(technique, "transparency"), "float");
  float rgba[4] = {1.0F, 1.0F, 1.0F, 1.0F}, transparency = 1.0F;
  const std::uint32_t color = xml_.child(transparent, "color");
  const bool has_color = color != XmlTree::kNone && read_numbers(xml_.text(color), rgba, 4);
  const bool has_factor = factor != XmlTree::kNone && read_numbers(xml_.text(factor), &transparency, 1);
  if (!has_color && !has_factor) return;
  float opacity = rgba[3] * transparency;
  if (xml_.attribute(transparent, "opaque") == "RGB_ZERO") {
    opacity = 1.0F - transparency * (0.212671F * rgba[0] + 0.715160F * rgba[1] + 0.072169F * rgba[2]);
  }
  material.diffuse.a = opacity > 0.0F && opacity <= 1.0F ? opacity : 1.0F;
}

// texture="sampler sid" -> sampler2D -> surface -> image -> file; or the image directly, as older exporters write.
std::string ColladaMaterials::texture_of(std::uint32_t profile, const std::string& name) {
  const auto parameter = [this, profile](const std::string& sid) {
    std::uint32_t p = xml_.child(profile, "newparam");
    for (int i = 0; i < 1000 && p != XmlTree::kNone && xml_.attribute(p, "sid") != sid; ++i) p = xml_.next_same(p);
    return p;
  };
  std::string image = name;
  const std::uint32_t sampler = xml_.child(parameter(name), "sampler2D");
  if (sampler != XmlTree::kNone) {
    image = xml_.attribute(xml_.child(sampler, "instance_image"), "url");
    const std::uint32_t source = xml_.child(sampler, "source");
    if (source != XmlTree::kNone) {
      image = xml_.text(xml_.child(xml_.child(parameter(xml_.text(source)), "surface"), "init_from"));
    }
  }
  const std::uint32_t init = xml_.child(ids_.find(image, "image"), "init_from");
  std::string uri = xml_.text(init);
  if (uri.empty()) uri = xml_.text(xml_.child(init, "ref"));
  if (uri.empty()) {
    context_.warn("image " + in_quotes(image) + " of a texture is not defined; the surface is drawn without it",
                  "check the library_images of the file");
    return {};
  }
  return context_.find_texture(path_of_uri(uri), context_.path(), init == XmlTree::kNone ? 0 : xml_[init].line);
}

}  // namespace ambf::mesh
