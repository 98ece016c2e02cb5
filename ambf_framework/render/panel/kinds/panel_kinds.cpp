#include "render/panel/kinds/panel_kinds.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "math/rotation.h"
#include "render/panel/kinds/panel_soft_body.h"
#include "state/actuators.h"
#include "state/ghosts.h"
#include "state/kind_rows.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"
#include "state/tasks.h"
#include "state/vehicles.h"

namespace ambf::render {

namespace {

std::map<state::ObjectKind, PanelKind>& table() {
  static std::map<state::ObjectKind, PanelKind> entries{
      {state::ObjectKind::rigid_body, body_panel_kind()},     {state::ObjectKind::camera, camera_panel_kind()},
      {state::ObjectKind::light, light_panel_kind()},         {state::ObjectKind::joint, joint_panel_kind()},
      {state::sensor_kind().kind, sensor_panel_kind()},       {state::ghost_kind().kind, ghost_panel_kind()},
      {state::actuator_kind().kind, actuator_panel_kind()},   {state::vehicle_kind().kind, vehicle_panel_kind()},
      {state::soft_body_kind().kind, soft_body_panel_kind()}, {state::task_kind().kind, task_panel_kind()},
  };
  return entries;
}

}  // namespace

void add_panel_kind(state::ObjectKind kind, const PanelKind& entry) { table().insert_or_assign(kind, entry); }

const PanelKind& panel_kind(state::ObjectKind kind) {
  static const PanelKind kNoEntry;
  const auto found = table().find(kind);
  return found == table().end() ? kNoEntry : found->second;
}

std::optional<math::Vec3> drawn_centre(const ScenePoses& poses, const state::Structure& structure,
                                       const state::ObjectInfo& object) {
  if (const auto centre = panel_kind(object.kind).centre) return centre(poses, structure, object.slot);
  const math::Pose* T = poses.of(object);
  return T == nullptr ? std::nullopt : std::optional(T->position);
}

void draw_pose_section(PanelScene& scene, const state::ObjectInfo& object) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const math::Pose* T = state::rows_of(object.kind).T_world(scene.model.frame(), object.slot);
  if (T == nullptr || !section(scene.ui, "State", true) || !begin_rows("state")) return;
  vector_row(scene.ui, "Position", T->position, "%.4f", "m");
  vector_row(scene.ui, "Roll pitch yaw", math::to_rpy(T->orientation) * kDegrees, "%.2f", "\u00b0");
  end_rows();
}

std::string adf_vector(const math::Vec3& v, const char* x, const char* y, const char* z) {
  char text[160];
  const auto clean = [](double value) { return std::abs(value) < 5e-10 ? 0.0 : value; };
  std::snprintf(text, sizeof text, "{%s: %.6g, %s: %.6g, %s: %.6g}", x, clean(v.x), y, clean(v.y), z, clean(v.z));
  return text;
}

}  // namespace ambf::render
