// The tree of objects, and the details and actions of the selected one.
#include <algorithm>

#include "render/panel/kinds/panel_kinds.h"
#include "render/panel/relations.h"
#include "render/panel/sections/sections.h"
#include "render/scene/body_looks.h"
#include "render/scene/object_kind.h"
#include "state/kind_rows.h"

namespace ambf::render {

namespace {

// What is typed and chosen, and what the last picture measured.
struct Drafts {
  std::string search;
  state::ObjectId scrolled_to;
  float tree_height = 0.0F, selected_height = 0.0F;  // px; of what was last shown of the selected object
};

// A sign before each name: its kind.
void draw_sign(const Ui& ui, state::ObjectKind kind) {
  const float height = ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const PanelKind& entry = panel_kind(kind);
  const KindSign sign{*ImGui::GetWindowDrawList(),
                      {at.x + 0.5F * height, at.y + 0.5F * height},
                      0.24F * height,
                      ui.points(1.6F),
                      ImGui::ColorConvertFloat4ToU32(curve_color(ui, entry.color))};
  if (entry.draw_sign != nullptr) {
    entry.draw_sign(sign);
  } else {
    sign.list.AddCircleFilled(sign.centre, sign.radius, sign.color, 14);
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
  if (!is_model && row.object == model.selection.id()) flags |= ImGuiTreeNodeFlags_Selected;
  ImGui::SetNextItemOpen(row.open);
  if (is_model && ui.strong != nullptr) ImGui::PushFont(ui.strong);
  const float start = ImGui::GetCursorPosX();
  const bool open = ImGui::TreeNodeEx("##row", flags);
  const bool clicked = ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen();
  const bool activated = ImGui::IsItemFocused() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  note(ui, "tree/" + row.text);
  tool_tip(row.text.c_str());
  ImGui::SameLine(start + ImGui::GetTreeNodeToLabelSpacing() - ui.points(3.0F));
  if (!is_model) draw_sign(ui, row.kind);
  const bool hidden = scene.moment.shows.looks != nullptr && scene.moment.shows.looks->of(row.object).hidden;
  ImGui::TextColored(hidden ? ui.muted : ImGui::GetStyle().Colors[ImGuiCol_Text], "%s%s", row.label.c_str(),
                     hidden ? "  (hidden)" : "");
  if (is_model && ui.strong != nullptr) ImGui::PopFont();
  if (open != row.open && row.has_children && !activated) toggled = row.key;
  if ((clicked || activated) && !is_model) model.selection.select(row.object);
  if (clicked && is_model) toggled = row.key;
  ImGui::Unindent(ui.points(14.0F) * static_cast<float>(row.depth) + 0.01F);
  ImGui::PopID();
}

void draw_tree(PanelScene& scene, Drafts& drafts, float height) {
  Ui& ui = scene.ui;
  ObjectTree& tree = scene.model.selection.tree;
  tree.take(scene.model.frame().structure);
  if (text_field(ui, "tree/search", "Search bodies, joints, cameras, lights", &drafts.search)) {
    tree.search(drafts.search);
  }
  ImGui::BeginChild("tree", {0.0F, height}, false);
  const auto& rows = tree.rows();
  if (rows.empty()) ImGui::TextColored(ui.muted, "Nothing of that name");
  const std::size_t wanted = tree.row_of(scene.model.selection.id());
  // Also when the tree has shrunk, because the details of the selected object take room.
  const bool shrunk = height < drafts.tree_height;
  drafts.tree_height = height;
  if ((shrunk || drafts.scrolled_to != scene.model.selection.id()) && wanted != ObjectTree::kNoRow) {
    drafts.scrolled_to = scene.model.selection.id();
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

void draw_selected(PanelScene& scene, Drafts& drafts) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const state::ObjectInfo* object = model.selection.info();
  if (object == nullptr) {
    muted_text(ui, "Select something in the list, or pick it in the scene with Ctrl and the left button.");
    return;
  }
  heading(ui, object->local_name.c_str());
  ImGui::SameLine();
  ImGui::TextColored(ui.muted, "%s", state::info_of(object->kind).label.c_str());
  tool_tip(object->name.c_str());
  const state::ObjectId parent = parent_of(model.structure(), object->id);
  if (icon_button(ui, "object/parent", Icon::parent, "Select what it hangs on", parent.valid())) {
    model.selection.select_parent();
    return;
  }
  ImGui::SameLine();
  const bool body = is_body(*object);
  if (body) {
    if (icon_button(ui, "object/reset", Icon::reset, "Back to where it was loaded, with what is jointed to it")) {
      model.run.reset_mechanism(object->id);
    }
    ImGui::SameLine();
  }
  if (icon_button(ui, "object/copy", Icon::copy, "Copy its full name") && scene.host.set_clipboard) {
    scene.host.set_clipboard(object->name);
  }
  if (!is_joint(*object)) {
    ImGui::SameLine();
    if (button(ui, "object/remove", "Remove")) {
      ImGui::OpenPopup("remove?");
    }
    tool_tip(body ? "from the simulation, with its joints" : "from the simulation");
    if (ImGui::BeginPopup("remove?")) {
      ImGui::Text("Remove %s?", object->name.c_str());
      if (button(ui, "object/remove_yes", "Remove it")) {
        model.edit.remove(object->name);
        ImGui::CloseCurrentPopup();
      }
      ImGui::SameLine();
      if (button(ui, "object/remove_no", "Keep it")) ImGui::CloseCurrentPopup();
      ImGui::EndPopup();
    }
  }
  if (state::rows_of(object->kind).T_world(model.frame(), object->slot) != nullptr) draw_move(scene, *object);
  const PanelKind& kind = panel_kind(object->kind);
  kind.draw_details != nullptr ? kind.draw_details(scene, *object) : draw_pose_section(scene, *object);
  drafts.selected_height = ImGui::GetCursorPosY() + ui.points(8.0F);
}

class ObjectsTab final : public PanelTab {
 public:
  const char* name() const override { return "Objects"; }
  void draw(PanelScene& scene) override;

 private:
  Drafts drafts_;
};

void ObjectsTab::draw(PanelScene& scene) {
  const float all = ImGui::GetContentRegionAvail().y;
  // The tree makes room for what is selected, or for the hint. The search stands above it.
  const float search = ImGui::GetFrameHeightWithSpacing() + scene.ui.points(6.0F);
  const float hint = 2.0F * ImGui::GetTextLineHeightWithSpacing();
  constexpr float kMinShare = 0.36F;
  const float below = scene.model.selection.info() == nullptr ? hint : std::max(hint, drafts_.selected_height);
  const float tree = std::max(kMinShare * all, all - search - below);
  draw_tree(scene, drafts_, std::max(scene.ui.points(110.0F), tree));
  ImGui::BeginChild("selected", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoBackground);
  draw_selected(scene, drafts_);
  ImGui::EndChild();
}

}  // namespace

std::unique_ptr<PanelTab> make_objects_tab() { return std::make_unique<ObjectsTab>(); }

}  // namespace ambf::render
