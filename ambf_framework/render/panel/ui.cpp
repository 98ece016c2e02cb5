#include "render/panel/ui.h"

#include <imgui/imgui_internal.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace ambf::render {

namespace {

ImU32 color_of(const ImVec4& color) { return ImGui::ColorConvertFloat4ToU32(color); }
ImVec4 faded(ImVec4 color, float alpha) {
  color.w *= alpha;
  return color;
}

void draw_icon(Icon icon, ImVec2 centre, float r, ImU32 color) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float thick = std::max(1.0F, r * 0.28F);
  const auto at = [&](float x, float y) { return ImVec2(centre.x + x * r, centre.y + y * r); };
  switch (icon) {
    case Icon::play: list.AddTriangleFilled(at(-0.6F, -0.85F), at(0.95F, 0.0F), at(-0.6F, 0.85F), color); break;
    case Icon::pause:
      list.AddRectFilled(at(-0.7F, -0.8F), at(-0.2F, 0.8F), color);
      list.AddRectFilled(at(0.2F, -0.8F), at(0.7F, 0.8F), color);
      break;
    case Icon::step:
      list.AddTriangleFilled(at(-0.8F, -0.8F), at(0.4F, 0.0F), at(-0.8F, 0.8F), color);
      list.AddRectFilled(at(0.45F, -0.8F), at(0.85F, 0.8F), color);
      break;
    case Icon::back:
      list.AddTriangleFilled(at(0.8F, -0.8F), at(0.8F, 0.8F), at(-0.4F, 0.0F), color);
      list.AddRectFilled(at(-0.85F, -0.8F), at(-0.45F, 0.8F), color);
      break;
    case Icon::reset:
      list.PathArcTo(centre, r * 0.8F, -0.6F, 4.4F, 20);
      list.PathStroke(color, 0, thick);
      list.AddTriangleFilled(at(0.15F, -0.55F), at(1.15F, -0.55F), at(0.8F, -1.2F), color);
      break;
    case Icon::close:
      list.AddLine(at(-0.6F, -0.6F), at(0.6F, 0.6F), color, thick);
      list.AddLine(at(-0.6F, 0.6F), at(0.6F, -0.6F), color, thick);
      break;
    case Icon::target:
      list.AddCircle(centre, r * 0.65F, color, 20, thick);
      list.AddLine(at(-1.0F, 0.0F), at(-0.35F, 0.0F), color, thick);
      list.AddLine(at(0.35F, 0.0F), at(1.0F, 0.0F), color, thick);
      list.AddLine(at(0.0F, -1.0F), at(0.0F, -0.35F), color, thick);
      list.AddLine(at(0.0F, 0.35F), at(0.0F, 1.0F), color, thick);
      break;
    case Icon::parent:
      list.AddTriangleFilled(at(-0.7F, -0.1F), at(0.7F, -0.1F), at(0.0F, -0.9F), color);
      list.AddRectFilled(at(-0.18F, -0.1F), at(0.18F, 0.9F), color);
      break;
    case Icon::copy:
      list.AddRect(at(-0.8F, -0.3F), at(0.3F, 0.9F), color, 0.0F, 0, thick);
      list.AddRect(at(-0.3F, -0.9F), at(0.8F, 0.3F), color, 0.0F, 0, thick);
      break;
    case Icon::curve:
      list.PathLineTo(at(-1.1F, 0.6F));
      list.PathBezierCubicCurveTo(at(-0.3F, 0.6F), at(-0.6F, -0.8F), at(0.0F, -0.8F));
      list.PathBezierCubicCurveTo(at(0.6F, -0.8F), at(0.3F, 0.7F), at(1.1F, 0.0F));
      list.PathStroke(color, 0, thick);
      break;
  }
}

}  // namespace

