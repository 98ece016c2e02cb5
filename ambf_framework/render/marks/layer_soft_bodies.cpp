// Soft bodies over the scene: what is drawn of them, where their skins put it on the nodes of the frame, shaded by one
// light from above as surfaces that are seen from both sides.
#include <cmath>

#include "math/rotation.h"
#include "mesh/appearance.h"
#include "mesh/mesh.h"
#include "render/marks/layer_shapes.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

constexpr float kAmbient = 0.35F;  // of the colour, on faces that the light does not reach
const math::Vec3 kLight = math::normalized(math::Vec3{0.35, -0.45, 0.82});

math::Vec3 unit(const math::Vec3& v) {
  const double length = math::norm(v);
  return length > 0.0 ? v * (1.0 / length) : math::Vec3{};
}

math::Vec3 place(const state::SkinVertex& vertex, const state::NodeRange& nodes) {
  const math::Vec3 &a = nodes[vertex.node[0]].position_world, &b = nodes[vertex.node[1]].position_world,
                   &c = nodes[vertex.node[2]].position_world;
  const math::Vec3 at = a * vertex.weight[0] + b * vertex.weight[1] + c * vertex.weight[2];
  return vertex.height == 0.0F ? at : at + unit(math::cross(b - a, c - a)) * vertex.height;
}

DebugColor color_of(const mesh::Appearance& look, const mesh::Mesh& mesh, const mesh::Submesh& part) {
  const float(&own)[3] = look.material.diffuse;
  if (look.has_material || part.material < 0) return {own[0], own[1], own[2], look.material.alpha};
  const mesh::Color& color = mesh.materials[static_cast<std::size_t>(part.material)].diffuse;
  return {color.r, color.g, color.b, color.a};
}

DebugColor shaded(const DebugColor& color, const math::Vec3& normal) {
  const float light = kAmbient + (1.0F - kAmbient) * static_cast<float>(std::abs(math::dot(normal, kLight)));
  return {color[0] * light, color[1] * light, color[2] * light, color[3]};
}

// `first`: the skin's vertex that is this submesh's first.
void draw_part(const mesh::Submesh& part, const state::SoftShape& shape, std::size_t first,
               const state::NodeRange& nodes, const DebugColor& color, WorldShapes& out) {
  for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
    const math::Vec3 a = place(shape.skin[first + part.triangles[t]], nodes),
                     b = place(shape.skin[first + part.triangles[t + 1]], nodes),
                     c = place(shape.skin[first + part.triangles[t + 2]], nodes);
    out.triangle(a, b, c, shaded(color, unit(math::cross(b - a, c - a))));
  }
  constexpr double kLineWidth_px = 2.0;
  for (const auto& line : part.lines)
    out.line(place(shape.skin[first + line[0]], nodes), place(shape.skin[first + line[1]], nodes), color,
             kLineWidth_px);
}

}  // namespace

void draw_visible_soft_bodies(const LayerInput& in, WorldShapes& out) {
  const auto& bodies = state::soft_bodies(*in.frame.structure);
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    const mesh::Appearance* look = bodies[slot].appearance.get();
    const state::NodeRange nodes = state::nodes_of(in.frame, slot);
    if (look == nullptr || !look->visible || nodes.size() == 0) continue;
    std::size_t first = 0;
    for (const mesh::AppearancePart& part : look->parts)
      for (const mesh::Submesh& submesh : part.mesh->submeshes) {
        draw_part(submesh, *bodies[slot].shape, first, nodes, color_of(*look, *part.mesh, submesh), out);
        first += submesh.vertex_count();
      }
  }
}

}  // namespace ambf::render
