#include "render/overlay.h"

#include <algorithm>

#include "render/font.h"

namespace ambf::render {

void draw_overlay(const OverlayText& text, int width_px, int height_px, FlatDrawing& drawing) {
  constexpr FlatColor kPaper = {0.10F, 0.12F, 0.15F, 0.82F}, kInk = {0.95F, 0.96F, 0.97F, 1.0F};
  constexpr double kMargin = 10.0, kLine = kGlyphHeight;
  const auto width_of = [](const std::vector<std::string>& lines) {
    std::size_t widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, glyph_count(line));
    return static_cast<double>(widest) * kGlyphWidth + 2 * kMargin;
  };
  const auto box = [&](double left, double top, const std::vector<std::string>& lines) {
    drawing.rectangle(left, top, width_of(lines), static_cast<double>(lines.size()) * kLine + 2 * kMargin, kPaper);
    double y = top + kMargin;
    for (const std::string& line : lines) {
      drawing.text(left + kMargin, y, line, kInk);
      y += kLine;
    }
  };
  double bottom = height_px - kMargin;
  for (auto line = text.labels.rbegin(); line != text.labels.rend(); ++line) {
    const double width = static_cast<double>(glyph_count(*line)) * kGlyphWidth;
    bottom -= kLine;
    drawing.text((width_px - width) / 2, bottom, *line, kInk);
  }
  if (!text.help.empty()) box(kMargin, kMargin, text.help);
  if (text.messages.empty()) return;
  const double tall = static_cast<double>(text.messages.size()) * kLine + 2 * kMargin;
  // Beside the help.
  const double left = text.help.empty() ? kMargin : width_px - width_of(text.messages) - kMargin;
  box(left, height_px - tall - kMargin, text.messages);
}

}  // namespace ambf::render
