// Who commands what: how old, how regular, and what became of it.
#include <algorithm>
#include <cstdio>

#include "render/panel/sections/sections.h"
#include "state/command.h"

namespace ambf::render {

namespace {

using Commanded = CommandWatch::Commanded;

std::string seconds_text(double seconds) {
  char text[32];
  if (seconds < 0.0) return "-";
  if (seconds < 0.0995) {
    std::snprintf(text, sizeof text, "%.1f ms", seconds * 1e3);
  } else if (seconds < 0.9995) {
    std::snprintf(text, sizeof text, "%.0f ms", seconds * 1e3);
  } else if (seconds < 100.0) {
    std::snprintf(text, sizeof text, "%.1f s", seconds);
  } else {
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  }
  return text;
}

std::string rate_text(double hz) {
  char text[32];
  std::snprintf(text, sizeof text, hz > 0.0 && hz < 9.95 ? "%.1f/s" : "%.0f/s", hz);
  return text;
}

std::string spread_text(const state::Spread& spread) {
  if (spread.count == 0) return "not known yet";
  char text[96];
  std::snprintf(text, sizeof text, "%.2f .. %.2f .. %.2f ms, \u00b1 %.2f", static_cast<double>(spread.min_s) * 1e3,
                static_cast<double>(spread.mean_s) * 1e3, static_cast<double>(spread.max_s) * 1e3,
                static_cast<double>(spread.deviation_s) * 1e3);
  return text;
}

ImVec4 silence_color(const Ui& ui, double silence) {
  constexpr double kUrgent = 0.8;
  if (silence >= kUrgent) return ui.bad;
  return silence >= CommandWatch::kNear ? ui.warning : ImGui::GetStyleColorVec4(ImGuiCol_Text);
}

// There may be several panels.
const char* who(const PanelModel& model, const Commanded& commanded) {
  if (commanded.status.received == 0 && !commanded.status.in_force) return "nobody";
  const auto held_here = [&](std::uint32_t joint) { return model.held.held(model.structure(), joint).has_value(); };
  if (commanded.status.source == state::Source::panel &&
      std::any_of(commanded.joints.begin(), commanded.joints.end(), held_here)) {
    return "this panel";
  }
  return state::name_of(commanded.status.source);
}

std::string model_name(const state::Structure& all, state::ModelId id) {
  for (const state::ModelInfo& model : all.models)
    if (model.id == id) return model.name;
  return "world";
}

void draw_row(PanelScene& scene, const Commanded& commanded) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const state::ObjectInfo& object = model.structure().objects[commanded.status.object];
  const std::string name = "commands/" + object.name;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushID(static_cast<int>(commanded.status.object));
  ImGui::Indent(ui.points(8.0F));
  if (ImGui::Selectable(object.local_name.c_str(), model.selection.id() == object.id,
                        ImGuiSelectableFlags_SpanAllColumns)) {
    model.selection.select(object.id);
  }
  ImGui::Unindent(ui.points(8.0F));
  ImGui::PopID();
  note(ui, name);
  tool_tip(object.name.c_str());
  ImGui::TableNextColumn();
  const char* source = who(model, commanded);
  ImGui::TextUnformatted(source);
  note(ui, name + "/" + source);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(rate_text(commanded.received_hz).c_str());
  note(ui, name + "/rate");
  ImGui::TableNextColumn();
  if (commanded.period.count > 0) {
    ImGui::TextUnformatted(seconds_text(static_cast<double>(commanded.period.mean_s)).c_str());
  } else {
    ImGui::TextColored(ui.muted, "-");
  }
  ImGui::TableNextColumn();
  if (commanded.status.in_force) {
    const bool near = commanded.silence >= CommandWatch::kNear;
    ImGui::TextColored(silence_color(ui, commanded.silence), "%s", seconds_text(commanded.age_s).c_str());
    note(ui, name + (near ? "/age near its end" : "/age"));
  } else {
    ImGui::TextColored(ui.bad, "ended");
    note(ui, name + "/ended");
  }
}

void draw_arm(PanelScene& scene, const CommandWatch::Arm& arm) {
  Ui& ui = scene.ui;
  const std::string name = model_name(scene.model.structure(), arm.model);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  constexpr ImGuiTreeNodeFlags kFlags =
      ImGuiTreeNodeFlags_SpanFullWidth | ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_NoTreePushOnOpen;
  ImGui::PushFont(ui.strong);
  const bool open = ImGui::TreeNodeEx(name.c_str(), kFlags);
  ImGui::PopFont();
  note(ui, "commands/model/" + name);
  ImGui::TableNextColumn();
  ImGui::TextColored(ui.muted, "%zu of %zu", arm.in_force, arm.count);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(rate_text(arm.received_hz).c_str());
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  if (arm.oldest != nullptr) {
    ImGui::TextColored(silence_color(ui, arm.oldest->silence), "%s", seconds_text(arm.oldest->age_s).c_str());
  }
  const auto first = scene.model.commands.list().begin() + static_cast<std::ptrdiff_t>(arm.first);
  if (open)
    std::for_each(first, first + static_cast<std::ptrdiff_t>(arm.count),
                  [&](const Commanded& each) { draw_row(scene, each); });
}

void draw_table(PanelScene& scene) {
  const auto& watch = scene.model.commands;
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float rows = static_cast<float>(watch.list().size() + watch.arms().size());
  if (!ImGui::BeginTable("commands", 5, kFlags, {0.0F, line * (std::min(rows, 12.0F) + 1.5F)})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Object", 0, 0.32F);
  ImGui::TableSetupColumn("By", 0, 0.20F);
  ImGui::TableSetupColumn("Came", 0, 0.16F);
  ImGui::TableSetupColumn("Period", 0, 0.16F);
  ImGui::TableSetupColumn("Age", 0, 0.16F);
  ImGui::TableHeadersRow();
  for (const CommandWatch::Arm& arm : watch.arms()) draw_arm(scene, arm);
  ImGui::EndTable();
}

void count_row(Ui& ui, const char* label, std::uint64_t count, const char* text, bool bad) {
  if (bad && count > 0) ImGui::PushStyleColor(ImGuiCol_Text, ui.warning);
  text_row(ui, label, "%llu", static_cast<unsigned long long>(count));
  if (bad && count > 0) ImGui::PopStyleColor();
  tool_tip(text);
}

// Of the selected object, where it is in the list, else of the one that is nearest to its end.
const Commanded* shown_in_full(const PanelModel& model) {
  const Commanded* shown = nullptr;
  for (const Commanded& each : model.commands.list()) {
    if (each.object == model.selection.id()) return &each;
    if (shown == nullptr || each.silence > shown->silence + CommandWatch::kNear) shown = &each;
  }
  return shown;
}

void draw_in_full(PanelScene& scene, const Commanded& commanded) {
  Ui& ui = scene.ui;
  const state::Structure& all = scene.model.structure();
  const state::CommandState& status = commanded.status;
  ImGui::PushFont(ui.strong);
  ImGui::TextUnformatted(all.objects[status.object].name.c_str());
  ImGui::PopFont();
  note(ui, "commands/in full/" + all.objects[status.object].name);
  if (!begin_rows("in full")) return;
  text_row(ui, "Period, 30 s", "%s", spread_text(commanded.period).c_str());
  note(ui, "commands/in full/period");
  tool_tip("least .. mean .. most between two commands, and their standard deviation");
  text_row(ui, "To a step, 30 s", "%s", spread_text(commanded.delay).c_str());
  note(ui, "commands/in full/delay");
  tool_tip("least .. mean .. most from receiving a command until a step obeys it");
  if (status.in_force) {
    ImGui::PushStyleColor(ImGuiCol_Text, silence_color(ui, commanded.silence));
    text_row(ui, "Silent", "%s of %.0f ms", seconds_text(status.silent_s).c_str(),
             scene.model.frame().run.watchdog_s * 1e3);
    ImGui::PopStyleColor();
    note(ui, "commands/in full/silent");
    tool_tip("since the last sign of life, by the watchdog's clock, which stands still while paused");
    text_row(ui, "In force", "for %s; the same for %s", seconds_text(commanded.for_s).c_str(),
             seconds_text(commanded.unchanged_s).c_str());
  }
  text_row(ui, "Received", "%llu, %s", static_cast<unsigned long long>(status.received),
           rate_text(commanded.received_hz).c_str());
  text_row(ui, "Applied", "%llu, %s", static_cast<unsigned long long>(status.applied),
           rate_text(commanded.applied_hz).c_str());
  count_row(ui, "Coalesced", status.coalesced, "replaced by a newer one, or ended, before a step obeyed it", false);
  count_row(ui, "Refused", status.refused, "not fit to act on; the log says why", true);
  count_row(ui, "Expired", status.expired, "ended by the watchdog: nothing more came", true);
  if (status.beyond > 0) count_row(ui, "Too long", status.beyond, "with entries for more joints than there are", true);
  if (status.bounded > 0)
    count_row(ui, "Cut", status.bounded, "steps in which it asked for more than a body bears; the log says what", true);
  if (!commanded.joints.empty()) {
    std::string names;
    for (const std::uint32_t joint : commanded.joints) names += (names.empty() ? "" : ", ") + all.joints[joint].name;
    row(ui, "Joints");
    ImGui::TextWrapped("%s", names.c_str());
  }
  end_rows();
}

}  // namespace

void draw_commands(PanelScene& scene) {
  if (scene.model.commands.list().empty()) {
    ImGui::TextColored(scene.ui.muted, "Nobody commands anything.");
    return;
  }
  draw_table(scene);
  if (const Commanded* shown = shown_in_full(scene.model)) draw_in_full(scene, *shown);
}

}  // namespace ambf::render
