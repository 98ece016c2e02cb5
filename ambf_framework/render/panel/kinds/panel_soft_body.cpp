// Soft bodies in the panel: what they consist of, how they move, and what holds them.
#include "render/panel/kinds/panel_soft_body.h"

#include <algorithm>
#include <map>

#include "state/actuators.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

// Of all links, as a share of their length as loaded.
double largest_stretch(const state::SoftBodyInfo& body, const state::NodeRange& nodes) {
  double largest = 0.0;
  if (body.shape == nullptr || nodes.size() == 0) return largest;
  for (const state::SoftLink& link : body.shape->links) {
    const double length_m = math::norm(nodes[link.node[1]].position_world - nodes[link.node[0]].position_world);
    if (link.length_m > 0.0F) largest = std::max(largest, length_m / static_cast<double>(link.length_m) - 1.0);
  }
  return largest;
}

void draw_holders(PanelScene& scene, const state::Frame& frame, std::uint32_t slot) {
  struct Hold {
    int nodes = 0;
    math::Vec3 force_world;
  };
  std::map<std::uint32_t, Hold> holds;  // by actuator
  for (const state::HeldNode& held : state::held_nodes(frame)) {
    if (held.soft_body != slot) continue;
    ++holds[held.actuator].nodes;
    holds[held.actuator].force_world += held.force_world;
  }
  const state::Structure& structure = *frame.structure;
  if (holds.empty()) text_row(scene.ui, "Held by", "-");
  for (const auto& [actuator, hold] : holds)
    text_row(scene.ui, "Held by", "%s, %d nodes, %.3f N",
             structure.objects[state::actuators(structure)[actuator].object].local_name.c_str(), hold.nodes,
             math::norm(hold.force_world));
}

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  draw_pose_section(scene, object);
  const state::Frame& frame = scene.model.frame();
  const state::SoftBodyInfo& body = state::soft_bodies(*frame.structure)[object.slot];
  const auto& rows = state::rows(frame, state::soft_body_kind().column);
  if (object.slot >= rows.size() || !section(scene.ui, "Soft body", true) || !begin_rows("soft body")) return;
  const auto fixed = std::count(body.fixed.begin(), body.fixed.end(), true);
  text_row(scene.ui, "Nodes", "%d, %d fixed", static_cast<int>(body.nodes), static_cast<int>(fixed));
  if (body.shape != nullptr)
    text_row(scene.ui, "Faces, links", "%d, %d", static_cast<int>(body.shape->faces.size()),
             static_cast<int>(body.shape->links.size()));
  text_row(scene.ui, "Mass", "%.4f kg", body.mass);
  text_row(scene.ui, "Longest stretch", "%.1f %%", 100.0 * largest_stretch(body, state::nodes_of(frame, object.slot)));
  draw_holders(scene, frame, object.slot);
  if (rows[object.slot].frozen) text_row(scene.ui, "State", "frozen: it diverged");
  end_rows();
}

}  // namespace

PanelKind soft_body_panel_kind() {
  PanelKind kind;
  kind.color = 2;
  kind.draw_details = draw_details;
  return kind;
}

}  // namespace ambf::render