void apply_theme(Ui& ui, bool dark) {
  ui.dark = dark;
  ImGuiStyle style;
  dark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
  style.WindowRounding = 0.0F;
  style.ChildRounding = style.FrameRounding = style.PopupRounding = style.GrabRounding = 4.0F;
  style.TabRounding = 4.0F;
  style.ScrollbarRounding = 6.0F;
  style.ScrollbarSize = 10.0F;
  style.WindowBorderSize = 0.0F;
  style.ChildBorderSize = 0.0F;
  style.FrameBorderSize = dark ? 0.0F : 1.0F;
  style.WindowPadding = {12.0F, 10.0F};
  style.FramePadding = {7.0F, 3.5F};
  style.ItemSpacing = {7.0F, 5.0F};
  style.ItemInnerSpacing = {5.0F, 4.0F};
  style.CellPadding = {4.0F, 2.5F};
  style.GrabMinSize = 9.0F;
  style.IndentSpacing = 14.0F;
  ui.accent = dark ? ImVec4(0.31F, 0.64F, 0.93F, 1.0F) : ImVec4(0.10F, 0.42F, 0.74F, 1.0F);
  ui.muted = dark ? ImVec4(0.60F, 0.64F, 0.69F, 1.0F) : ImVec4(0.40F, 0.43F, 0.47F, 1.0F);
  ui.good = dark ? ImVec4(0.42F, 0.79F, 0.49F, 1.0F) : ImVec4(0.12F, 0.52F, 0.22F, 1.0F);
  ui.warning = dark ? ImVec4(0.96F, 0.73F, 0.29F, 1.0F) : ImVec4(0.70F, 0.43F, 0.00F, 1.0F);
  ui.bad = dark ? ImVec4(0.97F, 0.45F, 0.42F, 1.0F) : ImVec4(0.76F, 0.16F, 0.15F, 1.0F);
  ImVec4* c = style.Colors;
  const ImVec4 ink = dark ? ImVec4(0.92F, 0.93F, 0.95F, 1.0F) : ImVec4(0.10F, 0.11F, 0.13F, 1.0F);
  const ImVec4 paper = dark ? ImVec4(0.105F, 0.115F, 0.135F, 1.0F) : ImVec4(0.965F, 0.968F, 0.975F, 1.0F);
  const ImVec4 field = dark ? ImVec4(0.19F, 0.205F, 0.235F, 1.0F) : ImVec4(1.0F, 1.0F, 1.0F, 1.0F);
  const ImVec4 raised = dark ? ImVec4(0.235F, 0.255F, 0.295F, 1.0F) : ImVec4(0.885F, 0.895F, 0.915F, 1.0F);
  c[ImGuiCol_Text] = ink;
  c[ImGuiCol_TextDisabled] = ui.muted;
  c[ImGuiCol_WindowBg] = paper;
  c[ImGuiCol_ChildBg] = dark ? ImVec4(0.0F, 0.0F, 0.0F, 0.18F) : ImVec4(0.0F, 0.0F, 0.0F, 0.035F);
  c[ImGuiCol_PopupBg] = dark ? ImVec4(0.15F, 0.16F, 0.19F, 1.0F) : ImVec4(0.99F, 0.99F, 1.0F, 1.0F);
  c[ImGuiCol_Border] = dark ? ImVec4(0.33F, 0.35F, 0.40F, 0.6F) : ImVec4(0.70F, 0.72F, 0.76F, 0.8F);
  c[ImGuiCol_FrameBg] = field;
  c[ImGuiCol_FrameBgHovered] = dark ? ImVec4(0.23F, 0.25F, 0.29F, 1.0F) : ImVec4(0.95F, 0.97F, 1.0F, 1.0F);
  c[ImGuiCol_FrameBgActive] = dark ? ImVec4(0.25F, 0.29F, 0.35F, 1.0F) : ImVec4(0.90F, 0.94F, 1.0F, 1.0F);
  c[ImGuiCol_Button] = raised;
  c[ImGuiCol_ButtonHovered] = faded(ui.accent, 0.55F);
  c[ImGuiCol_ButtonActive] = faded(ui.accent, 0.85F);
  c[ImGuiCol_Header] = faded(ui.accent, 0.30F);
  c[ImGuiCol_HeaderHovered] = faded(ui.accent, 0.22F);
  c[ImGuiCol_HeaderActive] = faded(ui.accent, 0.45F);
  c[ImGuiCol_Tab] = ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
  c[ImGuiCol_TabHovered] = faded(ui.accent, 0.35F);
  c[ImGuiCol_TabActive] = faded(ui.accent, 0.45F);
  c[ImGuiCol_TabUnfocused] = c[ImGuiCol_Tab];
  c[ImGuiCol_TabUnfocusedActive] = c[ImGuiCol_TabActive];
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_CheckMark] = ui.accent;
  c[ImGuiCol_SliderGrabActive] = ui.accent;
  c[ImGuiCol_Separator] = c[ImGuiCol_Border];
  c[ImGuiCol_ScrollbarBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
  c[ImGuiCol_TableHeaderBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
  c[ImGuiCol_TableRowBgAlt] = dark ? ImVec4(1.0F, 1.0F, 1.0F, 0.025F) : ImVec4(0.0F, 0.0F, 0.0F, 0.025F);
  c[ImGuiCol_NavHighlight] = ui.accent;
  style.ScaleAllSizes(ui.scale);
  ImGui::GetStyle() = style;
}

void note(Ui& ui, const std::string& name) {
  if (!ImGui::IsItemVisible()) return;
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  ui.places[name] = {a.x, a.y, b.x, b.y};
}

void tool_tip(const char* text) {
  if (text == nullptr || *text == '\0' || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  // Beside what it explains, not over it: below, or above at the window's lower edge.
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float gap = 0.3F * ImGui::GetFontSize();
  const bool below = high.y + 5.0F * ImGui::GetFontSize() < ImGui::GetIO().DisplaySize.y;
  const float x = std::min(low.x, ImGui::GetIO().DisplaySize.x - 12.0F * ImGui::GetFontSize());
  ImGui::SetNextWindowPos({x, below ? high.y + gap : low.y - gap}, ImGuiCond_Always, {0.0F, below ? 0.0F : 1.0F});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0F);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool icon_button(Ui& ui, const std::string& name, Icon icon, const char* text, bool enabled) {
  const float side = ImGui::GetFrameHeight();
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(("##" + name).c_str(), {side * 1.15F, side});
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  draw_icon(icon, {0.5F * (a.x + b.x), 0.5F * (a.y + b.y)}, side * 0.26F, ImGui::GetColorU32(ImGuiCol_Text));
  ImGui::EndDisabled();
  note(ui, name);
  tool_tip(text);
  return pressed;
}

bool small_icon_button(Ui& ui, const std::string& name, Icon icon, const char* text, float side) {
  const bool pressed = ImGui::Button(("##" + name).c_str(), {side, side});
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  draw_icon(icon, {0.5F * (a.x + b.x), 0.5F * (a.y + b.y)}, side * 0.3F, ImGui::GetColorU32(ImGuiCol_Text));
  note(ui, name);
  tool_tip(text);
  return pressed;
}

bool button(Ui& ui, const std::string& name, const char* label, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button((std::string(label) + "##" + name).c_str());
  ImGui::EndDisabled();
  note(ui, name);
  return pressed;
}

bool check_box(Ui& ui, const std::string& name, const char* label, bool* on) {
  const bool pressed = ImGui::Checkbox((std::string(label) + "##" + name).c_str(), on);
  note(ui, name);
  return pressed;
}

void heading(Ui& ui, const char* text) {
  ImGui::Dummy({0.0F, ui.points(2.0F)});
  if (ui.strong != nullptr) ImGui::PushFont(ui.strong);
  ImGui::TextUnformatted(text);
  if (ui.strong != nullptr) ImGui::PopFont();
}

void muted_text(Ui& ui, const char* text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ui.muted);
  ImGui::TextWrapped("%s", text);
  ImGui::PopStyleColor();
}

bool section(Ui& ui, const char* text, bool open) {
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0.0F, 0.0F, 0.0F, 0.0F));
  if (ui.strong != nullptr) ImGui::PushFont(ui.strong);
  // The arrow stands where lines begin.
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.points(3.0F), ImGui::GetStyle().FramePadding.y});
  const bool shown = ImGui::CollapsingHeader(text, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  ImGui::PopStyleVar();
  if (ui.strong != nullptr) ImGui::PopFont();
  ImGui::PopStyleColor();
  note(ui, std::string("section/") + text);
  return shown;
}

