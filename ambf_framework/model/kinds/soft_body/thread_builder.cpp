// A thread of a soft body: nodes along its points, its regions, and the tube that is drawn.
#include <algorithm>
#include <cmath>

#include "mesh/mesh.h"
#include "model/kinds/soft_body/detail/builder.h"
#include "physics/thread.h"
#include "scene/soft_limits.h"

namespace ambf::model {
namespace {

constexpr double kTimeOfSegment = 1e-6;  // s, of a step of one core of 2020 in which it moves
constexpr double kSegments = 100.0;      // where no element size is given

double length_of(const std::vector<math::Vec3>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += math::norm(points[i] - points[i - 1]);
  return length;
}

std::vector<math::Vec3> nodes_along(const std::vector<math::Vec3>& points, double size) {
  std::vector<math::Vec3> nodes = {points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const math::Vec3 from = points[i - 1], way = points[i] - from;
    const double parts = std::max(1.0, std::ceil(math::norm(way) / size - 1e-9));
    if (!(math::norm(way) > 1e-6 * size)) continue;  // the same place again
    for (double k = 1.0; k <= parts; ++k) nodes.push_back(from + way * (k / parts));
  }
  return nodes;
}

// Vertices are placed when it is drawn; they only have to differ.
std::shared_ptr<const mesh::Mesh> tube_about(const std::vector<math::Vec3>& nodes, double radius) {
  auto made = std::make_shared<mesh::Mesh>();
  made->submeshes.resize(1);
  mesh::Submesh& tube = made->submeshes[0];
  const auto sides = static_cast<std::uint32_t>(state::kTubeSides);
  const auto count = static_cast<std::uint32_t>(nodes.size());
  const auto add = [&](const math::Vec3& at, const math::Vec3& normal) {
    for (const double value : {at.x, at.y, at.z}) tube.positions.push_back(static_cast<float>(value));
    for (const double value : {normal.x, normal.y, normal.z}) tube.normals.push_back(static_cast<float>(value));
  };
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = 6.283185307179586 * k / sides;
      const math::Vec3 out{std::cos(angle), std::sin(angle), 0.0};
      add(nodes[i] + out * radius, out);
    }
  add(nodes.front(), {0, 0, -1});
  add(nodes.back(), {0, 0, 1});
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t next = (k + 1) % sides, last = sides * (count - 1);
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      const std::uint32_t a = sides * i + k, b = sides * i + next;
      for (const std::uint32_t corner : {a, b, b + sides, a, b + sides, a + sides}) tube.triangles.push_back(corner);
    }
    for (const std::uint32_t corner : {sides * count, next, k, sides * count + 1, last + k, last + next})
      tube.triangles.push_back(corner);
  }
  made->bounds = mesh::bounds_of(nodes);
  return made;
}

}  // namespace

void build_thread(const scene::KindBlock& block, const SoftNodes& nodes, const math::Pose& T_world_model,
                  const std::shared_ptr<const mesh::Appearance>& looks, Findings& findings, BuiltSoftBody& built) {
  const auto& soft = block.as<scene::SoftBody>();
  const scene::Tissue& tissue = soft.tissue;
  const std::vector<math::Vec3> points = tissue.points.empty() ? polyline_of(block, nodes, findings) : tissue.points;
  if (points.empty()) return;
  const double length = length_of(points), size = tissue.element_size.value_or(length / kSegments);
  if (length / size + static_cast<double>(points.size()) > static_cast<double>(scene::kMaxThreadNodes)) {
    findings.error(block.identity, "tissue/element size",
                   "a thread has at most " + std::to_string(scene::kMaxThreadNodes) + " nodes, and " +
                       std::to_string(std::lround(length / size)) + " segments were asked for",
                   "give a larger one, or fewer `points`; the soft body is left out");
    return;
  }
  physics::ThreadDefinition definition;
  definition.nodes = nodes_along(points, size);
  definition.material.radius = tissue.radius;
  definition.material.young = tissue.young;
  definition.material.density = tissue.density;
  definition.material.friction = tissue.friction;
  definition.T_world_body = T_world_model * soft.T_model_body;
  definition.collision_groups = soft.collision.groups;
  definition.touches_itself = tissue.touches == scene::TissueTouches::all;
  definition.touches_others = tissue.touches != scene::TissueTouches::none;
  const auto count = static_cast<std::uint32_t>(definition.nodes.size());
  std::vector<bool> fixed(count);
  for (std::size_t i = 0; i < tissue.regions.size(); ++i) {
    const scene::TissueRegion& region = tissue.regions[i];
    std::vector<std::uint32_t> within;
    for (std::uint32_t node = 0; node < count; ++node)
      if (is_within(region, definition.nodes[node], 1e-6 * size)) within.push_back(node);
    if (within.empty()) {
      findings.warning(block.identity, "tissue/regions[" + std::to_string(i) + "]",
                       "nothing of the thread is in this region", "its location is in the body frame; it is left out");
      continue;
    }
    for (const std::uint32_t node : within) fixed[node] = fixed[node] || region.fixed;
    if (region.attach_to.empty()) continue;
    definition.attached.push_back(std::move(within));
    built.row.attach_to.push_back(region.attach_to);
  }
  for (std::uint32_t node = 0; node < count; ++node)
    if (fixed[node]) definition.fixed.push_back(node);
  auto body = std::make_unique<physics::Thread>(definition);
  findings.information(block.identity, "tissue",
                       "a thread of " + std::to_string(body->link_count()) + " segments, " +
                           std::to_string(1e3 * body->rest_length()) + " mm; a step takes some " +
                           scene::text_of(1e3 * kTimeOfSegment * static_cast<double>(body->link_count())) +
                           " ms while it moves",
                       "");
  auto shape = std::make_shared<state::SoftShape>();
  for (std::uint32_t node = 1; node < count; ++node) shape->lines.push_back({node - 1, node});
  shape->links = links_of({definition.nodes, {}, shape->lines});
  shape->tube_radius_m = static_cast<float>(tissue.radius);
  if (looks != nullptr) {
    auto look = std::make_shared<mesh::Appearance>(*looks);
    look->parts = {{tube_about(definition.nodes, tissue.radius), {}, 1.0}};
    built.row.appearance = std::move(look);
    for (std::size_t i = 0; i < state::kTubeSides * count + 2; ++i) {
      const auto node = static_cast<std::uint32_t>(std::min<std::size_t>(i / state::kTubeSides, count - 1));
      shape->skin.push_back({{node, node, node}});
    }
  }
  built.row.shape = std::move(shape);
  built.row.nodes = count;
  built.row.fixed = std::move(fixed);
  built.row.mass = body->mass();
  built.row.saved = static_cast<std::uint32_t>(body->state_size());
  built.body = std::move(body);
}

}  // namespace ambf::model
