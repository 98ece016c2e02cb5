#include "render/window/overlay.h"

#include <algorithm>
#include <cmath>

namespace ambf::render {

namespace {

constexpr TextColor kPaper = {0.07F, 0.09F, 0.12F, 0.80F}, kThinPaper = {0.07F, 0.09F, 0.12F, 0.42F};
constexpr TextColor kInk = {0.93F, 0.95F, 0.97F, 1.0F}, kAccent = {0.55F, 0.80F, 1.0F, 1.0F};
constexpr double kMargin = 12.0, kPad = 10.0, kColumnGap = 28.0, kNameGap = 14.0;  // px at scale 1
constexpr double kSmallest = 0.6;  // scale of letters that can still be read

class Overlay {
 public:
  Overlay(double scale, TextDrawing& drawing)
      : width_(drawing.width()),
        height_(drawing.height()),
        scale_(scale),
        margin_(std::round(kMargin * scale)),
        pad_(std::round(kPad * scale)),
        line_(std::round(1.15 * Lettering::line_height(scale))),
        drawing_(drawing) {}

  // In the middle of the lower edge: quiet, it is always there.
  void labels(const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    double widest = 0.0;
    for (const std::string& line : lines) widest = std::max(widest, width_of(line));
    // Wider steps than the digits change it by, so that the card does not tremble.
    const double step = 24.0 * scale_;
    const double wide = std::ceil(widest / step) * step + 2 * pad_;
    const double tall = static_cast<double>(lines.size()) * line_ + pad_;
    const double left = std::round((width_ - wide) / 2), top = height_ - tall - std::round(margin_ / 2);
    drawing_.card(left, top, wide, tall, kThinPaper, scale_);
    double y = top + std::round(pad_ / 2);
    for (const std::string& line : lines) {
      drawing_.text(std::round((width_ - width_of(line)) / 2), y, line, kInk, scale_);
      y += line_;
    }
    above_labels_ = top;
  }

  // Lower left (beside the help: right), above the labels where the window is too narrow for both side by side.
  void messages(const std::vector<std::string>& lines, bool right) {
    if (lines.empty()) return;
    double widest = 0.0;
    for (const std::string& line : lines) widest = std::max(widest, width_of(line));
    const double wide = widest + 2 * pad_, tall = static_cast<double>(lines.size()) * line_ + 2 * pad_;
    const bool beside = margin_ + wide < 0.5 * width_ - 12.0 * line_;
    const double bottom = beside ? height_ - std::round(margin_ / 2) : std::min(above_labels_, height_) - margin_;
    const double left = right ? width_ - wide - margin_ : margin_;
    drawing_.card(left, bottom - tall, wide, tall, kPaper, scale_);
    double y = bottom - tall + pad_;
    for (const std::string& line : lines) {
      drawing_.text(left + pad_, y, line, kInk, scale_);
      y += line_;
    }
  }

  // False when it does not fit in.
  bool help(const std::vector<HelpLine>& table) {
    const auto room = static_cast<std::size_t>(std::max(4.0, (height_ - 2 * margin_ - 2 * pad_) / line_));
    const std::size_t columns = (table.size() + room - 1) / room;
    const std::size_t rows = (table.size() + columns - 1) / columns;
    struct Column {
      double name = 0.0, text = 0.0;
    };
    std::vector<Column> widths(columns);
    for (std::size_t i = 0; i < table.size(); ++i) {
      Column& column = widths[i / rows];
      column.name = std::max(column.name, width_of(table[i].name));
      column.text = std::max(column.text, width_of(table[i].text));
    }
    double wide = 2 * pad_ + static_cast<double>(columns - 1) * kColumnGap * scale_;
    for (const Column& column : widths) wide += column.name + kNameGap * scale_ + column.text;
    if (wide + 2 * margin_ > width_ && scale_ > kSmallest) return false;
    drawing_.card(margin_, margin_, wide, static_cast<double>(rows) * line_ + 2 * pad_, kPaper, scale_);
    double x = margin_ + pad_;
    for (std::size_t i = 0; i < table.size(); ++i) {
      if (i > 0 && i % rows == 0) {
        const Column& before = widths[i / rows - 1];
        x += before.name + (kNameGap + kColumnGap) * scale_ + before.text;
      }
      const double y = margin_ + pad_ + static_cast<double>(i % rows) * line_;
      drawing_.text(x, y, table[i].name, kAccent, scale_);
      drawing_.text(x + widths[i / rows].name + kNameGap * scale_, y, table[i].text, kInk, scale_);
    }
    return true;
  }

 private:
  double width_of(const std::string& line) const { return drawing_.letters()->width(line, scale_); }

  double width_, height_, scale_, margin_, pad_, line_;
  double above_labels_ = 1e9;
  TextDrawing& drawing_;
};

}  // namespace

void draw_overlay(const OverlayText& text, TextDrawing& drawing) {
  double scale = drawing.letters()->scale();
  Overlay overlay(scale, drawing);
  overlay.labels(text.labels);
  overlay.messages(text.messages, !text.help.empty());
  if (text.help.empty()) return;
  while (!Overlay(scale, drawing).help(text.help)) scale *= 0.9;  // smaller rather than cut off
}

}  // namespace ambf::render
