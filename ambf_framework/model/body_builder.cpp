#include "model/detail/body_builder.h"

#include <filesystem>

#include "mesh/mass_properties.h"
#include "mesh/primitives.h"
#include "model/detail/plausible.h"
#include "model/detail/view_builder.h"

namespace ambf::model {
namespace {

mesh::Axis axis_of(scene::Axis axis) {
  switch (axis) {
    case scene::Axis::x: return mesh::Axis::x;
    case scene::Axis::y: return mesh::Axis::y;
    default: return mesh::Axis::z;
  }
}

mesh::Mesh make_mesh(const scene::Geometry& g) {
  switch (g.shape) {
    case scene::Shape::box: return mesh::make_box(g.size.x, g.size.y, g.size.z);
    case scene::Shape::sphere: return mesh::make_sphere(g.radius);
    case scene::Shape::cylinder: return mesh::make_cylinder(g.radius, g.height, axis_of(g.axis));
    case scene::Shape::cone: return mesh::make_cone(g.radius, g.height, axis_of(g.axis));
    case scene::Shape::capsule: return mesh::make_capsule(g.radius, g.height, axis_of(g.axis));
    default: return mesh::make_plane(g.normal, g.offset);
  }
}

void set_color(float (&to)[3], const scene::Color& from) {
  to[0] = static_cast<float>(from.r);
  to[1] = static_cast<float>(from.g);
  to[2] = static_cast<float>(from.b);
}

mesh::SurfaceMaterial surface_of(const scene::Material& material) {
  mesh::SurfaceMaterial surface;
  set_color(surface.ambient, material.ambient);
  set_color(surface.diffuse, material.diffuse);
  set_color(surface.specular, material.specular);
  set_color(surface.emission, material.emission);
  surface.alpha = static_cast<float>(material.alpha);
  surface.shininess = static_cast<float>(material.shininess);
  surface.metallic = static_cast<float>(material.metallic);
  return surface;
}

std::optional<mesh::SurfaceMaterial> surface_of(const std::optional<scene::Material>& material) {
  return material ? std::optional(surface_of(*material)) : std::nullopt;
}

// A single primitive without an offset of its own goes where `collision offset` says, else to the centre of mass (ADF
// body block).
std::vector<scene::PlacedGeometry> placed_shapes(const scene::Body& body) {
  std::vector<scene::PlacedGeometry> shapes = body.collision.shapes;
  if (shapes.size() != 1 || !body.collision.meshes.empty()) return shapes;
  if (body.collision.offset) {
    shapes.front().offset = *body.collision.offset;
  } else if (shapes.front().offset == math::Pose{} && body.inertial_offset) {
    shapes.front().offset = *body.inertial_offset;
  }
  return shapes;
}

// Of a description's visual or collision.
template <class Part>
bool uses_mesh_file(const Part& part) {
  return part.shapes.empty() && part.meshes.empty();
}

}  // namespace

void BodyBuilder::prefetch(const std::vector<scene::Body>& bodies) {
  std::vector<std::string> files;
  for (const scene::Body& body : bodies) {
    const bool drawn = uses_mesh_file(body.visual), collides = uses_mesh_file(body.collision);
    if (drawn && !body.visual.mesh_file.empty()) files.push_back(body.visual.mesh_file);
    if (collides && !body.collision.mesh_file.empty()) files.push_back(body.collision.mesh_file);
    for (const auto* meshes : {&body.visual.meshes, &body.collision.meshes})
      for (const scene::PlacedMesh& mesh : *meshes) files.push_back(mesh.file);
  }
  std::erase_if(files, [](const std::string& file) {
    std::error_code ignored;
    return !std::filesystem::is_regular_file(file, ignored);
  });
  // What is decoded now stays in the cache until trim().
  if (!files.empty()) meshes_.load_many(files);
}

std::shared_ptr<const mesh::Mesh> BodyBuilder::load(const std::string& file, const std::vector<std::string>& candidates,
                                                    const scene::Identity& body, const char* key, Findings& findings) {
  if (file.empty()) return nullptr;
  std::string chosen = file;
  for (const std::string& candidate : candidates) {
    std::error_code ignored;
    if (std::filesystem::exists(chosen, ignored)) break;
    if (std::filesystem::exists(candidate, ignored)) chosen = candidate;
  }
  mesh::CachedMesh cached = meshes_.load(chosen);
  for (const base::Diagnostic& found : cached.diagnostics) {
    const std::string message = found.file + ": " + found.message;
    if (found.severity == base::Severity::error) {
      findings.error(body, key, message, "the body is there without it");
    } else if (found.severity == base::Severity::warning) {
      findings.warning(body, key, message, found.hint);
    } else {
      findings.information(body, key, message, found.hint);
    }
  }
  return cached.mesh;
}

std::shared_ptr<const physics::MeshSource> BodyBuilder::source_of(const std::shared_ptr<const mesh::Mesh>& mesh) {
  const std::shared_ptr<const mesh::CollisionMesh> welded = meshes_.collision_mesh(mesh);
  std::shared_ptr<const physics::MeshSource>& known = sources_[welded];
  if (known == nullptr) known = std::make_shared<physics::MeshSource>(welded);
  return known;
}

std::shared_ptr<const mesh::Mesh> BodyBuilder::primitive(const scene::Geometry& g) {
  const std::vector<double> key{static_cast<double>(g.shape), g.size.x,   g.size.y,   g.size.z,   g.radius, g.height,
                                static_cast<double>(g.axis),  g.normal.x, g.normal.y, g.normal.z, g.offset};
  std::weak_ptr<const mesh::Mesh>& known = primitives_[key];
  std::shared_ptr<const mesh::Mesh> mesh = known.lock();
  if (mesh == nullptr) known = mesh = std::make_shared<mesh::Mesh>(make_mesh(g));
  return mesh;
}

std::shared_ptr<const mesh::Mesh> BodyBuilder::stretched(const std::shared_ptr<const mesh::Mesh>& mesh,
                                                         const math::Vec3& factors) {
  Stretched& known = stretched_[{mesh.get(), {factors.x, factors.y, factors.z}}];
  std::shared_ptr<const mesh::Mesh> made = known.original.lock() == mesh ? known.mesh.lock() : nullptr;
  if (made == nullptr) {
    made = std::make_shared<mesh::Mesh>(mesh::stretched(*mesh, factors));
    known = {mesh, made};
  }
  return made;
}

std::vector<mesh::AppearancePart> BodyBuilder::placed_meshes(const std::vector<scene::PlacedMesh>& meshes,
                                                             double body_scale, const scene::Identity& body,
                                                             const char* key, Findings& findings) {
  std::vector<mesh::AppearancePart> parts;
  for (const scene::PlacedMesh& placed : meshes) {
    const auto mesh = load(placed.file, placed.candidates, body, key, findings);
    if (mesh == nullptr) continue;
    const math::Vec3& scale = placed.scale;
    const bool uniform = scale.x > 0.0 && scale.x == scale.y && scale.x == scale.z;
    parts.push_back({uniform ? mesh : stretched(mesh, scale), placed.offset,
                     uniform ? body_scale * scale.x : body_scale, surface_of(placed.material)});
  }
  return parts;
}

std::shared_ptr<mesh::Appearance> BodyBuilder::drawn_shapes(const std::vector<scene::PlacedGeometry>& shapes,
                                                            double scale,
                                                            const std::vector<mesh::AppearancePart>& meshes) {
  if (shapes.empty() && meshes.empty()) return nullptr;
  auto appearance = std::make_shared<mesh::Appearance>();
  for (const scene::PlacedGeometry& shape : shapes)
    appearance->parts.push_back({primitive(shape.geometry), shape.offset, scale, surface_of(shape.material)});
  appearance->parts.insert(appearance->parts.end(), meshes.begin(), meshes.end());
  return appearance;
}

BuiltBody BodyBuilder::build(const scene::Body& body, const BodySurroundings& surroundings, Findings& findings) {
  BuiltBody built;
  const scene::Visual& visual = body.visual;
  const scene::Collision& collision = body.collision;

  // What is drawn.
  auto appearance = drawn_shapes(visual.shapes, visual.scale,
                                 placed_meshes(visual.meshes, visual.scale, body.identity, "compound shape", findings));
  bool mesh_is_bad = false;  // complained of once, though it may stand for collision too
  if (uses_mesh_file(visual) && !visual.mesh_file.empty()) {
    if (const auto mesh = load(visual.mesh_file, visual.mesh_candidates, body.identity, "mesh", findings)) {
      appearance = std::make_shared<mesh::Appearance>();
      appearance->parts.push_back({mesh, {}, visual.scale});
    } else {
      mesh_is_bad = true;
    }
  }
  if (appearance != nullptr) {
    appearance->visible = visual.visible;
    appearance->shaders = visual.shaders.given() ? shader_files(visual.shaders) : surroundings.shaders;
    appearance->has_material = visual.material.has_value();
    if (visual.material) appearance->material = surface_of(*visual.material);
  }
  built.appearance = std::move(appearance);

  // What was said of a mesh when it was drawn is not said again.
  Findings said_already("");
  Findings& collision_findings =
      uses_mesh_file(visual) && collision.mesh_file == visual.mesh_file ? said_already : findings;
  // What collides, and where the centre of mass is. The shape is built around it.
  physics::BodyDefinition parameters;
  parameters.mass = body.mass;
  if (body.inertia) parameters.inertia = usable_inertia(*body.inertia, body.identity, findings);
  parameters.T_body_com = body.inertial_offset.value_or(math::Pose{});
  physics::ShapeOptions options;
  options.margin = collision.margin;
  options.scale = collision.scale;
  options.moving = body.mass > 0.0;
  if (!uses_mesh_file(collision)) {
    const std::vector<scene::PlacedGeometry> shapes = placed_shapes(body);
    options.T_body_com = parameters.T_body_com;
    const auto meshes =
        placed_meshes(collision.meshes, collision.scale, body.identity, "compound collision shape", findings);
    std::vector<physics::SharedShape> hulls;
    for (const mesh::AppearancePart& part : meshes) {
      physics::ShapeOptions of_part = options;
      of_part.scale = part.scale;
      hulls.push_back(source_of(part.mesh)->shape(scene::CollisionMeshType::convex_hull, part.T_body_part, of_part));
    }
    parameters.shape = physics::make_shape(shapes, options, hulls);
    built.collision_appearance = drawn_shapes(shapes, collision.scale, meshes);
  } else if (const auto mesh = mesh_is_bad && collision.mesh_file == visual.mesh_file
                                   ? nullptr
                                   : load(collision.mesh_file, collision.mesh_candidates, body.identity,
                                          "collision mesh", collision_findings)) {
    const math::Pose T_body_mesh = collision.offset.value_or(math::Pose{});
    // Absent: the mean of the mesh's vertices, and the shape is shifted with it (the original left the shape behind).
    if (!body.inertial_offset)
      parameters.T_body_com.position = T_body_mesh * (mesh::corner_mean(*mesh) * collision.scale);
    options.T_body_com = parameters.T_body_com;
    if (usable_cloud(meshes_.collision_mesh(mesh)->vertices.size(), body, findings)) {
      parameters.shape = source_of(mesh)->shape(collision.mesh_type, T_body_mesh, options);
      auto drawn = std::make_shared<mesh::Appearance>();
      drawn->parts.push_back({mesh, T_body_mesh, collision.scale});
      built.collision_appearance = std::move(drawn);
    }
  }
  if (parameters.shape != nullptr &&
      !usable_size(*parameters.shape, body, uses_mesh_file(collision) ? "collision mesh" : "collision shape",
                   findings)) {
    parameters.shape = nullptr;
    built.collision_appearance = nullptr;
  }
  parameters.T_world_body = surroundings.T_world_model * body.T_world_body;
  parameters.surface = body.surface;
  parameters.gravity = body.gravity ? body.gravity : surroundings.gravity;
  parameters.collision_groups = collision.groups;
  parameters.no_collision_set = surroundings.no_collision_set;

  auto physics_body = std::make_unique<physics::Body>(parameters);
  CartesianController controller(body.linear, body.angular, *physics_body, surroundings.step_s);
  if (controller.limited())
    findings.warning(body.identity, "controller",
                     "gains cannot be stable in steps of " + std::to_string(surroundings.step_s) +
                         " s for this mass and inertia; they are cut to D h <= m / 2 and P h^2 <= m / 4",
                     "lower P and D, or raise mass and inertia");
  built.live = std::make_unique<LiveBody>(std::move(physics_body), controller);
  return built;
}

void BodyBuilder::trim() {
  std::erase_if(sources_, [](const auto& known) { return !known.second->in_use(); });  // they hold meshes
  meshes_.trim();
  std::erase_if(stretched_, [](const auto& known) { return known.second.mesh.expired(); });
  std::erase_if(primitives_, [](const auto& known) { return known.second.expired(); });
}

}  // namespace ambf::model
