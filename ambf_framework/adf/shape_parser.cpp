// Visual and collision of a body: primitives, compounds, meshes and where mesh files are looked for (ADF 1.7, 4, 4.1).
#include <algorithm>
#include <cmath>

#include "adf/detail/bind.h"
#include "adf/detail/body_parser.h"
#include "adf/detail/files.h"
#include "math/rotation.h"

namespace ambf::adf {

std::vector<std::string> mesh_places(const Fields& block, const std::string& mesh, MeshFolder folder,
                                     const FileContext& file) {
  if (is_absolute(mesh)) return {resolve(file.folder, mesh)};
  std::string own, header = file.high_path;
  if (folder == MeshFolder::low_resolution) {
    own = block.text("low resolution path");
    if (!file.low_path.empty()) header = file.low_path;
  }
  if (own.empty()) own = block.text("high resolution path");
  const std::string header_folder = resolve(file.folder, header);
  if (own.empty()) return {resolve(header_folder, mesh)};
  std::vector<std::string> places{resolve(resolve(file.folder, own), mesh)};
  if (!is_absolute(own) && !header.empty()) places.push_back(resolve(resolve(header_folder, own), mesh));
  return places;
}

namespace {

// Flat objects are exported with an extent of 0.
constexpr double kThinnest = 1e-4;  // m

// None for a word that is no shape, which has been warned about. `key` is one of a body or of an item of a compound.
std::optional<scene::Shape> shape_in(const Fields& fields, std::string_view key) {
  const scene::Group& group = key == "shape" ? scene::group::kVisual : scene::group::kCollision;
  return read_choice<scene::Shape>(fields, group, key);
}

std::vector<std::string_view> needed_sizes(scene::Shape shape) {
  switch (shape) {
    case scene::Shape::box: return {"x", "y", "z"};
    case scene::Shape::sphere: return {"radius"};
    case scene::Shape::cylinder:
    case scene::Shape::cone:
    case scene::Shape::capsule: return {"radius", "height"};
    case scene::Shape::plane: break;
  }
  return {};
}

std::vector<std::string_view> known_sizes(scene::Shape shape) {
  std::vector<std::string_view> known = needed_sizes(shape);
  if (shape == scene::Shape::plane) known = {"normal", "offset"};
  if (known.back() == "height") known.push_back("axis");
  return known;
}

// Sizes that only other shapes have.
void tell_what_has_no_effect(const Fields& sizes, const std::vector<std::string_view>& known, const std::string& word,
                             const std::string& path, Report& report) {
  for (const char* key : {"x", "y", "z", "radius", "height", "axis", "normal", "offset", "mesh", "scale"}) {
    if (!sizes.has(key) || std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (std::string_view name : known) list += (list.empty() ? "`" : ", `") + std::string(name) + "`";
    report.warning(sizes.mark(key), path + "/" + key, "has no effect on a shape of type " + in_quotes(word),
                   "it has " + list);
  }
}

scene::Axis parse_shape_axis(const Fields& geometry, const std::string& path, Report& report) {
  const std::string word = geometry.text("axis", "z");
  if (word == "x" || word == "X") return scene::Axis::x;
  if (word == "y" || word == "Y") return scene::Axis::y;
  if (word != "z" && word != "Z") {
    report.warning(geometry.mark("axis"), path + "/axis", "expected x, y or z, found " + in_quotes(word), "z is used");
  }
  return scene::Axis::z;
}

std::string list_of(const std::vector<std::string>& places) {
  std::string text;
  for (const std::string& place : places) text += (text.empty() ? "" : ", ") + shown_path(place);
  return text;
}

// `mesh` stands at `mark`, the value of `key`; `block` may say where meshes are.
MeshPath look_for(const Fields& block, const std::string& mesh, Mark mark, const std::string& key, MeshFolder folder,
                  const FileContext& file, const std::string& consequence) {
  std::vector<std::string> places = mesh_places(block, mesh, folder, file);
  if (!file.options.look_for_files) return {places.front(), {places.begin() + 1, places.end()}};
  const std::string found = find_file(places);
  if (found.empty()) {
    const bool low = folder == MeshFolder::low_resolution;
    file.report.error(mark, key,
                      std::string(low ? "collision" : "visual") + " mesh not found; looked at: " + list_of(places),
                      consequence);
  }
  return {found, {}};
}

constexpr double kSmallestScale = 1e-12;  // its reciprocal still is a number for normals

// Of an item that is drawn.
std::optional<scene::Material> item_material(const Block& block, const Fields& item, const std::string& path,
                                             MeshFolder folder, const FileContext& file) {
  if (folder == MeshFolder::low_resolution || !block.fields.flag("use material", true)) return std::nullopt;
  return parse_material(item, block.identifier + path, path, file);
}

// An item `{shape: MESH, geometry: {mesh, scale}, offset}`; false when it is wrong.
bool parse_mesh_item(const Block& block, const Fields& item, const std::string& path, MeshFolder folder,
                     const FileContext& file, std::vector<scene::PlacedMesh>& meshes) {
  const Fields geometry = item.map("geometry");
  const std::string name = geometry.text("mesh"), full = path + "geometry";
  if (name.empty()) {
    file.report.error(geometry.mark(), full + "/mesh", "missing; a MESH needs it", "add `mesh`, the name of its file");
    return false;
  }
  tell_what_has_no_effect(geometry, {"mesh", "scale"}, item.text("shape"), full, file.report);
  const math::Vec3 scale = geometry.number_or_vector("scale", {1.0, 1.0, 1.0});
  if (std::min({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)}) < kSmallestScale) {
    file.report.error(geometry.mark("scale"), full + "/scale", "expected no 0, found one: the mesh would be flat",
                      "1 leaves an axis as it is, -1 mirrors it");
    return false;
  }
  MeshPath mesh = look_for(block.fields, name, geometry.mark("mesh"), full + "/mesh", folder, file, "it is left out");
  if (!mesh.file.empty())
    meshes.push_back({std::move(mesh.file), std::move(mesh.candidates), scale,
                      item.pose("offset").value_or(math::Pose{}), item_material(block, item, path, folder, file)});
  return true;
}

bool is_mesh(const Fields& item) {
  const std::string word = item.text("shape");
  return word == "MESH" || word == "Mesh" || word == "mesh";
}

}  // namespace

MeshPath find_mesh(const Fields& block, std::string_view key, MeshFolder folder, const FileContext& file) {
  const std::string mesh = block.text(key);
  if (mesh.empty()) return {};
  const bool low = folder == MeshFolder::low_resolution;
  return look_for(block, mesh, block.mark(key), std::string(key), folder, file,
                  low ? "the body has no collision" : "the body is not drawn");
}

std::optional<scene::Geometry> parse_geometry(const Fields& owner, std::string_view shape_key,
                                              std::string_view geometry_key, const std::string& path, Report& report) {
  scene::Geometry geometry;
  geometry.shape = shape_in(owner, shape_key).value_or(scene::Shape::box);
  const std::string full = path + std::string(geometry_key);
  if (!owner.has(geometry_key)) {
    report.error(owner.mark(shape_key), path + std::string(shape_key),
                 "expected `" + std::string(geometry_key) + "` beside it, found none", "add the sizes of the shape");
    return std::nullopt;
  }
  const Fields sizes = owner.map(geometry_key);
  for (std::string_view size : needed_sizes(geometry.shape)) {
    if (sizes.has(size)) {
      if (sizes.number(size, 0.0) >= kThinnest) continue;
      report.warning(sizes.mark(size), full + "/" + std::string(size),
                     "nearly 0; nothing can touch a shape without extent", "0.1 mm is used");
      continue;
    }
    report.error(sizes.mark(), full + "/" + std::string(size),
                 "missing; " + in_quotes(owner.text(shape_key)) + " needs it", "add `" + std::string(size) + "`");
    return std::nullopt;
  }
  tell_what_has_no_effect(sizes, known_sizes(geometry.shape), owner.text(shape_key), full, report);
  const auto extent = [&sizes](const char* key) { return std::max(sizes.number(key, 0.0), kThinnest); };
  geometry.size = {extent("x"), extent("y"), extent("z")};
  geometry.radius = extent("radius");
  geometry.height = extent("height");
  if (geometry.shape == scene::Shape::capsule && geometry.height < 2.0 * geometry.radius) {
    report.warning(sizes.mark("height"), full + "/height", "a capsule is at least as high as it is thick",
                   "it becomes a sphere");
    geometry.height = 2.0 * geometry.radius;
  }
  const bool has_axis = geometry.shape == scene::Shape::cylinder || geometry.shape == scene::Shape::cone ||
                        geometry.shape == scene::Shape::capsule;
  if (has_axis) geometry.axis = parse_shape_axis(sizes, full, report);
  if (geometry.shape == scene::Shape::plane) {
    const auto normal = parse_axis(sizes, "normal", {0.0, 0.0, 1.0}, report);
    if (!normal) return std::nullopt;
    geometry.normal = *normal;
    geometry.offset = sizes.number("offset", 0.0);
  }
  return geometry;
}

std::optional<Compound> parse_compound(const Block& block, std::string_view key, MeshFolder folder,
                                       const FileContext& file) {
  Compound compound;
  std::size_t index = 0;
  for (const Fields& item : block.fields.maps(key)) {
    const std::string path = std::string(key) + "[" + std::to_string(index++) + "]/";
    if (is_mesh(item)) {
      if (!parse_mesh_item(block, item, path, folder, file, compound.meshes)) return std::nullopt;
      continue;
    }
    if (!shape_in(item, "shape")) continue;
    const auto geometry = parse_geometry(item, "shape", "geometry", path, file.report);
    if (!geometry) return std::nullopt;
    compound.shapes.push_back(
        {*geometry, item.pose("offset").value_or(math::Pose{}), item_material(block, item, path, folder, file)});
  }
  return compound;
}

std::optional<scene::Visual> parse_visual(const Block& block, const FileContext& file) {
  const Fields& fields = block.fields;
  auto visual = read<scene::Visual>(fields.value(), scene::group::kVisual, file.options.defaults);
  if (shape_in(fields, "shape")) {
    const auto geometry = parse_geometry(fields, "shape", "geometry", {}, file.report);
    if (!geometry) return std::nullopt;
    visual.shapes.push_back({*geometry, {}});
  } else if (fields.has("compound shape")) {
    auto compound = parse_compound(block, "compound shape", MeshFolder::high_resolution, file);
    if (!compound) return std::nullopt;
    visual.shapes = std::move(compound->shapes);
    visual.meshes = std::move(compound->meshes);
  }
  if (visual.shapes.empty() && visual.meshes.empty()) {
    MeshPath mesh = find_mesh(fields, "mesh", MeshFolder::high_resolution, file);
    visual.mesh_file = std::move(mesh.file);
    visual.mesh_candidates = std::move(mesh.candidates);
  }
  visual.material = parse_material(fields, block.identifier, {}, file);
  visual.shaders = parse_shaders(fields, "shaders", file);
  return visual;
}

namespace {

// Of several ways to say what is drawn or collides, one counts (ADF 4: shape, compound shape, mesh); a warning
// names the others.
void report_unused(const Fields& fields, Report& report) {
  const auto counts = [&fields](std::string_view key) {
    const bool is_shape = key == "shape" || key == "collision shape";
    return is_shape ? shape_in(fields, key).has_value() : fields.has(key);
  };
  const auto first_of = [&counts](std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (counts(key)) return key;
    return "";
  };
  const char* const drawn = first_of({"shape", "compound shape", "mesh"});
  const char* const collides = first_of({"collision shape", "compound collision shape", "collision mesh", "mesh"});
  for (const char* key :
       {"shape", "compound shape", "mesh", "collision shape", "compound collision shape", "collision mesh"}) {
    const std::string_view name = key;
    const bool of_collision = name.find("collision") != std::string_view::npos;
    if (first_of({key}) != name || name == drawn || name == collides) continue;
    report.information(fields.mark(key), key,
                       "not used: `" + std::string(of_collision ? collides : drawn) + "` counts");
  }
}

}  // namespace

std::optional<scene::Collision> parse_collision(const Block& block, const FileContext& file) {
  const Fields& fields = block.fields;
  report_unused(fields, file.report);
  auto collision = read<scene::Collision>(fields.value(), scene::group::kCollision, file.options.defaults);
  if (shape_in(fields, "collision shape")) {
    const auto geometry = parse_geometry(fields, "collision shape", "collision geometry", {}, file.report);
    if (!geometry) return std::nullopt;
    collision.shapes.push_back({*geometry, {}});
  } else if (fields.has("compound collision shape")) {
    auto compound = parse_compound(block, "compound collision shape", MeshFolder::low_resolution, file);
    if (!compound) return std::nullopt;
    collision.shapes = std::move(compound->shapes);
    collision.meshes = std::move(compound->meshes);
  }
  if (collision.shapes.empty() && collision.meshes.empty()) {
    const std::string_view key = fields.has("collision mesh") ? "collision mesh" : "mesh";
    MeshPath mesh = find_mesh(fields, key, MeshFolder::low_resolution, file);
    collision.mesh_file = std::move(mesh.file);
    collision.mesh_candidates = std::move(mesh.candidates);
    const bool drawn = fields.has("shape") || fields.has("compound shape");
    if (drawn && !fields.has(key)) {
      file.report.information(block.where, "collision shape", "missing: the body is drawn, but collides with nothing",
                              "give `collision shape` and `collision geometry` too");
    }
  }
  for (int group : fields.integers("collision groups")) {
    constexpr int kLastGroup = 999;
    if (group < 0 || group > kLastGroup) {
      file.report.warning(fields.mark("collision groups"), "collision groups",
                          "expected 0 to 999, found " + std::to_string(group), "it is left out");
      continue;
    }
    if (std::find(collision.groups.begin(), collision.groups.end(), group) == collision.groups.end())
      collision.groups.push_back(group);
  }
  return collision;
}

}  // namespace ambf::adf
