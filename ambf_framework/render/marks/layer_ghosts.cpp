// Ghost objects over the scene: the shapes that feel, and the looks of those that are drawn.
#include "mesh/appearance.h"
#include "render/marks/layer_shapes.h"
#include "state/ghosts.h"

namespace ambf::render {

namespace {

constexpr DebugColor kFree = {0.35F, 0.78F, 0.80F, 1.0F}, kFeels = {1.0F, 0.62F, 0.12F, 1.0F};

DebugColor with_alpha(DebugColor color, float alpha) {
  color[3] = alpha;
  return color;
}

void draw_parts(const mesh::Appearance& appearance, const math::Pose& T_world_ghost, const DebugColor& faces,
                const DebugColor& edges, WorldShapes& out) {
  for (const mesh::AppearancePart& part : appearance.parts)
    out.mesh(part.mesh, T_world_ghost * part.T_body_part, part.scale, faces, edges);
}

// visit(ghost, slot, its pose as drawn)
template <class Visit>
void each_ghost(const LayerInput& in, Visit visit) {
  const state::Structure& structure = *in.frame.structure;
  for (const state::GhostInfo& ghost : state::ghosts(structure)) {
    const state::ObjectInfo& object = structure.objects[ghost.object];
    if (const math::Pose* T_world_ghost = in.poses.of(object)) visit(ghost, object.slot, *T_world_ghost);
  }
}

}  // namespace

void draw_ghosts(const LayerInput& in, WorldShapes& out) {
  constexpr float kFaces = 0.25F, kEdges = 0.95F;
  each_ghost(in, [&](const state::GhostInfo& ghost, std::uint32_t slot, const math::Pose& T_world_ghost) {
    if (ghost.collision_appearance == nullptr) return;
    const DebugColor& color = state::touches_of(in.frame, slot).size() > 0 ? kFeels : kFree;
    draw_parts(*ghost.collision_appearance, T_world_ghost, with_alpha(color, kFaces), with_alpha(color, kEdges), out);
  });
}

void draw_visible_ghosts(const LayerInput& in, WorldShapes& out) {
  each_ghost(in, [&](const state::GhostInfo& ghost, std::uint32_t, const math::Pose& T_world_ghost) {
    const mesh::Appearance* look = ghost.appearance.get();
    if (look == nullptr || !look->visible) return;
    const float(&color)[3] = look->material.diffuse;
    draw_parts(*look, T_world_ghost, {color[0], color[1], color[2], look->material.alpha}, {}, out);
  });
}

}  // namespace ambf::render
