#include "render/panel/plots/plot_box.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ambf::render {

namespace {

constexpr float kFlat_points = 5.0F;  // what is dragged less far than that is not meant in that direction

ImU32 faded(ImVec4 color, float alpha) {
  color.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(color);
}

// Between pixels of the box and what they stand for.
struct Scale {
  ImVec2 a, b;
  PlotSpan time_s, range;
  float margin;

  float x_of(double time_s_) const {
    return a.x + static_cast<float>((time_s_ - time_s.from) / (time_s.to - time_s.from)) * (b.x - a.x);
  }
  float y_of(double value) const {
    const auto part = static_cast<float>((value - range.from) / (range.to - range.from));
    return b.y - margin - part * (b.y - a.y - 2.0F * margin);
  }
  double time_at(float x) const {
    return time_s.from + static_cast<double>((x - a.x) / (b.x - a.x)) * (time_s.to - time_s.from);
  }
  double value_at(float y) const {
    return range.from + static_cast<double>((b.y - margin - y) / (b.y - a.y - 2.0F * margin)) * (range.to - range.from);
  }
};

std::size_t first_from(const std::deque<double>& times, double time_s) {
  return static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), time_s) - times.begin());
}

void draw_curve(const Ui& ui, const PlotBox& box, const Scale& scale) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 color = ImGui::ColorConvertFloat4ToU32(box.color);
  // With one sample before and behind, so that the line goes on to the edges.
  std::size_t i = first_from(box.times, box.time_s.from);
  if (i > 0) --i;
  float last_x = -1e9F;
  for (; i < box.times.size(); ++i) {
    const bool behind = box.times[i] > box.time_s.to;
    if (!std::isfinite(box.values[i])) {
      draw.PathStroke(color, 0, ui.points(1.4F));
    } else if (const float x = scale.x_of(box.times[i]); x - last_x >= 0.7F || behind) {  // more could not be seen
      last_x = x;
      draw.PathLineTo({x, std::clamp(scale.y_of(box.values[i]), -1e5F, 1e5F)});
    }
    if (behind) break;
  }
  draw.PathStroke(color, 0, ui.points(1.4F));
}

// The value nearest in time to the pointer, marked and said.
void read_at_pointer(const Ui& ui, const PlotBox& box, const Scale& scale) {
  const double time_s = scale.time_at(ImGui::GetIO().MousePos.x);
  std::size_t i = first_from(box.times, time_s);
  if (i >= box.times.size() || (i > 0 && time_s - box.times[i - 1] < box.times[i] - time_s)) i = i > 0 ? i - 1 : 0;
  if (i >= box.times.size()) return;
  const float x = scale.x_of(box.times[i]);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddLine({x, scale.a.y}, {x, scale.b.y}, faded(ui.muted, 0.6F));
  if (!std::isfinite(box.values[i])) return;
  draw.AddCircleFilled({x, scale.y_of(box.values[i])}, ui.points(3.0F), ImGui::ColorConvertFloat4ToU32(box.color));
  char text[160];
  std::snprintf(text, sizeof text, "%.6g %s at %.3f s\nDrag to zoom; a double click shows all", box.values[i], box.unit,
                box.times[i]);
  tool_tip(text);
}

void draw_edges(const Ui& ui, const Scale& scale) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float size = 0.82F * ImGui::GetFontSize(), gap = ui.points(4.0F);
  // So many that the two differ in more than the last one.
  const double largest = std::max(std::abs(scale.range.from), std::abs(scale.range.to));
  const int digits = std::clamp(
      3 + static_cast<int>(std::floor(std::log10(std::max(1.0, largest / (scale.range.to - scale.range.from))))), 4,
      10);
  char text[40];
  const auto say = [&](double value, float y) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    draw.AddText(ImGui::GetFont(), size, {scale.a.x + gap, y}, faded(ui.muted, 0.9F), text);
  };
  say(scale.range.to, scale.a.y + 0.5F * gap);
  say(scale.range.from, scale.b.y - size - 0.5F * gap);
}

