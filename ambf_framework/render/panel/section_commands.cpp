// Who commands what, and for how long.
#include <algorithm>
#include <cstdio>

#include "render/panel/sections.h"

namespace ambf::render {

namespace {

const char* who(const PanelModel& model, const CommandWatch::Commanded& commanded, state::ObjectKind kind) {
  const state::Structure& all = model.structure();
  for (const std::uint32_t joint : commanded.joints) {
    if (model.held.held(all, joint)) return "this panel";
  }
  // Windows move their cameras as clients do.
  return kind == state::ObjectKind::camera ? "mouse or client" : "a client";
}

std::string age_text(double seconds) {
  char text[32];
  if (seconds < 100.0) {
    std::snprintf(text, sizeof text, "%.1f s", seconds);
  } else {
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  }
  return text;
}

void draw_commanded(PanelScene& scene, const CommandWatch::Commanded& commanded) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const std::uint32_t index = state::find(model.structure(), commanded.object);
  if (index == state::kNone) return;
  const state::ObjectInfo& object = model.structure().objects[index];
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushID(static_cast<int>(index));
  if (ImGui::Selectable(object.local_name.c_str(), model.selected() == object.id,
                        ImGuiSelectableFlags_SpanAllColumns)) {
    model.select(object.id);
  }
  ImGui::PopID();
  note(ui, "commands/" + object.name);
  std::string text = object.name;
  for (const std::uint32_t joint : commanded.joints) text += "\n  " + model.structure().joints[joint].name;
  tool_tip(text.c_str());
  ImGui::TableNextColumn();
  ImGui::Text("%zu", commanded.joints.size());
  ImGui::TableNextColumn();
  const char* source = who(model, commanded, object.kind);
  ImGui::TextUnformatted(source);
  note(ui, "commands/" + object.name + "/" + source);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(age_text(commanded.for_s).c_str());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(commanded.joints.empty() ? "" : age_text(commanded.unchanged_s).c_str());
}

}  // namespace

void draw_commands(PanelScene& scene) {
  Ui& ui = scene.ui;
  const std::vector<CommandWatch::Commanded>& list = scene.model.commands.list();
  if (list.empty()) {
    ImGui::TextColored(ui.muted, "Nobody commands anything.");
    return;
  }
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float height = line * (std::min(static_cast<float>(list.size()), 10.0F) + 1.5F);
  if (!ImGui::BeginTable("commands", 5, kFlags, {0.0F, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Object", 0, 0.30F);
  ImGui::TableSetupColumn("Joints", 0, 0.13F);
  ImGui::TableSetupColumn("By", 0, 0.25F);
  ImGui::TableSetupColumn("Since", 0, 0.15F);
  ImGui::TableSetupColumn("Same for", 0, 0.17F);
  ImGui::TableHeadersRow();
  for (const CommandWatch::Commanded& commanded : list) draw_commanded(scene, commanded);
  ImGui::EndTable();
}

}  // namespace ambf::render