bool begin_rows(const char* id) {
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp)) return false;
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, 0.34F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.66F);
  return true;
}
void end_rows() { ImGui::EndTable(); }

void row(Ui& ui, const char* label) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(ui.muted, "%s", label);
  ImGui::TableNextColumn();
}

void text_row(Ui& ui, const char* label, const char* format, ...) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextColored(ui.muted, "%s", label);
  ImGui::TableNextColumn();
  va_list arguments;
  va_start(arguments, format);
  ImGui::TextV(format, arguments);
  va_end(arguments);
}

void vector_row(Ui& ui, const char* label, const math::Vec3& v, const char* format, const char* unit) {
  char x[32], y[32], z[32];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  // No "-0.000".
  const auto clean = [](double value) { return std::abs(value) < 5e-5 ? 0.0 : value; };
  std::snprintf(x, sizeof x, format, clean(v.x));
  std::snprintf(y, sizeof y, format, clean(v.y));
  std::snprintf(z, sizeof z, format, clean(v.z));
#pragma GCC diagnostic pop
  text_row(ui, label, "%s  %s  %s %s", x, y, z, unit);
}

bool number_field(Ui& ui, const std::string& name, double* value, double least, double most, const char* format,
                  float width_points) {
  if (width_points > 0.0F) ImGui::SetNextItemWidth(ui.points(width_points));
  double edited = *value;
  const auto speed = static_cast<float>(std::max(1e-4, std::abs(edited) * 0.01));
  const bool moved = ImGui::DragScalar(("##" + name).c_str(), ImGuiDataType_Double, &edited, speed, &least, &most,
                                       format, ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat);
  note(ui, name);
  // What is being typed counts when it is finished: "100" is not first 1, then 10.
  if (ImGui::TempInputIsActive(ImGui::GetItemID())) {
    if (moved && std::isfinite(edited)) ui.typed[name] = edited;
    return false;
  }
  if (const auto typed = ui.typed.find(name); typed != ui.typed.end()) {
    const bool changed = typed->second != *value;
    *value = typed->second;
    ui.typed.erase(typed);
    return changed;
  }
  if (!moved || !std::isfinite(edited)) return false;
  *value = edited;
  return true;
}

