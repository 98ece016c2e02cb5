// The tree of objects, and what is to be seen and done of the selected one.
#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "render/marks/joint_span.h"
#include "render/panel/sections/sections.h"
#include "render/scene/body_looks.h"

namespace ambf::render {

namespace {

const char* kind_name(state::ObjectKind kind) {
  switch (kind) {
    case state::ObjectKind::rigid_body: return "body";
    case state::ObjectKind::joint: return "joint";
    case state::ObjectKind::camera: return "camera";
    case state::ObjectKind::light: return "light";
    case state::ObjectKind::world: break;
  }
  return "model";
}

ImVec4 kind_color(const Ui& ui, state::ObjectKind kind) {
  switch (kind) {
    case state::ObjectKind::rigid_body: return curve_color(ui, 0);
    case state::ObjectKind::joint: return curve_color(ui, 1);
    case state::ObjectKind::camera: return curve_color(ui, 2);
    case state::ObjectKind::light: return curve_color(ui, 4);
    case state::ObjectKind::world: break;
  }
  return ui.muted;
}

// A sign before each name: what it is.
void draw_kind(const Ui& ui, state::ObjectKind kind) {
  const float height = ImGui::GetTextLineHeight(), r = 0.24F * height;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 c(at.x + 0.5F * height, at.y + 0.5F * height);
  const ImU32 color = ImGui::ColorConvertFloat4ToU32(kind_color(ui, kind));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  switch (kind) {
    case state::ObjectKind::rigid_body:
      list.AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, color, 0.3F * r);
      break;
    case state::ObjectKind::joint: list.AddCircle(c, r, color, 12, ui.points(1.6F)); break;
    case state::ObjectKind::camera:
      list.AddRectFilled({c.x - 1.2F * r, c.y - 0.8F * r}, {c.x + 0.5F * r, c.y + 0.8F * r}, color, 0.2F * r);
      list.AddTriangleFilled({c.x + 0.4F * r, c.y}, {c.x + 1.4F * r, c.y - 0.8F * r}, {c.x + 1.4F * r, c.y + 0.8F * r},
                             color);
      break;
    case state::ObjectKind::light: list.AddCircleFilled(c, r, color, 14); break;
    case state::ObjectKind::world: break;
  }
  ImGui::Dummy({height, height});
  ImGui::SameLine(0.0F, ui.points(2.0F));
}

void draw_row(PanelScene& scene, const TreeRow& row, std::string& toggled) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const bool is_model = !row.object.valid();
  ImGui::PushID(row.text.c_str());
  ImGui::Indent(ui.points(14.0F) * static_cast<float>(row.depth) + 0.01F);
  ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_OpenOnArrow |
                             ImGuiTreeNodeFlags_OpenOnDoubleClick | ImGuiTreeNodeFlags_SpanAvailWidth;
  if (!row.has_children) flags |= ImGuiTreeNodeFlags_Leaf;
  if (!is_model && row.object == model.selected()) flags |= ImGuiTreeNodeFlags_Selected;
  ImGui::SetNextItemOpen(row.open);
  if (is_model && ui.strong != nullptr) ImGui::PushFont(ui.strong);
  const float start = ImGui::GetCursorPosX();
  const bool open = ImGui::TreeNodeEx("##row", flags);
  const bool clicked = ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen();
  const bool activated = ImGui::IsItemFocused() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  note(ui, "tree/" + row.text);
  tool_tip(row.text.c_str());
  ImGui::SameLine(start + ImGui::GetTreeNodeToLabelSpacing() - ui.points(3.0F));
  if (!is_model) draw_kind(ui, row.kind);
  const bool hidden = scene.moment.looks != nullptr && scene.moment.looks->of(row.object).hidden;
  ImGui::TextColored(hidden ? ui.muted : ImGui::GetStyle().Colors[ImGuiCol_Text], "%s%s", row.label.c_str(),
                     hidden ? "  (hidden)" : "");
  if (is_model && ui.strong != nullptr) ImGui::PopFont();
  if (open != row.open && row.has_children && !activated) toggled = row.key;
  if ((clicked || activated) && !is_model) model.select(row.object);
  if (clicked && is_model) toggled = row.key;
  ImGui::Unindent(ui.points(14.0F) * static_cast<float>(row.depth) + 0.01F);
  ImGui::PopID();
}

