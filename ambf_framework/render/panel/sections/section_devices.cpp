// Input devices: one row each; below, all of the one that is chosen, with what can be changed between two trials.
#include <algorithm>
#include <cstdio>

#include "render/marks/device_text.h"
#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

using state::DeviceParameter;

constexpr const char* kRotations[] = {"camera", "world"};

ImVec4 color(const DebugColor& c) { return {c[0], c[1], c[2], 1.0F}; }

ImVec4 color(const Ui& ui, DeviceAlert alert) {
  if (alert == DeviceAlert::fails) return ui.bad;
  return alert == DeviceAlert::waits ? ui.warning : ui.good;
}

// What it does now, in a word or two.
std::string doing(const state::DeviceStatus& status, const DeviceRemark& remark) {
  if (!remark.text.empty()) return remark.text;
  return status.engaged ? "moves its tool" : "at rest";
}

struct Bar {
  double written = 0.0, wanted = 0.0, limit = 0.0;  // what the hand feels, what the law asks for; limit 0: none
  double usual = 0.0;                               // without a limit the bar is full here
  const char* unit = "";
  bool at_limit = false;
};

Bar force_of(const state::DeviceInfo& info, const state::DeviceStatus& status) {
  const double limit = status.limits.max_force_N > 0.0 ? status.limits.max_force_N : info.device_max_force_N;
  return {math::norm(status.wrench_u_written.force),
          math::norm(status.wrench_u_wanted.force),
          limit,
          10.0,
          "N",
          status.at_limit};
}

Bar torque_of(const state::DeviceInfo& info, const state::DeviceStatus& status) {
  const double limit = status.limits.max_torque_Nm > 0.0 ? status.limits.max_torque_Nm : info.device_max_torque_Nm;
  return {math::norm(status.wrench_u_written.torque),
          math::norm(status.wrench_u_wanted.torque),
          limit,
          1.0,
          "N m",
          status.at_limit};
}

// `whole`: with what the law asks for.
void draw_bar(Ui& ui, const std::string& name, const Bar& bar, bool whole) {
  const double most = bar.limit > 0.0 ? bar.limit : bar.usual;
  char text[96], tip[160];
  if (whole) {
    std::snprintf(text, sizeof text, "%.2f of %.2f %s", bar.written, bar.wanted, bar.unit);
  } else {
    std::snprintf(text, sizeof text, "%.1f %s", bar.written, bar.unit);
  }
  ImVec4 fill = bar.at_limit ? ui.warning : ui.accent;
  fill.w = 0.6F;  // the number stays readable on it
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, fill);
  ImGui::ProgressBar(static_cast<float>(std::clamp(bar.written / most, 0.0, 1.0)), {-1.0F, ImGui::GetFrameHeight()},
                     text);
  ImGui::PopStyleColor();
  note(ui, name);
  std::snprintf(tip, sizeof tip, "what the hand feels, of what the law asks for; %s %.3g %s",
                bar.limit > 0.0 ? "the limit is" : "no limit besides the hardware's, the bar is full at", most,
                bar.unit);
  tool_tip(tip);
}

void times_row(Ui& ui, const char* label, const state::RunPercentiles& times, const char* tip) {
  if (times.count == 0) {
    text_row(ui, label, "not known yet");
  } else {
    text_row(ui, label, "%.2f  %.2f  %.2f  %.2f ms", times.p50_s * 1e3, times.p99_s * 1e3, times.p999_s * 1e3,
             times.max_s * 1e3);
  }
  note(ui, std::string("devices/") + label);
  tool_tip(tip);
}

// The axes that have a gain: "x z".
std::string axes_of(const math::Vec3& gains) {
  std::string text;
  if (gains.x > 0.0) text += "x ";
  if (gains.y > 0.0) text += "y ";
  if (gains.z > 0.0) text += "z ";
  if (text.empty()) return "none";
  text.pop_back();
  return text;
}

class DevicesTab final : public PanelTab {
 public:
  const char* name() const override { return "Devices"; }
  void draw(PanelScene& scene) override;

 private:
  void draw_table(PanelScene& scene);
  void draw_state(PanelScene& scene, const state::DeviceInfo& info, const state::DeviceStatus& status);
  void draw_times(PanelScene& scene, const state::DeviceStatus& status);
  void draw_choices(PanelScene& scene, const state::DeviceStatus& status);
  void field(PanelScene& scene, const state::DeviceStatus& status, DeviceParameter parameter, const char* tip);

  unsigned chosen_ = 0;
};

