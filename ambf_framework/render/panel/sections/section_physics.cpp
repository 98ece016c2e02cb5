// How physics is doing: times, gravity, what was changed, contacts.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <numeric>

#include "render/panel/sections/sections.h"
#include "render/panel/start_options.h"

namespace ambf::render {

namespace {

constexpr const char* kPhases[] = {"commands", "controllers", "collision", "solver", "integration", "publish"};
constexpr std::size_t kMaxContacts = 200;

double resident_megabytes() {
  std::ifstream in("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  in >> all >> resident;
  return resident * 4096.0 / 1e6;
}

// What other threads do: it takes nothing from a step.
void draw_beside(PanelScene& scene, const state::RunState& run) {
  Ui& ui = scene.ui;
  if (run.graphics_rate > 0.0) {
    text_row(ui, "Drawing", "%.1f ms a picture, %.0f pictures/s", run.seconds_per_picture * 1e3, run.graphics_rate);
    note(ui, "times/drawing");
    tool_tip("wall time of drawing all windows once");
  }
  if (run.comm_seconds_per_frame > 0.0) {
    text_row(ui, "Publishing", "%.0f \u00b5s a frame", run.comm_seconds_per_frame * 1e6);
    note(ui, "times/comm");
    tool_tip("processor time of handing the states of a frame to clients; sending them goes on in other threads");
  }
}

void draw_times(PanelScene& scene) {
  Ui& ui = scene.ui;
  const History& history = scene.model.history;
  const state::RunState& run = scene.model.frame().run;
  std::vector<float> rtf, phases[state::kPhaseCount];
  float highest = 1.05F, longest = 1e-6F;
  for (const History::Sample& sample : history.samples()) {
    rtf.push_back(sample.real_time_factor);
    highest = std::max(highest, sample.real_time_factor * 1.05F);
    for (std::size_t i = 0; i < sample.phases_s.size(); ++i) {
      phases[i].push_back(sample.phases_s[i] * 1e6F);
      longest = std::max(longest, sample.phases_s[i] * 1.1e6F);
    }
  }
  const int count = static_cast<int>(rtf.size());
  constexpr int kRoom = static_cast<int>(History::kMost);
  ImGui::TextColored(ui.muted, "Real-time factor, 30 s");
  const Curve curve{rtf.data(), count, kRoom, ui.good};
  curves(ui, "physics/rtf", &curve, 1, 0.0F, highest, 54.0F);
  ImGui::TextColored(ui.muted, "Time of a step, 30 s, up to %.0f \u00b5s", static_cast<double>(longest));
  Curve list[state::kPhaseCount];
  double sum = 0.0;
  for (int i = 0; i < state::kPhaseCount; ++i) {
    list[i] = {phases[i].data(), count, kRoom, curve_color(ui, i)};
    sum += run.seconds_per_phase[i];
  }
  curves(ui, "physics/phases", list, state::kPhaseCount, 0.0F, longest, 70.0F);
  if (ImGui::BeginTable("phases", 2)) {
    for (int i = 0; i < state::kPhaseCount; ++i) {
      ImGui::TableNextColumn();
      ImGui::TextColored(curve_color(ui, i), "%s", kPhases[i]);
      ImGui::SameLine();
      ImGui::Text("%.0f \u00b5s", run.seconds_per_phase[i] * 1e6);
    }
    ImGui::EndTable();
  }
  if (!begin_rows("run")) return;
  text_row(ui, "Step", "%.3g ms, of which busy %.0f \u00b5s", run.step_s * 1e3, sum * 1e6);
  draw_beside(scene, run);
  text_row(ui, "Lateness", "%.2g ms usually, %.2g ms at worst", run.lateness_p50 * 1e3, run.lateness_max * 1e3);
  text_row(ui, "Given up", "%llu steps", static_cast<unsigned long long>(run.steps_given_up));
  text_row(ui, "Refused", "%llu commands", static_cast<unsigned long long>(run.commands_refused));
  text_row(ui, "Processor", "%.0f %% of a core; %.0f MB", run.physics_cpu_share * 100.0, resident_megabytes());
  end_rows();
}

void draw_gravity(PanelScene& scene) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  math::Vec3 gravity = model.frame().gravity_world;
  const bool changed = !(gravity == model.tune.gravity_loaded());
  if (begin_rows("gravity")) {
    row(ui, changed ? "Gravity *" : "Gravity");
    if (vector_field(ui, "gravity", &gravity, -1000.0, 1000.0, "%.3g")) model.tune.set_gravity(gravity);
    tool_tip("m/s\u00b2, world axes; bodies with a gravity of their own keep it");
    end_rows();
  }
  const auto& list = model.tune.changed();
  if (list.empty() && !changed) {
    ImGui::TextColored(ui.muted, "Nothing differs from what was loaded.");
    return;
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(ui.warning, "%zu changed", list.size() + (changed ? 1 : 0));
  note(ui, "physics/changed");
  ImGui::SameLine();
  if (button(ui, "physics/revert_all", "All back to what was loaded")) model.tune.revert_all();
  for (std::size_t i = 0; i < std::min<std::size_t>(list.size(), 50); ++i) {
    const TuneActions::Changed& change = list[i];
    const std::uint32_t object = state::find(model.structure(), change.object);
    if (object == state::kNone) continue;
    ImGui::PushID(static_cast<int>(i));
    if (icon_button(ui, "changed/" + std::to_string(i), Icon::reset, "Back to what was loaded")) {
      model.tune.revert(change.object, change.parameter);
    }
    ImGui::SameLine();
    char text[256];
    std::snprintf(text, sizeof text, "%s %s: %g, was %g", model.structure().objects[object].local_name.c_str(),
                  state::info_of(change.parameter).name, change.now.x, change.loaded.x);
    if (ImGui::Selectable(text)) model.selection.select(change.object);
    ImGui::PopID();
  }
}

void draw_start_options(PanelScene& scene) {
  Ui& ui = scene.ui;
  if (!begin_rows("start")) return;
  for (const StartOption& option : start_options(scene.model.frame().run)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(ui.muted, "%s", option.label);
    tool_tip(option.text);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(option.value.c_str());
    note(ui, std::string("start/") + option.label);
    tool_tip(option.text);
    ImGui::SameLine();
    ImGui::TextColored(ui.muted, "%s", option.set_by);
    tool_tip(option.text);
  }
  end_rows();
}

ImVec4 force_color(const Ui& ui, double force, double most) {
  const auto part = static_cast<float>(most > 0.0 ? std::clamp(force / most, 0.0, 1.0) : 0.0);
  const auto mix = [&](float a, float b) { return a + (b - a) * part; };
  return {mix(ui.muted.x, ui.bad.x), mix(ui.muted.y, ui.bad.y), mix(ui.muted.z, ui.bad.z), 1.0F};
}

void draw_contacts(PanelScene& scene) {
  Ui& ui = scene.ui;
  const state::Frame& frame = scene.model.frame();
  const state::Structure& all = scene.model.structure();
  const double step_s = frame.run.step_s > 0.0 ? frame.run.step_s : 1e-3;
  ImGui::TextColored(ui.muted, "%u points, strongest first", frame.contacts_total);
  note(ui, "physics/contacts");
  std::vector<std::uint32_t> order(frame.contacts.size());
  std::iota(order.begin(), order.end(), 0U);
  const std::size_t shown = std::min(order.size(), kMaxContacts);
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(shown), order.end(),
      [&](std::uint32_t a, std::uint32_t b) { return frame.contacts[a].impulse > frame.contacts[b].impulse; });
  if (shown == 0) return;
  const double most = frame.contacts[order[0]].impulse / step_s;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float height = line * (std::min(static_cast<float>(shown), 12.0F) + 1.3F);
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("contacts", 4, kFlags, {0.0F, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Body", 0, 0.33F);
  ImGui::TableSetupColumn("on", 0, 0.33F);
  ImGui::TableSetupColumn("Normal N", 0, 0.18F);
  ImGui::TableSetupColumn("Friction", 0, 0.16F);
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown));
  const auto name = [&](std::uint32_t body) -> const std::string& {
    return all.objects[all.bodies[body].object].local_name;
  };
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const state::ContactState& contact = frame.contacts[order[static_cast<std::size_t>(i)]];
      const double force = contact.impulse / step_s;
      const ImVec4 color = force_color(ui, force, most);
      ImGui::PushID(i);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      if (ImGui::Selectable(name(contact.body_a).c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) {
        scene.model.selection.select(all.objects[all.bodies[contact.body_a].object].id);
      }
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(name(contact.body_b).c_str());
      ImGui::TableNextColumn();
      ImGui::TextColored(color, "%.2f", force);
      ImGui::TableNextColumn();
      ImGui::TextColored(color, "%.2f", math::norm(contact.friction_world) / step_s);
      ImGui::PopID();
    }
  }
  ImGui::EndTable();
}

class PhysicsTab final : public PanelTab {
 public:
  const char* name() const override { return "Physics"; }
  void draw(PanelScene& scene) override;
};

void PhysicsTab::draw(PanelScene& scene) {
  if (section(scene.ui, "Times", true)) draw_times(scene);
  if (section(scene.ui, "Gravity and changes", true)) draw_gravity(scene);
  if (section(scene.ui, "Commands", true)) draw_commands(scene);
  if (section(scene.ui, "Set at the start", true)) draw_start_options(scene);
  if (section(scene.ui, "Contacts", true)) draw_contacts(scene);
}

}  // namespace

std::unique_ptr<PanelTab> make_physics_tab() { return std::make_unique<PhysicsTab>(); }

}  // namespace ambf::render