bool vector_field(Ui& ui, const std::string& name, math::Vec3* value, double least, double most, const char* format) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 2.0F * gap) / 3.0F / ui.scale;
  bool changed = number_field(ui, name + "/x", &value->x, least, most, format, width);
  ImGui::SameLine(0.0F, gap);
  changed |= number_field(ui, name + "/y", &value->y, least, most, format, width);
  ImGui::SameLine(0.0F, gap);
  changed |= number_field(ui, name + "/z", &value->z, least, most, format, width);
  return changed;
}

bool text_field(Ui& ui, const std::string& name, const char* hint, std::string* text, float width_points) {
  ImGui::SetNextItemWidth(width_points > 0.0F ? ui.points(width_points) : -1.0F);
  const bool changed = ImGui::InputTextWithHint(("##" + name).c_str(), hint, text);
  note(ui, name);
  return changed;
}

void curves(Ui& ui, const char* id, const Curve* list, int count, float lowest, float highest, float height_points) {
  const ImVec2 size(std::max(20.0F, ImGui::GetContentRegionAvail().x), ui.points(height_points));
  const ImVec2 a = ImGui::GetCursorScreenPos(), b(a.x + size.x, a.y + size.y);
  ImGui::InvisibleButton(id, size);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(a, b, ImGui::GetColorU32(ImGuiCol_FrameBg), ui.points(4.0F));
  for (int line = 1; line < 4; ++line) {
    const float y = std::floor(a.y + size.y * static_cast<float>(line) / 4.0F) + 0.5F;
    draw.AddLine({a.x, y}, {b.x, y}, color_of(faded(ui.muted, 0.18F)));
  }
  if (!(highest > lowest)) highest = lowest + 1.0F;
  draw.PushClipRect(a, b, true);
  for (int c = 0; c < count; ++c) {
    const Curve& curve = list[c];
    const int room = std::max(curve.capacity, std::max(2, curve.count));
    const float step = size.x / static_cast<float>(room - 1);
    const float first = b.x - step * static_cast<float>(curve.count - 1);
    // At most one point a pixel: more could not be seen.
    const int stride = std::max(1, static_cast<int>(std::ceil(0.7F / std::max(step, 1e-6F))));
    for (int i = 0; i < curve.count; i += stride) {
      const float value = curve.values[i];
      if (!std::isfinite(value)) {
        draw.PathStroke(color_of(curve.color), 0, ui.points(1.4F));
        continue;
      }
      const float part = (value - lowest) / (highest - lowest);
      draw.PathLineTo(
          {first + step * static_cast<float>(i), b.y - ui.points(2.0F) - part * (size.y - ui.points(4.0F))});
    }
    draw.PathStroke(color_of(curve.color), 0, ui.points(1.4F));
  }
  draw.PopClipRect();
  note(ui, id);
}

ImVec4 curve_color(const Ui& ui, int i) {
  constexpr float kHues[] = {0.57F, 0.08F, 0.35F, 0.93F, 0.14F, 0.76F};
  ImVec4 color(0.0F, 0.0F, 0.0F, 1.0F);
  ImGui::ColorConvertHSVtoRGB(kHues[i % 6], ui.dark ? 0.62F : 0.85F, ui.dark ? 0.95F : 0.72F, color.x, color.y,
                              color.z);
  return color;
}

}  // namespace ambf::render
