// What the panel shows of each kind of object: one entry a kind, each in a file of this folder; the rest of the panel
// names no kind. A kind without an entry is shown with a dot and its pose. Entries are added before the first window
// opens. Main thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/panel/sections/sections.h"
#include "render/scene/motion.h"

namespace ambf::render {

// Where and how a sign is drawn beside an object's name in the tree.
struct KindSign {
  ImDrawList& list;
  ImVec2 centre;
  float radius;        // px
  float stroke_width;  // px, of outlines
  ImU32 color;
};

struct PanelKind {
  int color = 5;                                      // of the sign: number of a curve color
  void (*draw_sign)(const KindSign& sign) = nullptr;  // null: a dot
  // The sections below the object's name and actions. Null: its pose.
  void (*draw_details)(PanelScene& scene, const state::ObjectInfo& object) = nullptr;
  // The point that views centre on and follow. Null: the origin of the drawn pose.
  math::Vec3 (*centre)(const ScenePoses& poses, const state::Structure& structure, std::uint32_t slot) = nullptr;
  // Pose as the keys of an ADF block. Null: there is no such text.
  std::string (*pose_as_adf)(const state::Frame& frame, std::uint32_t slot) = nullptr;
};

// Replaces the entry of a kind that has one.
void add_panel_kind(state::ObjectKind kind, const PanelKind& entry);
const PanelKind& panel_kind(state::ObjectKind kind);

// The point that views centre on and follow, as drawn: the newest frame's may be ahead of it.
std::optional<math::Vec3> drawn_centre(const ScenePoses& poses, const state::Structure& structure,
                                       const state::ObjectInfo& object);

// For the files of this folder: section "State" with the pose in the world, and vectors as ADF texts.
void draw_pose_section(PanelScene& scene, const state::ObjectInfo& object);
std::string adf_vector(const math::Vec3& v, const char* x = "x", const char* y = "y", const char* z = "z");

// The built-in entries.
PanelKind actuator_panel_kind();
PanelKind body_panel_kind();
PanelKind camera_panel_kind();
PanelKind ghost_panel_kind();
PanelKind joint_panel_kind();
PanelKind light_panel_kind();
PanelKind sensor_panel_kind();
PanelKind task_panel_kind();
PanelKind vehicle_panel_kind();

}  // namespace ambf::render
