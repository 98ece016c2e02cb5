#include "render/marks/layer_soft_bodies.h"

#include <algorithm>
#include <cmath>

#include "state/actuators.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

constexpr DebugColor kFree{0.82F, 0.86F, 0.92F, 1.0F}, kFixed{0.95F, 0.25F, 0.20F, 1.0F},
    kHeld{1.0F, 0.55F, 0.10F, 1.0F}, kLink{0.35F, 0.62F, 0.90F, 0.75F};
constexpr double kNode_px = 4.0, kMarkedNode_px = 8.0, kLink_px = 1.0, kStrain_px = 2.5;
constexpr double kFullStrain = 0.1;

template <class Draw>
void each_link(const LayerInput& in, Draw&& draw) {
  const auto& bodies = state::soft_bodies(*in.frame.structure);
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    const state::NodeRange nodes = state::nodes_of(in.frame, slot);
    if (bodies[slot].shape == nullptr || nodes.size() == 0) continue;
    for (const state::SoftLink& link : bodies[slot].shape->links)
      draw(nodes[link.node[0]].position_world, nodes[link.node[1]].position_world, link.length_m);
  }
}

}  // namespace

DebugColor strain_color(double stretch) {
  constexpr DebugColor kShort{0.15F, 0.40F, 1.0F, 1.0F}, kAsLoaded{0.75F, 0.77F, 0.78F, 1.0F},
      kLong{1.0F, 0.16F, 0.10F, 1.0F};
  const double share = std::clamp((stretch - 1.0) / kFullStrain, -1.0, 1.0);
  const DebugColor& end = share < 0.0 ? kShort : kLong;
  DebugColor color = kAsLoaded;
  for (std::size_t i = 0; i < 3; ++i) color[i] += (end[i] - kAsLoaded[i]) * static_cast<float>(std::abs(share));
  return color;
}

void draw_soft_nodes(const LayerInput& in, WorldShapes& out) {
  const double ui = in.scale.ui();
  each_link(in, [&](const math::Vec3& a, const math::Vec3& b, double) {
    out.line(a, b, kLink, kLink_px * ui, Seen::through);
  });
  const auto& bodies = state::soft_bodies(*in.frame.structure);
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    const state::NodeRange nodes = state::nodes_of(in.frame, slot);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      const bool fixed = node < bodies[slot].fixed.size() && bodies[slot].fixed[node];
      out.point(nodes[node].position_world, fixed ? kFixed : kFree, (fixed ? kMarkedNode_px : kNode_px) * ui,
                Seen::through);
    }
  }
  for (const state::HeldNode& held : state::held_nodes(in.frame)) {
    const state::NodeRange nodes = state::nodes_of(in.frame, held.soft_body);
    if (held.node < nodes.size()) out.point(nodes[held.node].position_world, kHeld, kMarkedNode_px * ui, Seen::always);
  }
}

void draw_soft_strain(const LayerInput& in, WorldShapes& out) {
  each_link(in, [&](const math::Vec3& a, const math::Vec3& b, double length_m) {
    const double stretch = length_m > 0.0 ? math::norm(b - a) / length_m : 1.0;
    out.line(a, b, strain_color(stretch), kStrain_px * in.scale.ui(), Seen::through);
  });
}

}  // namespace ambf::render
