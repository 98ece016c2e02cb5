// One entry a joint: where it is, where it is wanted, and a slider or field that commands it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi, kMillimetres = 1000.0;

bool slides(const state::JointInfo& joint) {
  return joint.type == state::JointType::prismatic || joint.type == state::JointType::linear_spring;
}

struct Drafts {
  std::string search;
  // By joint: of those that show a velocity or effort field instead of the position slider.
  std::map<std::uint64_t, state::JointCommandType> modes;
  std::map<std::uint64_t, double> values;
};

struct Units {
  double factor = 1.0;  // shown = factor * SI
  const char* position = "rad";
  const char* velocity = "rad/s";
  const char* effort = "Nm";
};

Units units_of(const state::JointInfo& joint, bool degrees) {
  if (slides(joint)) {
    return degrees ? Units{kMillimetres, "mm", "mm/s", "N"} : Units{1.0, "m", "m/s", "N"};
  }
  return degrees ? Units{kDegrees, "\u00b0", "\u00b0/s", "Nm"} : Units{};
}

std::uint64_t key_of(state::ObjectId id) { return (std::uint64_t{id.generation} << 32) | id.index; }

// Where it is and, when it is commanded, the command.
std::string text_of(const state::JointState& joint, const Units& units, bool commanded) {
  const int digits = units.factor > 1.0 ? 2 : 4;
  const auto clean = [&](double value) { return std::abs(value) < 5e-5 ? 0.0 : value * units.factor; };
  char text[120];
  if (!commanded) {
    std::snprintf(text, sizeof text, "%.*f %s", digits, clean(joint.position), units.position);
  } else if (joint.commanded_type == state::JointCommandType::position) {
    std::snprintf(text, sizeof text, "%.*f, wanted %.*f %s", digits, clean(joint.position), digits,
                  clean(joint.commanded), units.position);
  } else {
    const bool velocity = joint.commanded_type == state::JointCommandType::velocity;
    std::snprintf(text, sizeof text, "%.*f %s, at %.4g %s", digits, clean(joint.position), units.position,
                  velocity ? clean(joint.commanded) : joint.commanded, velocity ? units.velocity : units.effort);
  }
  return text;
}

// The slider, with a mark where the joint really is.
void draw_position(PanelScene& scene, std::uint32_t slot, const Units& units, float width) {
  Ui& ui = scene.ui;
  const state::JointInfo& info = scene.model.structure().joints[slot];
  const state::JointState& joint = scene.model.frame().joints[slot];
  const auto held = scene.model.held.held(scene.model.structure(), slot);
  const bool target = joint.commanded_type == state::JointCommandType::position;
  double lower = info.lower, upper = info.upper;
  if (!info.has_limits) {
    const double reach = slides(info) ? 0.5 : std::numbers::pi;
    lower = std::min(-reach, joint.position);
    upper = std::max(reach, joint.position);
  }
  double shown = (held && held->type == state::JointCommandType::position ? held->value
                  : target                                                ? joint.commanded
                                                                          : joint.position) *
                 units.factor;
  const double least = lower * units.factor, most = upper * units.factor;
  const std::string name = "joint/" + info.name;
  ImGui::SetNextItemWidth(width);
  // The number stands above, beside the measured one.
  const bool moved = ImGui::SliderScalar("##position", ImGuiDataType_Double, &shown, &least, &most, "",
                                         ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat);
  note(ui, name);
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  const auto part = static_cast<float>(std::clamp((joint.position - lower) / std::max(upper - lower, 1e-9), 0.0, 1.0));
  // The middle of ImGui's knob goes from here to as far from the other end.
  const float inset = 2.0F + 0.5F * ImGui::GetStyle().GrabMinSize;
  const float x = a.x + inset + (b.x - a.x - 2.0F * inset) * part;
  ImGui::GetWindowDrawList()->AddRectFilled({x - ui.points(1.0F), a.y}, {x + ui.points(1.0F), b.y},
                                            ImGui::ColorConvertFloat4ToU32(ui.good));
  char range[96];
  std::snprintf(range, sizeof range, "%s%.4g to %.4g %s", info.has_limits ? "" : "no limits; shown: ", least, most,
                units.position);
  tool_tip(range);
  if (moved) scene.model.hold_joint(slot, {state::JointCommandType::position, shown / units.factor});
}

void draw_number(PanelScene& scene, Drafts& drafts, std::uint32_t slot, const Units& units,
                 state::JointCommandType mode, float width) {
  const state::JointInfo& info = scene.model.structure().joints[slot];
  const double factor = mode == state::JointCommandType::velocity ? units.factor : 1.0;
  double& value = drafts.values[key_of(scene.model.structure().objects[info.object].id)];
  if (const auto held = scene.model.held.held(scene.model.structure(), slot); held && held->type == mode) {
    value = held->value;
  }
  double shown = value * factor;
  constexpr double kMost = 1e6;
  const std::string name = "joint/" + info.name + (mode == state::JointCommandType::velocity ? "/velocity" : "/effort");
  if (number_field(scene.ui, name, &shown, -kMost, kMost, "%.4g", width / scene.ui.scale)) {
    value = shown / factor;
    scene.model.hold_joint(slot, {mode, value});
  }
}