// Below the box: simulated seconds at round steps.
void draw_time_axis(const Ui& ui, const Scale& scale) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float size = 0.82F * ImGui::GetFontSize(), tick = ui.points(3.0F);
  const double span = scale.time_s.to - scale.time_s.from;
  const double room = std::max(2.0, static_cast<double>((scale.b.x - scale.a.x) / (6.0F * size)));  // labels
  double step = std::pow(10.0, std::floor(std::log10(span / room)));
  for (const double factor : {2.0, 2.5, 2.0}) {
    if (span / step > room) step *= factor;
  }
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)) + (step < 1.0 ? 1 : 0), 0, 6);
  for (double at = std::ceil(scale.time_s.from / step) * step; at <= scale.time_s.to; at += step) {
    const float x = std::floor(scale.x_of(at)) + 0.5F;
    draw.AddLine({x, scale.b.y}, {x, scale.b.y + tick}, faded(ui.muted, 0.6F));
    char text[32];
    std::snprintf(text, sizeof text, "%.*f s", digits, at);
    const float width = ImGui::CalcTextSize(text).x * 0.82F;
    const float left = std::clamp(x - 0.5F * width, scale.a.x, scale.b.x - width);
    draw.AddText(ImGui::GetFont(), size, {std::floor(left), scale.b.y + tick}, faded(ui.muted, 0.9F), text);
  }
}

}  // namespace

PlotSpan range_of(const std::deque<double>& times, const std::deque<double>& values, const PlotSpan& time_s) {
  double low = 1e300, high = -1e300;
  for (std::size_t i = first_from(times, time_s.from); i < times.size() && times[i] <= time_s.to; ++i) {
    if (!std::isfinite(values[i])) continue;
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  if (low > high) low = 0.0, high = 1.0;
  const double middle = 0.5 * (low + high);
  // Noise of the last digits is not blown up to a mountain range.
  const double reach = std::max({0.55 * (high - low), 1e-6, 1e-4 * std::abs(middle)});
  return {middle - reach, middle + reach};
}

PlotGesture plot_box(Ui& ui, const PlotBox& box, float height_points) {
  PlotGesture gesture;
  const float axis = ImGui::GetFontSize() + ui.points(2.0F);
  const ImVec2 size(std::max(20.0F, ImGui::GetContentRegionAvail().x),
                    std::max(ui.points(20.0F), ui.points(height_points) - axis));
  const ImVec2 a = ImGui::GetCursorScreenPos(), b(a.x + size.x, a.y + size.y);
  ImGui::InvisibleButton(box.name.c_str(), size);
  note(ui, box.name);
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive(), ended = ImGui::IsItemDeactivated();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(a, b, ImGui::GetColorU32(ImGuiCol_FrameBg), ui.points(4.0F));
  const Scale scale{a, b, box.time_s, box.range, ui.points(3.0F)};
  for (int line = 1; line < 4; ++line) {
    const float y = std::floor(a.y + size.y * static_cast<float>(line) / 4.0F) + 0.5F;
    draw.AddLine({a.x, y}, {b.x, y}, faded(ui.muted, 0.18F));
  }
  draw.PushClipRect(a, b, true);
  draw_curve(ui, box, scale);
  draw_edges(ui, scale);
  const ImGuiIO& io = ImGui::GetIO();
  if (hovered && !active) read_at_pointer(ui, box, scale);
  if ((active || ended) && ImGui::IsMouseDown(ImGuiMouseButton_Left) != ended) {
    const auto inside = [&](const ImVec2& p) { return ImVec2(std::clamp(p.x, a.x, b.x), std::clamp(p.y, a.y, b.y)); };
    const ImVec2 from = inside(io.MouseClickedPos[0]), to = inside(io.MousePos);
    const bool wide = std::abs(to.x - from.x) > ui.points(kFlat_points);
    const bool high = std::abs(to.y - from.y) > ui.points(kFlat_points);
    const ImVec2 low_corner(wide ? std::min(from.x, to.x) : a.x, high ? std::min(from.y, to.y) : a.y);
    const ImVec2 high_corner(wide ? std::max(from.x, to.x) : b.x, high ? std::max(from.y, to.y) : b.y);
    if (active && (wide || high)) {
      draw.AddRectFilled(low_corner, high_corner, faded(ui.accent, 0.22F));
      draw.AddRect(low_corner, high_corner, faded(ui.accent, 0.9F));
    }
    if (ended && wide) gesture.time_s = PlotSpan{scale.time_at(low_corner.x), scale.time_at(high_corner.x)};
    if (ended && high) gesture.range = PlotSpan{scale.value_at(high_corner.y), scale.value_at(low_corner.y)};
  }
  draw.PopClipRect();
  draw_time_axis(ui, scale);
  ImGui::Dummy({size.x, axis - ImGui::GetStyle().ItemSpacing.y});
  gesture.zoom_out = hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  return gesture;
}

}  // namespace ambf::render