void draw_tree(PanelScene& scene, float height) {
  Ui& ui = scene.ui;
  ObjectTree& tree = scene.model.tree;
  tree.take(scene.model.frame().structure);
  if (text_field(ui, "tree/search", "Search bodies, joints, cameras, lights", &scene.drafts.search_objects)) {
    tree.search(scene.drafts.search_objects);
  }
  ImGui::BeginChild("tree", {0.0F, height}, false);
  const auto& rows = tree.rows();
  if (rows.empty()) ImGui::TextColored(ui.muted, "Nothing of that name");
  const std::size_t wanted = tree.row_of(scene.model.selected());
  // Also when there is less room for it: what is selected takes some.
  const bool shrunk = height < scene.drafts.tree_height;
  scene.drafts.tree_height = height;
  if ((shrunk || scene.drafts.scrolled_to != scene.model.selected()) && wanted != ObjectTree::kNoRow) {
    scene.drafts.scrolled_to = scene.model.selected();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float at = line * static_cast<float>(wanted);
    if (at < ImGui::GetScrollY() || at > ImGui::GetScrollY() + height - 2.0F * line) {
      ImGui::SetScrollY(std::max(0.0F, at - 0.4F * height));
    }
  }
  std::string toggled;
  bool was_open = false;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const TreeRow& shown = rows[static_cast<std::size_t>(i)];
      const bool before = toggled.empty();
      draw_row(scene, shown, toggled);
      if (before && !toggled.empty()) was_open = shown.open;
    }
  }
  ImGui::EndChild();
  if (!toggled.empty()) tree.set_open(toggled, !was_open);
}

void draw_push(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  state::Push& push = scene.drafts.push;
  constexpr double kMost = 1e6;
  if (!section(ui, "Push", false) || !begin_rows("push")) return;
  row(ui, "Force N");
  vector_field(ui, "push/force", &push.force_world, -kMost, kMost, "%.3g");
  row(ui, "Torque Nm");
  vector_field(ui, "push/torque", &push.torque_world, -kMost, kMost, "%.3g");
  row(ui, "At point m");
  vector_field(ui, "push/point", &push.point_body, -kMost, kMost, "%.3g");
  tool_tip("where the force acts, in the body's own frame");
  row(ui, "For");
  if (push.seconds <= 0.0) push.seconds = 0.1;
  number_field(ui, "push/seconds", &push.seconds, 1e-4, 1e4, "%.3g s", 80.0F);
  ImGui::SameLine();
  if (button(ui, "push/go", "Push")) scene.model.push(object.id, push);
  tool_tip("force and torque in world axes, for so long in simulated time");
  end_rows();
}