void DevicesTab::draw_table(PanelScene& scene) {
  Ui& ui = scene.ui;
  const DeviceActions& devices = scene.model.devices;
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("devices", 4, kFlags)) return;
  ImGui::TableSetupColumn("Device", 0, 0.30F);
  ImGui::TableSetupColumn("State", 0, 0.34F);
  ImGui::TableSetupColumn("Hz", 0, 0.12F);
  ImGui::TableSetupColumn("Force", 0, 0.24F);
  ImGui::TableHeadersRow();
  ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0.0F, 0.5F});
  for (unsigned device = 0; device < devices.count(); ++device) {
    const std::shared_ptr<const state::DeviceInfo> info = devices.info(device);
    const state::DeviceStatus status = devices.status(device);
    const DeviceRemark remark = remark_on(*info, status);
    ImGui::PushID(static_cast<int>(device));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, color(color_of(*info)));
    constexpr ImGuiSelectableFlags kRow = ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap;
    if (ImGui::Selectable(info->name.c_str(), device == chosen_, kRow, {0.0F, ImGui::GetFrameHeight()}))
      chosen_ = device;
    ImGui::PopStyleColor();
    note(ui, "devices/" + info->name);
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color(ui, remark.alert), "%s", doing(status, remark).c_str());
    note(ui, "devices/" + info->name + "/" + doing(status, remark));
    tool_tip(info->message.empty() ? info->effector_name.c_str() : info->message.c_str());
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%.0f", status.rate_hz);
    ImGui::TableNextColumn();
    draw_bar(ui, "devices/" + info->name + "/force", force_of(*info, status), false);
    ImGui::PopID();
  }
  ImGui::PopStyleVar();
  ImGui::EndTable();
}

void DevicesTab::draw_state(PanelScene& scene, const state::DeviceInfo& info, const state::DeviceStatus& status) {
  Ui& ui = scene.ui;
  if (!info.message.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ui.bad);
    ImGui::TextWrapped("%s", info.message.c_str());
    ImGui::PopStyleColor();
  }
  if (!begin_rows("state")) return;
  text_row(ui, "Hardware", "%s", info.hardware_name.c_str());
  text_row(ui, "Driver", "%s%s", info.driver.empty() ? "none answers to this name" : info.driver.c_str(),
           status.fifo ? ", real-time priority" : "");
  text_row(ui, "Tool", "%s%s", info.effector_name.c_str(), info.effector.valid() ? "" : " (not loaded)");
  text_row(ui, "Camera", "%s", info.camera_names.empty() ? "none" : info.camera_names.front().c_str());
  row(ui, "Force");
  draw_bar(ui, "devices/force", force_of(info, status), true);
  row(ui, "Torque");
  draw_bar(ui, "devices/torque", torque_of(info, status), true);
  text_row(ui, "Jaw", "hand %.2f, tool %.2f%s", status.jaw_hand, status.jaw_tool,
           status.jaw_follows ? "" : ", not met yet");
  text_row(ui, "Scheme", "moves %s, turns %s", axes_of(status.gains.linear_stiffness).c_str(),
           axes_of(status.gains.angular_stiffness).c_str());
  text_row(ui, "", "feels %s, torques %s", axes_of(status.hand_gains.linear_stiffness).c_str(),
           axes_of(status.hand_gains.angular_stiffness).c_str());
  end_rows();
}

void DevicesTab::draw_times(PanelScene& scene, const state::DeviceStatus& status) {
  Ui& ui = scene.ui;
  muted_text(ui, "Over the whole run: median, 99 %, 99.9 %, maximum");
  if (!begin_rows("times")) return;
  times_row(ui, "Period", status.period, "between two cycles of its thread");
  times_row(ui, "To the step", status.set_point_age, "from reading a sample to the first step that obeyed it");
  times_row(ui, "To the force", status.sample_to_force, "from reading a sample to the force that answers it");
  text_row(ui, "Samples", "%.0f Hz, %llu refused", status.sample_rate_hz,
           static_cast<unsigned long long>(status.refused_samples));
  text_row(ui, "Faults", "%llu, and %llu late cycles", static_cast<unsigned long long>(status.faults),
           static_cast<unsigned long long>(status.slips));
  end_rows();
}

void DevicesTab::field(PanelScene& scene, const state::DeviceStatus& status, DeviceParameter parameter,
                       const char* tip) {
  Ui& ui = scene.ui;
  const state::DeviceParameterInfo& row_info = state::info_of(parameter);
  const std::string field_name = std::string("devices/set/") + row_info.name;
  math::Vec3 value = state::value_of(status, parameter);
  row(ui, row_info.name);
  tool_tip(tip);
  const bool changed = row_info.by_axis
                           ? vector_field(ui, field_name, &value, row_info.min, row_info.max, "%.4g")
                           : number_field(ui, field_name, &value.x, row_info.min, row_info.max, "%.4g", 90.0F);
  if (!row_info.by_axis) {
    ImGui::SameLine();
    ImGui::TextColored(ui.muted, "%s", row_info.unit);
  }
  if (changed) scene.model.devices.set(chosen_, parameter, value);
}

