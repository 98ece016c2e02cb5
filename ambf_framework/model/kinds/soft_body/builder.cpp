#include "model/kinds/soft_body/detail/builder.h"

#include <algorithm>
#include <set>

#include "mesh/mesh.h"
#include "mesh/obj_points.h"
#include "mesh/weld.h"
#include "model/detail/view_builder.h"
#include "model/kinds/soft_body/detail/skin.h"
#include "physics/soft_grip.h"
#include "physics/tissue_grid.h"
#include "scene/soft_limits.h"

namespace ambf::model {
namespace {

using scene::kMaxNodesOfFarBending, scene::kMaxSoftNodes;

SoftNodes nodes_of(const mesh::Appearance& collision) {
  SoftNodes all;
  for (const mesh::AppearancePart& part : collision.parts) {
    const mesh::CollisionMesh welded = mesh::make_collision_mesh(*part.mesh);
    const auto first = static_cast<std::uint32_t>(all.at.size());
    for (const math::Vec3& vertex : welded.vertices) all.at.push_back(part.T_body_part * (vertex * part.scale));
    for (const auto& t : welded.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    for (const auto& line : welded.lines) all.lines.push_back({first + line[0], first + line[1]});
  }
  return all;
}

bool is_thread(const scene::SoftBody& soft) { return soft.is_tissue && soft.tissue.kind == scene::TissueKind::thread; }

// What builds a body reads its meshes and makes its looks.
scene::Body as_body(const scene::KindBlock& block) {
  const auto& soft = block.as<scene::SoftBody>();
  scene::Body body;
  body.identity = block.identity;
  body.visual = soft.visual;
  body.collision = soft.collision;
  body.inertial_offset = math::Pose{};
  body.mass = 0.0;
  if (is_thread(soft)) {  // only its looks are used: the thread is drawn by its own tube
    body.visual.mesh_file.clear();
    body.visual.meshes.clear();
    body.visual.shapes.resize(1);
    body.visual.shapes[0].geometry.shape = scene::Shape::sphere;
    body.visual.shapes[0].geometry.radius = soft.tissue.radius;
    if (!soft.tissue.points.empty()) body.collision = {};
  }
  return body;
}

// `surface`: the nodes of the mesh; what else there is comes after them.
std::vector<std::uint32_t> fixed_nodes(const scene::KindBlock& block, const SoftNodes& surface, const SoftNodes& nodes,
                                       Findings& findings) {
  const auto& soft = block.as<scene::SoftBody>();
  std::set<std::uint32_t> fixed;
  const NodeNumbers numbers(soft.collision, surface);
  for (const int number : soft.config.fixed_nodes) {
    const std::optional<std::uint32_t> node = numbers.find(number);
    if (node) {
      fixed.insert(*node);
    } else {
      findings.warning(block.identity, "config/fixed nodes",
                       "there is no node " + std::to_string(number) + ": the mesh has " +
                           std::to_string(numbers.count()) + " vertices, counted from 0",
                       "it is left out");
    }
  }
  if (soft.mass <= 0.0)
    for (std::uint32_t node = 0; node < nodes.at.size(); ++node) fixed.insert(node);
  return {fixed.begin(), fixed.end()};
}

void add_regions(const scene::KindBlock& block, const SoftNodes& surface, const SoftNodes& nodes,
                 physics::SoftDefinition& made, BuiltSoftBody& built, Findings& findings) {
  const auto& soft = block.as<scene::SoftBody>();
  const NodeNumbers numbers(soft.collision, surface);
  const double slack = 1e-9 * mesh::bounds_of(nodes.at).diagonal();
  for (std::size_t i = 0; i < soft.config.regions.size(); ++i) {
    const scene::TissueRegion& region = soft.config.regions[i];
    const std::string key = "config/regions[" + std::to_string(i) + "]";
    std::set<std::uint32_t> in;
    for (const int vertex : region.vertices) {
      if (const std::optional<std::uint32_t> node = numbers.find(vertex))
        in.insert(*node);
      else
        findings.warning(block.identity, key + "/vertices",
                         "there is no vertex " + std::to_string(vertex) + ": the mesh has " +
                             std::to_string(numbers.count()) + ", counted from 0",
                         "it is left out");
    }
    for (std::uint32_t node = 0; node < nodes.at.size(); ++node)
      if (is_within(region, nodes.at[node], slack)) in.insert(node);
    if (in.empty()) {
      findings.warning(block.identity, key, "there is no node in this region",
                       "its location is in the body frame; it is left out");
      continue;
    }
    if (region.fixed) made.fixed.insert(made.fixed.end(), in.begin(), in.end());
    if (region.stiffness * soft.config.kLST > std::max(1.0, soft.config.kLST))
      findings.warning(
          block.identity, key + "/stiffness",
          "with `kLST` " + scene::text_of(soft.config.kLST) + " it would be above 1, where links overshoot",
          "1 is used; a smaller `kLST`, with more `piterations`, leaves room");
    made.parts.push_back({{in.begin(), in.end()}, region.density, region.stiffness});
    if (region.attach_to.empty()) continue;
    built.row.attach_to.push_back(region.attach_to);
    built.attached_nodes.emplace_back(in.begin(), in.end());
    made.attached_grips += in.size() / physics::SoftGrip::kMaxNodes + 1;
    built.attached_at.emplace_back();
    for (const std::uint32_t node : in) built.attached_at.back().push_back(made.T_world_body * nodes.at[node]);
  }
  std::sort(made.fixed.begin(), made.fixed.end());
  made.fixed.erase(std::unique(made.fixed.begin(), made.fixed.end()), made.fixed.end());
}

bool usable(const scene::KindBlock& block, const SoftNodes& nodes, Findings& findings) {
  if (nodes.at.empty()) {
    findings.error(block.identity, "mesh", "there is nothing to make nodes of: it has neither a mesh nor a shape",
                   "give `mesh` or `collision mesh`; the soft body is left out");
    return false;
  }
  if (nodes.at.size() <= kMaxSoftNodes) return true;
  findings.error(
      block.identity, "collision mesh",
      "expected at most " + std::to_string(kMaxSoftNodes) + " vertices, found " + std::to_string(nodes.at.size()),
      "give a coarse `collision mesh`, which the fine `mesh` follows; the soft body is left out");
  return false;
}

}  // namespace

std::vector<state::SoftLink> links_of(const SoftNodes& nodes) {
  std::set<std::array<std::uint32_t, 2>> pairs;
  const auto add = [&](std::uint32_t a, std::uint32_t b) { pairs.insert({std::min(a, b), std::max(a, b)}); };
  for (const auto& t : nodes.triangles)
    for (std::size_t i = 0; i < 3; ++i) add(t[i], t[(i + 1) % 3]);
  for (const auto& line : nodes.lines) add(line[0], line[1]);
  std::vector<state::SoftLink> links;
  for (const auto& pair : pairs)
    links.push_back({pair, static_cast<float>(math::norm(nodes.at[pair[1]] - nodes.at[pair[0]]))});
  return links;
}

NodeNumbers::NodeNumbers(const scene::Collision& collision, const SoftNodes& nodes) : nodes_(nodes) {
  if (!collision.shapes.empty() || !mesh::is_obj(collision.mesh_file)) return;
  by_file_ = true;
  const math::Pose T_body_mesh = collision.offset.value_or(math::Pose{});
  for (const math::Vec3& point : mesh::obj_points(collision.mesh_file))
    points_.push_back(T_body_mesh * (point * collision.scale));
  same_place_ = 2.0 * mesh::kWeldEpsilonRelative * mesh::bounds_of(nodes.at).diagonal();
}

std::optional<std::uint32_t> NodeNumbers::find(int number) const {
  if (number < 0 || static_cast<std::size_t>(number) >= count()) return std::nullopt;
  if (!by_file_) return static_cast<std::uint32_t>(number);
  const math::Vec3& wanted = points_[static_cast<std::size_t>(number)];
  for (std::uint32_t node = 0; node < nodes_.at.size(); ++node)
    if (math::norm(nodes_.at[node] - wanted) <= same_place_) return node;
  return std::nullopt;
}

BuiltSoftBody build_soft_body(const scene::KindBlock& block, Catalogue::Impl& all, const LoadedModel& model,
                              const math::Pose& T_world_model, Findings& findings) {
  const auto& soft = block.as<scene::SoftBody>();
  BuiltSoftBody built;
  BodySurroundings surroundings;
  surroundings.step_s = all.options.step_s;
  surroundings.shaders = shader_files(model.description.shaders);
  const BuiltBody looks = all.bodies.build(as_body(block), surroundings, findings);
  SoftNodes nodes = looks.collision_appearance == nullptr ? SoftNodes{} : nodes_of(*looks.collision_appearance);
  if (is_thread(soft)) {
    build_thread(block, nodes, T_world_model, looks.appearance, findings, built);
    return built;
  }
  if (!usable(block, nodes, findings)) return built;
  if (soft.is_tissue) {
    build_tissue(block, nodes, T_world_model, all.options.step_s, looks.appearance, findings, built);
    return built;
  }

  const SoftNodes surface = nodes;
  if (soft.config.inner_lattice) add_inner_lattice(block, *soft.config.inner_lattice, nodes, findings);
  if (!usable(block, nodes, findings)) return built;
  physics::SoftDefinition definition;
  definition.nodes = nodes.at;
  definition.triangles = nodes.triangles;
  definition.lines = nodes.lines;
  definition.T_world_body = T_world_model * soft.T_model_body;
  definition.mass = soft.mass > 0.0 ? soft.mass : 1.0;
  definition.margin = soft.collision.margin;
  definition.config = soft.config;
  definition.fixed = fixed_nodes(block, surface, nodes, findings);
  definition.randomize_constraints = soft.randomize_constraints;
  definition.collision_groups = soft.collision.groups;
  add_regions(block, surface, nodes, definition, built, findings);
  if (soft.config.bending_distance > 2 && nodes.at.size() > kMaxNodesOfFarBending) {
    findings.warning(block.identity, "config/bending constraint",
                     "beyond 2 links it is for at most " + std::to_string(kMaxNodesOfFarBending) + " nodes, found " +
                         std::to_string(nodes.at.size()),
                     "2 is used");
    definition.config.bending_distance = 2;
  }
  if (soft.config.kPR != 0.0) {
    const std::size_t open = physics::open_edges({surface.at, surface.triangles});
    if (open > 0)
      findings.warning(
          block.identity, "config/kPR",
          "a pressure by the volume that the mesh encloses, and it is open along " + std::to_string(open) + " edges",
          "close it, or leave `kPR` out; else the body will most likely diverge");
  }
  built.body = std::make_unique<physics::SoftBody>(definition);
  findings.information(
      block.identity, "",
      std::to_string(built.body->node_count()) + " nodes, " + std::to_string(built.body->link_count()) + " links", "");

  auto shape = std::make_shared<state::SoftShape>();
  shape->faces = nodes.triangles;
  shape->lines = nodes.lines;
  shape->links = links_of(nodes);
  if (looks.appearance != nullptr) shape->skin = make_skin(*looks.appearance, nodes.at, nodes.triangles);
  built.row.appearance = looks.appearance;
  built.row.shape = std::move(shape);
  built.row.nodes = static_cast<std::uint32_t>(nodes.at.size());
  built.row.fixed.resize(nodes.at.size());
  for (const std::uint32_t node : definition.fixed) built.row.fixed[node] = true;
  built.row.mass = built.body->mass();
  built.row.saved = static_cast<std::uint32_t>(built.body->state_size());
  return built;
}

}  // namespace ambf::model