void draw_body(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const state::BodyState& body = model.frame().bodies[object.slot];
  const state::BodyInfo& info = model.structure().bodies[object.slot];
  constexpr double kDegrees = 57.29577951308232;
  if (section(ui, "State", true) && begin_rows("state")) {
    vector_row(ui, "Position", body.T_world_body.position, "%.4f", "m");
    plot_sign_of_row(scene, object.name, {"position x", "position y", "position z"});
    vector_row(ui, "Roll pitch yaw", math::to_rpy(body.T_world_body.orientation) * kDegrees, "%.2f", "\u00b0");
    plot_sign_of_row(scene, object.name, {"roll", "pitch", "yaw"});
    vector_row(ui, "Velocity", body.twist_world.linear, "%.4f", "m/s");
    plot_sign_of_row(scene, object.name, {"velocity x", "velocity y", "velocity z"});
    vector_row(ui, "Turn rate", body.twist_world.angular, "%.3f", "rad/s");
    plot_sign_of_row(scene, object.name, {"angular velocity x", "angular velocity y", "angular velocity z"});
    vector_row(ui, "Force", body.wrench_body.force, "%.3f", "N");
    plot_sign_of_row(scene, object.name, {"force x", "force y", "force z"});
    vector_row(ui, "Torque", body.wrench_body.torque, "%.3f", "Nm");
    plot_sign_of_row(scene, object.name, {"torque x", "torque y", "torque z"});
    if (info.mass > 0.0) {
      text_row(ui, "Mass", "%.4g kg", info.mass);
      vector_row(ui, "Inertia", info.inertia, "%.3g", "kg m\u00b2");
    } else {
      text_row(ui, "Mass", "static");
    }
    text_row(ui, "Status", "%s%s", body.active ? "commanded" : "not commanded", body.asleep ? ", asleep" : "");
    const double pulled = model.pulled_by(object.id);
    if (pulled > 0.0) {
      row(ui, "Pulled by");
      ImGui::TextColored(ui.accent, "%.2f N", pulled);
      note(ui, "object/pull");
    }
    end_rows();
  }
  draw_push(scene, object);
  draw_look(scene, object);
}

// Each free direction of a joint that has several. False: it has not.
bool draw_span_rows(PanelScene& scene, const state::JointInfo& joint) {
  const state::Frame& frame = scene.model.frame();
  const auto coordinates = span_coordinates(joint, frame.bodies[joint.parent_body].T_world_body,
                                            frame.bodies[joint.child_body].T_world_body);
  for (const SpanCoordinate& each : coordinates) {
    row(scene.ui, each.name);
    const char* unit = each.turns ? "rad" : "m";
    const double value = std::abs(each.value) < 5e-5 ? 0.0 : each.value;
    const ImVec4 color = each.at_limit() ? scene.ui.warning : ImGui::GetStyle().Colors[ImGuiCol_Text];
    ImGui::TextColored(color, "%.4f %s", value, unit);
    note(scene.ui, std::string("object/span/") + each.name);
    ImGui::SameLine();
    if (each.free()) {
      ImGui::TextColored(scene.ui.muted, "free");
    } else if (each.locked()) {
      ImGui::TextColored(scene.ui.muted, "locked");
    } else {
      ImGui::TextColored(scene.ui.muted, "%.4g to %.4g", each.low, each.high);
    }
  }
  return !coordinates.empty();
}

void draw_joint(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  const state::JointInfo& info = scene.model.structure().joints[object.slot];
  const state::JointState& joint = scene.model.frame().joints[object.slot];
  const state::Structure& all = scene.model.structure();
  if (!section(ui, "State", true) || !begin_rows("state")) return;
  const auto body = [&](const char* label, const char* name, std::uint32_t slot) {
    row(ui, label);
    const state::ObjectInfo& it = all.objects[all.bodies[slot].object];
    if (button(ui, name, it.local_name.c_str())) scene.model.select(it.id);
  };
  body("Parent", "object/joint_parent", info.parent_body);
  body("Child", "object/joint_child", info.child_body);
  const bool slides = info.type == state::JointType::prismatic || info.type == state::JointType::linear_spring;
  if (draw_span_rows(scene, info)) {
    end_rows();
    return;
  }
  text_row(ui, "Position", "%.4f %s", joint.position, slides ? "m" : "rad");
  plot_sign_of_row(scene, object.name, {"position"});
  text_row(ui, "Velocity", "%.4f %s", joint.velocity, slides ? "m/s" : "rad/s");
  plot_sign_of_row(scene, object.name, {"velocity"});
  text_row(ui, "Effort", "%.4f %s", joint.effort, slides ? "N" : "Nm");
  plot_sign_of_row(scene, object.name, {"effort"});
  if (info.has_limits) text_row(ui, "Limits", "%.4g to %.4g %s", info.lower, info.upper, slides ? "m" : "rad");
  if (info.passive) text_row(ui, "Status", "passive: nobody commands it");
  end_rows();
}