void DevicesTab::draw_choices(PanelScene& scene, const state::DeviceStatus& status) {
  Ui& ui = scene.ui;
  if (!begin_rows("choices")) return;
  row(ui, "mode");
  ImGui::SetNextItemWidth(ui.points(150.0F));
  if (ImGui::BeginCombo("##mode", state::name_of(status.mode))) {
    for (unsigned i = 0; i < static_cast<unsigned>(state::DeviceMode::count); ++i) {
      const auto mode = static_cast<state::DeviceMode>(i);
      if (ImGui::Selectable(state::name_of(mode), mode == status.mode))
        scene.model.devices.set(chosen_, DeviceParameter::mode, {static_cast<double>(i), 0.0, 0.0});
      note(ui, std::string("devices/mode/") + state::name_of(mode));
    }
    ImGui::EndCombo();
  }
  note(ui, "devices/mode");
  row(ui, "scheme");
  tool_tip("of two devices that share a tool: who moves it, who feels it; S symmetric, A asymmetric, N none");
  ImGui::SetNextItemWidth(ui.points(150.0F));
  if (ImGui::BeginCombo("##scheme", state::name_of(status.scheme))) {
    for (unsigned i = 0; i < static_cast<unsigned>(state::SharingScheme::count); ++i) {
      const auto scheme = static_cast<state::SharingScheme>(i);
      if (ImGui::Selectable(state::name_of(scheme), scheme == status.scheme))
        scene.model.devices.set(chosen_, DeviceParameter::scheme, {static_cast<double>(i), 0.0, 0.0});
      note(ui, std::string("devices/scheme/") + state::name_of(scheme));
    }
    ImGui::EndCombo();
  }
  note(ui, "devices/scheme");
  row(ui, "rotations by");
  int rotation = static_cast<int>(status.rotation);
  ImGui::SetNextItemWidth(ui.points(150.0F));
  if (ImGui::Combo("##rotation", &rotation, kRotations, 2))
    scene.model.devices.set(chosen_, DeviceParameter::rotation_reference, {static_cast<double>(rotation), 0.0, 0.0});
  note(ui, "devices/rotation");
  field(scene, status, DeviceParameter::dominance, "0.5: gains as in the file; 1: twice them, 0: none");
  field(scene, status, DeviceParameter::workspace_scaling, "the tool's metres for each of the hand");
  field(scene, status, DeviceParameter::camera_scaling, "the camera's metres for each of the hand");
  end_rows();
}

void DevicesTab::draw(PanelScene& scene) {
  Ui& ui = scene.ui;
  DeviceActions& devices = scene.model.devices;
  bool forces = devices.forces();
  if (check_box(ui, "devices/forces", "Forces of all hands", &forces)) devices.set_forces(forces);
  tool_tip("-e true switches them on at the start; Ctrl+E in any window");
  if (!forces) {
    ImGui::SameLine();
    ImGui::TextColored(ui.warning, "forces off");
  }
  draw_table(scene);
  chosen_ = std::min(chosen_, devices.count() - 1);
  const std::shared_ptr<const state::DeviceInfo> info = devices.info(chosen_);
  const state::DeviceStatus status = devices.status(chosen_);
  heading(ui, info->name.c_str());
  ImGui::PushID(static_cast<int>(chosen_));
  if (section(ui, "State", true)) draw_state(scene, *info, status);
  if (section(ui, "Hand and tool", true)) draw_choices(scene, status);
  if (section(ui, "Gains of the tool", true) && begin_rows("tool")) {
    field(scene, status, DeviceParameter::linear_stiffness, "N/m, by axis of the world");
    field(scene, status, DeviceParameter::linear_damping, "N s/m, by axis of the world");
    field(scene, status, DeviceParameter::angular_stiffness, "N m/rad, by axis of the tool");
    field(scene, status, DeviceParameter::angular_damping, "N m s/rad, by axis of the tool");
    end_rows();
  }
  if (section(ui, "Gains of the hand", true) && begin_rows("hand")) {
    field(scene, status, DeviceParameter::haptic_linear, "N/m, by axis of the world");
    field(scene, status, DeviceParameter::haptic_linear_damping, "N s/m, by axis of the world");
    field(scene, status, DeviceParameter::haptic_angular, "N m/rad, by axis of the tool");
    field(scene, status, DeviceParameter::haptic_angular_damping, "N m s/rad, by axis of the tool");
    end_rows();
  }
  if (section(ui, "Limits of the hand's force", false) && begin_rows("limits")) {
    field(scene, status, DeviceParameter::deadband, "forces below it are not felt");
    field(scene, status, DeviceParameter::max_force, "0: the hardware's own");
    field(scene, status, DeviceParameter::max_torque, "0: the hardware's own");
    field(scene, status, DeviceParameter::max_jerk, "how fast a force may change; 0: no bound");
    end_rows();
  }
  if (section(ui, "Times", false)) draw_times(scene, status);
  ImGui::PopID();
}

}  // namespace

std::unique_ptr<PanelTab> make_devices_tab() { return std::make_unique<DevicesTab>(); }

}  // namespace ambf::render
