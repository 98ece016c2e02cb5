// Actuators: where they sit, and what they hold.
#include <algorithm>

#include "render/marks/layer_shapes.h"
#include "state/actuators.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

constexpr DebugColor kIdle{0.60F, 0.63F, 0.68F, 1.0F}, kHolds{1.0F, 0.55F, 0.10F, 1.0F};
constexpr double kMinSize_px = 8.0, kMaxSize_px = 40.0;

// What each of its nodes hangs on, and by how much it is away from there.
void draw_held_nodes(const LayerInput& in, std::uint32_t actuator_slot, const math::Vec3& at, WorldShapes& out) {
  const double ui = in.scale.ui();
  for (const state::HeldNode& held : state::held_nodes(in.frame)) {
    if (held.actuator != actuator_slot) continue;
    const state::NodeRange nodes = state::nodes_of(in.frame, held.soft_body);
    if (held.node >= nodes.size()) continue;
    const math::Vec3& node = nodes[held.node].position_world;
    out.line(at, held.target_world, kHolds, 1.5 * ui, Seen::through);
    out.line(held.target_world, node, force_color(math::norm(held.force_world)), 3.5 * ui, Seen::through);
    out.point(node, kHolds, 7.0 * ui, Seen::through);
  }
}

void draw_actuator(const LayerInput& in, const state::ActuatorInfo& actuator, WorldShapes& out) {
  const state::Structure& structure = *in.frame.structure;
  const state::ObjectInfo& object = structure.objects[actuator.object];
  const math::Pose* T_world_actuator = in.poses.of(object);
  const auto& rows = state::rows(in.frame, state::actuator_kind().column);
  if (T_world_actuator == nullptr || object.slot >= rows.size()) return;
  const state::ActuatorState& state = rows[object.slot];
  const math::Vec3& at = T_world_actuator->position;
  const double pixel_m = in.scale.metres(at, 1.0), ui = in.scale.ui();
  const double size_m = std::clamp(actuator.visible_size_m, kMinSize_px * ui * pixel_m, kMaxSize_px * ui * pixel_m);
  const DebugColor& color = state.actuated() ? kHolds : kIdle;
  out.axes(*T_world_actuator, size_m, 2.0 * ui, Seen::through);
  out.sphere(at, 0.5 * size_m, color, 1.5 * ui, Seen::through);
  for (std::uint32_t i = 0; i < state.held_count; ++i) {
    const std::uint32_t body = state.held[i];
    if (body >= structure.bodies.size()) continue;
    const math::Pose* T_world_held = in.poses.of(structure.objects[structure.bodies[body].object]);
    if (T_world_held == nullptr) continue;
    out.line(at, *T_world_held * structure.bodies[body].T_body_com.position, kHolds, 2.5 * ui, Seen::through);
  }
  draw_held_nodes(in, object.slot, at, out);
}

}  // namespace

void draw_actuators(const LayerInput& in, WorldShapes& out) {
  for (const state::ActuatorInfo& actuator : state::actuators(*in.frame.structure)) draw_actuator(in, actuator, out);
}

void draw_visible_actuators(const LayerInput& in, WorldShapes& out) {
  for (const state::ActuatorInfo& actuator : state::actuators(*in.frame.structure))
    if (actuator.visible) draw_actuator(in, actuator, out);
}

}  // namespace ambf::render