void draw_joint(PanelScene& scene, Drafts& drafts, std::uint32_t slot) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const state::Structure& all = model.structure();
  const state::JointInfo& info = all.joints[slot];
  const state::ObjectInfo& object = all.objects[info.object];
  const state::JointState& joint = model.frame().joints[slot];
  const Units units = units_of(info, model.settings.degrees);
  const auto held = model.held.held(all, slot);
  ImGui::PushID(static_cast<int>(info.object));

  if (ImGui::Selectable(object.local_name.c_str(), model.selection.id() == object.id,
                        ImGuiSelectableFlags_AllowItemOverlap)) {
    model.selection.select(object.id);
  }
  tool_tip(object.name.c_str());
  const bool commanded = is_commanded(joint);
  const std::string value = text_of(joint, units, commanded);
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x);
  ImGui::TextColored(held ? ui.accent : commanded ? ui.warning : ui.muted, "%s", value.c_str());
  tool_tip(held ? "held by this panel" : commanded ? "commanded by somebody else" : "measured");

  auto& modes = drafts.modes;
  auto found = modes.find(key_of(object.id));
  state::JointCommandType mode = found == modes.end() ? state::JointCommandType::position : found->second;
  ImGui::SetNextItemWidth(ui.points(92.0F));
  constexpr const char* kModes[] = {"Effort", "Position", "Velocity"};
  int chosen = static_cast<int>(mode);
  if (ImGui::Combo("##mode", &chosen, kModes, 3)) {
    modes[key_of(object.id)] = mode = static_cast<state::JointCommandType>(chosen);
  }
  note(ui, "joint/" + info.name + "/mode");
  ImGui::SameLine();
  const float side = ImGui::GetFrameHeight() * 1.15F, gap = ImGui::GetStyle().ItemSpacing.x;
  const char* unit = mode == state::JointCommandType::velocity ? units.velocity
                     : mode == state::JointCommandType::effort ? units.effort
                                                               : "";
  const float unit_width = *unit == '\0' ? 0.0F : ImGui::CalcTextSize(unit).x + gap;
  const float width = ImGui::GetContentRegionAvail().x - 2.0F * side - 2.0F * gap - unit_width;
  if (mode == state::JointCommandType::position) {
    draw_position(scene, slot, units, width);
  } else {
    draw_number(scene, drafts, slot, units, mode, width);
    ImGui::SameLine();
    ImGui::TextColored(ui.muted, "%s", unit);
  }
  ImGui::SameLine();
  plot_sign(scene, object.name,
            {mode == state::JointCommandType::velocity ? "velocity"
             : mode == state::JointCommandType::effort ? "effort"
                                                       : "position"},
            ImGui::GetFrameHeight());
  ImGui::SameLine();
  if (icon_button(ui, "joint/" + info.name + "/release", Icon::close, "Let go of it", held.has_value())) {
    model.held.release(all, slot);
  }
  ImGui::PopID();
}

const char* name_of_model(const state::Structure& all, state::ModelId id) {
  for (const state::ModelInfo& info : all.models) {
    if (info.id == id && id != state::kWorldModel) return info.name.c_str();
  }
  return "World";
}

// Those in [begin, end) that can be seen.
void draw_some(PanelScene& scene, Drafts& drafts, const std::vector<std::uint32_t>& slots, std::size_t begin,
               std::size_t end) {
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(end - begin),
                ImGui::GetTextLineHeightWithSpacing() + ImGui::GetFrameHeightWithSpacing());
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      draw_joint(scene, drafts, slots[begin + static_cast<std::size_t>(i)]);
    }
  }
}

class JointsTab final : public PanelTab {
 public:
  const char* name() const override { return "Joints"; }
  void draw(PanelScene& scene) override;

 private:
  Drafts drafts_;
};

void JointsTab::draw(PanelScene& scene) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  check_box(ui, "joints/degrees", "\u00b0 and mm", &model.settings.degrees);
  ImGui::SameLine();
  if (button(ui, "joints/release_all", "Let go of all", model.held.any())) model.held.release_all();
  text_field(ui, "joints/search", "Search joints", &drafts_.search);
  const std::vector<std::string> words = search_words(drafts_.search);

  const state::Structure& all = model.structure();
  std::vector<std::uint32_t> shown;
  std::size_t others = 0;
  for (std::uint32_t slot = 0; slot < all.joints.size(); ++slot) {
    if (!HeldJoints::refusal(all, slot).empty()) {
      ++others;
    } else if (has_words(all.objects[all.joints[slot].object].name, words)) {
      shown.push_back(slot);
    }
  }
  ImGui::BeginChild("joints", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoBackground);
  if (shown.empty()) {
    ImGui::TextColored(ui.muted, "%s", words.empty() ? "No joint can be commanded." : "Nothing of that name");
  }
  // By model, as in the tree: two arms of one kind have joints of the same names.
  const auto model_of = [&](std::uint32_t slot) { return all.objects[all.joints[slot].object].model; };
  std::stable_sort(shown.begin(), shown.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return model_of(a) < model_of(b); });
  for (std::size_t begin = 0, end = 0; begin < shown.size(); begin = end) {
    const state::ModelId owner = model_of(shown[begin]);
    while (end < shown.size() && model_of(shown[end]) == owner) ++end;
    if (section(ui, name_of_model(all, owner), true)) draw_some(scene, drafts_, shown, begin, end);
  }
  if (others > 0) ImGui::TextColored(ui.muted, "%zu more are passive or have no single coordinate.", others);
  ImGui::EndChild();
}

}  // namespace

std::unique_ptr<PanelTab> make_joints_tab() { return std::make_unique<JointsTab>(); }

}  // namespace ambf::render
