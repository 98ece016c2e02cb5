#include "adf/detail/write_looks.h"

#include <algorithm>

#include "adf/detail/text_edit.h"

namespace ambf::adf {

namespace {

using scene::Key;

// A key by its place in the table: names repeat.
bool is(const Key& key, const scene::Group& group, std::string_view name) {
  return &key == scene::find_key(group, name);
}

std::string flow_color(const scene::Color& c, const std::string& more = {}) {
  return "{r: " + flow(c.r) + ", g: " + flow(c.g) + ", b: " + flow(c.b) + more + "}";
}

std::string shape_word(const scene::Geometry& geometry) {
  return first_word(*scene::find_key(scene::group::kVisual, "shape"), static_cast<int>(geometry.shape));
}

std::string sizes_of(const scene::Geometry& g) {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  using scene::Shape;
  switch (g.shape) {
    case Shape::box: return flow(g.size);
    case Shape::sphere: return flow(WrittenKeys{{"radius", flow(g.radius)}});
    case Shape::plane: return flow(WrittenKeys{{"normal", flow(g.normal)}, {"offset", flow(g.offset)}});
    case Shape::cylinder:
    case Shape::cone:
    case Shape::capsule: break;
  }
  return flow(
      WrittenKeys{{"radius", flow(g.radius)}, {"height", flow(g.height)}, {"axis", kAxes[static_cast<int>(g.axis)]}});
}

// What shapes and meshes have in common. Without `lost`: what collides, which has no colours.
template <class Placed>
std::string item(WrittenKeys keys, const Placed& placed, const Lost& lost) {
  if (!(placed.offset == math::Pose{})) keys.emplace_back("offset", flow(placed.offset));
  if (placed.material && lost != nullptr)
    for (auto& key : material_keys(*placed.material, lost)) keys.push_back(std::move(key));
  return flow(keys);
}

std::string compound(const std::vector<scene::PlacedGeometry>& shapes, const std::vector<scene::PlacedMesh>& meshes,
                     const Lost& lost) {
  std::vector<std::string> items;
  for (const auto& shape : shapes)
    items.push_back(item({{"shape", shape_word(shape.geometry)}, {"geometry", sizes_of(shape.geometry)}}, shape, lost));
  for (const auto& mesh : meshes) {
    WrittenKeys geometry{{"mesh", as_scalar(mesh.file)}};
    if (!(mesh.scale == math::Vec3{1.0, 1.0, 1.0})) geometry.emplace_back("scale", flow(mesh.scale));
    items.push_back(item({{"shape", "MESH"}, {"geometry", flow(geometry)}}, mesh, lost));
  }
  return flow_list(items);
}

bool is_single(const std::vector<scene::PlacedGeometry>& shapes, const std::vector<scene::PlacedMesh>& meshes) {
  return shapes.size() == 1 && meshes.empty() && shapes.front().offset == math::Pose{} && !shapes.front().material;
}

bool same(const scene::Color& a, const scene::Color& b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

}  // namespace

std::string flow(const scene::Shaders& shaders) {
  if (!shaders.given()) return {};
  return flow(WrittenKeys{{"path", as_scalar(shaders.path)},
                          {"vertex", as_scalar(shaders.vertex)},
                          {"fragment", as_scalar(shaders.fragment)}});
}

std::string flow(const std::vector<int>& numbers) {
  std::vector<std::string> texts;
  for (const int number : numbers) texts.push_back(std::to_string(number));
  return flow_list(texts);
}

std::string flow_list(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return "[" + text + "]";
}

bool collides(const scene::Collision& collision) {
  return !collision.shapes.empty() || !collision.meshes.empty() || !collision.mesh_file.empty();
}

WrittenKeys visual_keys(const scene::Visual& visual, bool collides, const Lost& lost) {
  const auto& group = scene::group::kVisual;
  const bool single = is_single(visual.shapes, visual.meshes);
  const bool several = !single && (!visual.shapes.empty() || !visual.meshes.empty());
  // A mesh that is drawn would collide, too.
  const bool only_drawn = !single && !several && !visual.mesh_file.empty() && !collides;
  return written_keys(group, &visual, nullptr, [&](const Key& key) -> std::optional<std::string> {
    if (is(key, group, "mesh"))
      return single || several || only_drawn || visual.mesh_file.empty() ? "" : as_scalar(visual.mesh_file);
    if (is(key, group, "shape")) return single ? shape_word(visual.shapes.front().geometry) : "";
    if (is(key, group, "geometry")) return single ? sizes_of(visual.shapes.front().geometry) : "";
    if (is(key, group, "compound shape")) {
      if (only_drawn) return compound({}, {{visual.mesh_file, {}, {1.0, 1.0, 1.0}, {}}}, lost);
      return several ? compound(visual.shapes, visual.meshes, lost) : "";
    }
    if (is(key, group, "shaders")) return flow(visual.shaders);
    return std::nullopt;
  });
}

WrittenKeys collision_keys(const scene::Collision& collision) {
  const auto& group = scene::group::kCollision;
  const bool single = is_single(collision.shapes, collision.meshes);
  const bool several = !single && (!collision.shapes.empty() || !collision.meshes.empty());
  return written_keys(group, &collision, nullptr, [&](const Key& key) -> std::optional<std::string> {
    if (is(key, group, "collision groups")) return collision.groups.empty() ? "" : flow(collision.groups);
    if (is(key, group, "collision shape")) return single ? shape_word(collision.shapes.front().geometry) : "";
    if (is(key, group, "collision geometry")) return single ? sizes_of(collision.shapes.front().geometry) : "";
    if (is(key, group, "compound collision shape"))
      return several ? compound(collision.shapes, collision.meshes, nullptr) : "";
    if (is(key, group, "collision mesh"))
      return single || several || collision.mesh_file.empty() ? "" : as_scalar(collision.mesh_file);
    return std::nullopt;
  });
}

WrittenKeys material_keys(const scene::Material& material, const Lost& lost) {
  const scene::Material plain;
  const auto part = [&](double factor) {
    return scene::Color{material.diffuse.r * factor, material.diffuse.g * factor, material.diffuse.b * factor};
  };
  constexpr double kAmbientOfPlain = 0.5;
  const bool usual = same(material.specular, plain.specular) && same(material.emission, plain.emission) &&
                     material.shininess == plain.shininess && material.metallic == plain.metallic;
  if (usual && same(material.ambient, part(kAmbientOfPlain)))
    return {{"color rgba", flow_color(material.diffuse, ", a: " + flow(material.alpha))}};
  WrittenKeys keys{{"diffuse", flow_color(material.diffuse)},
                   {"specular", flow_color(material.specular)},
                   {"emission", flow_color(material.emission)}};
  if (!same(material.ambient, plain.ambient)) {
    const scene::Color& d = material.diffuse;
    const double level = d.r > 0.0   ? material.ambient.r / d.r
                         : d.g > 0.0 ? material.ambient.g / d.g
                         : d.b > 0.0 ? material.ambient.b / d.b
                                     : 0.0;
    keys.emplace_back("ambient", flow(WrittenKeys{{"level", flow(level)}}));
    constexpr double kSame = 1e-12;
    const scene::Color reads = part(level);
    if (std::max({reads.r - material.ambient.r, material.ambient.r - reads.r, reads.g - material.ambient.g,
                  material.ambient.g - reads.g, reads.b - material.ambient.b, material.ambient.b - reads.b}) > kSame)
      lost("its ambient colour is no part of the diffuse one", "ADF has a level only");
  }
  keys.emplace_back("shininess", std::to_string(material.shininess));
  keys.emplace_back("transparency", flow(material.alpha));
  if (material.metallic != 0.0) keys.emplace_back("metallic", flow(material.metallic));
  return {{"color components", flow(keys)}};
}

}  // namespace ambf::adf