void draw_placed(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  const bool camera = object.kind == state::ObjectKind::camera;
  const math::Pose& T = camera ? scene.model.frame().cameras[object.slot].T_world_camera
                               : scene.model.frame().lights[object.slot].T_world_light;
  constexpr double kDegrees = 57.29577951308232;
  if (!section(ui, "State", true) || !begin_rows("state")) return;
  vector_row(ui, "Position", T.position, "%.4f", "m");
  vector_row(ui, "Roll pitch yaw", math::to_rpy(T.orientation) * kDegrees, "%.2f", "\u00b0");
  end_rows();
  camera ? draw_lens(scene, object) : draw_beam(scene, object);
}

void draw_selected(PanelScene& scene) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const state::ObjectInfo* object = model.selected_info();
  if (object == nullptr) {
    muted_text(ui, "Select something in the list, or pick it in the scene with Ctrl and the left button.");
    return;
  }
  heading(ui, object->local_name.c_str());
  ImGui::SameLine();
  ImGui::TextColored(ui.muted, "%s", kind_name(object->kind));
  tool_tip(object->name.c_str());
  const state::ObjectId parent = model.parent_of(object->id);
  if (icon_button(ui, "object/parent", Icon::parent, "Select what it hangs on", parent.valid())) {
    model.select_parent();
    return;
  }
  ImGui::SameLine();
  const bool body = object->kind == state::ObjectKind::rigid_body;
  if (body) {
    if (icon_button(ui, "object/reset", Icon::reset, "Back to where it was loaded, with what is jointed to it")) {
      model.reset_mechanism(object->id);
    }
    ImGui::SameLine();
  }
  if (icon_button(ui, "object/copy", Icon::copy, "Copy its full name") && scene.host.set_clipboard) {
    scene.host.set_clipboard(object->name);
  }
  if (object->kind != state::ObjectKind::joint) {
    ImGui::SameLine();
    if (button(ui, "object/remove", "Remove")) {
      ImGui::OpenPopup("remove?");
    }
    tool_tip(body ? "from the simulation, with its joints" : "from the simulation");
    if (ImGui::BeginPopup("remove?")) {
      ImGui::Text("Remove %s?", object->name.c_str());
      if (button(ui, "object/remove_yes", "Remove it")) {
        model.remove(object->id);
        ImGui::CloseCurrentPopup();
      }
      ImGui::SameLine();
      if (button(ui, "object/remove_no", "Keep it")) ImGui::CloseCurrentPopup();
      ImGui::EndPopup();
    }
  }
  if (object->kind != state::ObjectKind::joint) draw_move(scene, *object);
  switch (object->kind) {
    case state::ObjectKind::rigid_body: draw_body(scene, *object); break;
    case state::ObjectKind::joint: draw_joint(scene, *object); break;
    default: draw_placed(scene, *object); break;
  }
  if (body || object->kind == state::ObjectKind::joint) draw_parameters(scene, *object);
  scene.drafts.selected_height = ImGui::GetCursorPosY() + ui.points(8.0F);
}

}  // namespace

void draw_objects(PanelScene& scene) {
  const float all = ImGui::GetContentRegionAvail().y;
  // The tree makes room for what is selected, or for the hint. The search stands above it.
  const float search = ImGui::GetFrameHeightWithSpacing() + scene.ui.points(6.0F);
  const float hint = 2.0F * ImGui::GetTextLineHeightWithSpacing();
  constexpr float kLeast = 0.36F;
  const float below = scene.model.selected_info() == nullptr ? hint : std::max(hint, scene.drafts.selected_height);
  const float tree = std::max(kLeast * all, all - search - below);
  draw_tree(scene, std::max(scene.ui.points(110.0F), tree));
  ImGui::BeginChild("selected", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoBackground);
  draw_selected(scene);
  ImGui::EndChild();
}

}  // namespace ambf::render
