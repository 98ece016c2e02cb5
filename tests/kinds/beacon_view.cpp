// Beacons in windows: a layer over the scene, and what the panel shows of one.
#include <cmath>

#include "beacon.h"
#include "render/marks/layer_shapes.h"
#include "render/panel/kinds/panel_kinds.h"

namespace ambf::test {
namespace {

using render::DebugColor;
using render::Seen;

constexpr DebugColor kOn{1.0F, 0.9F, 0.2F, 1.0F}, kOff{0.4F, 0.1F, 0.4F, 1.0F};

void draw_layer(const render::LayerInput& in, render::WorldShapes& out) {
  const state::Structure& structure = *in.frame.structure;
  const auto& beacons = state::rows(in.frame, beacon_kind().column);
  for (const BeaconInfo& info : state::table<BeaconInfo>(structure, beacon_kind().kind)) {
    const state::ObjectInfo& object = structure.objects[info.object];
    const math::Pose* T_world_beacon = in.poses.of(object);
    if (T_world_beacon == nullptr || object.slot >= beacons.size()) continue;
    const double phase = beacons[object.slot].phase;
    const bool on = phase - std::floor(phase) < 0.5;
    out.point(T_world_beacon->position, on ? kOn : kOff, 40.0 * in.scale.ui(), Seen::always);
  }
}

void draw_details(render::PanelScene& scene, const state::ObjectInfo& object) {
  render::draw_pose_section(scene, object);
  if (!render::section(scene.ui, "Beacon", true) || !render::begin_rows("beacon")) return;
  const auto& beacons = state::rows(scene.model.frame(), beacon_kind().column);
  render::text_row(scene.ui, "Blink rate", "%.1f Hz", beacons[object.slot].rate_hz);
  render::note(scene.ui, "object/blink_rate");
  render::end_rows();
}

const bool kRegistered = [] {
  render::add_layer({"Y", true, "beacons on or off", "Beacons", "beacons: on and off", draw_layer});
  render::PanelKind panel;
  panel.color = 2;
  panel.draw_details = draw_details;
  render::add_panel_kind(beacon_kind().kind, panel);
  return true;
}();

}  // namespace
}  // namespace ambf::test
