#include "render/window/overlay.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ambf::render {

namespace {

constexpr TextColor kThinPaper = {0.07F, 0.09F, 0.12F, 0.42F};
constexpr TextColor kThickPaper = {0.07F, 0.09F, 0.12F, 0.66F};  // users' colours stay readable on it
constexpr double kPad = 10.0;                                    // px at scale 1

class Overlay {
 public:
  Overlay(double scale, TextDrawing& drawing)
      : width_(drawing.width()),
        height_(drawing.height()),
        scale_(scale),
        margin_(std::round(kOverlayMargin_px * scale)),
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
      drawing_.text(std::round((width_ - width_of(line)) / 2), y, line, kOverlayInk, scale_);
      y += line_;
    }
    above_labels_ = top;
  }

  // In the middle of the upper edge.
  void tasks(const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    double widest = 0.0;
    for (const std::string& line : lines) widest = std::max(widest, width_of(line));
    const double step = 24.0 * scale_;  // as of labels
    const double wide = std::ceil(widest / step) * step + 2 * pad_;
    const double tall = static_cast<double>(lines.size()) * line_ + pad_;
    const double left = std::max(margin_, std::round((width_ - wide) / 2));
    const double top = std::max(below_devices_ + margin_ / 2, margin_);
    drawing_.card(left, top, wide, tall, kThickPaper, scale_);
    double y = top + std::round(pad_ / 2);
    for (const std::string& line : lines) {
      drawing_.text(left + pad_, y, line, kOverlayInk, scale_);
      y += line_;
    }
  }

  // Lower left, above the labels where the window is too narrow for both side by side.
  void messages(const std::vector<std::string>& texts) {
    std::vector<std::string> lines;
    for (const std::string& text : texts) wrap(text, width_ - 2 * (margin_ + pad_), lines);
    if (lines.empty()) return;
    double widest = 0.0;
    for (const std::string& line : lines) widest = std::max(widest, width_of(line));
    const double wide = widest + 2 * pad_, tall = static_cast<double>(lines.size()) * line_ + 2 * pad_;
    const bool beside = margin_ + wide < 0.5 * width_ - 12.0 * line_;
    const double bottom = beside ? height_ - std::round(margin_ / 2) : std::min(above_labels_, height_) - margin_;
    drawing_.card(margin_, bottom - tall, wide, tall, kOverlayPaper, scale_);
    double y = bottom - tall + pad_;
    for (const std::string& line : lines) {
      drawing_.text(margin_ + pad_, y, line, kOverlayInk, scale_);
      y += line_;
    }
  }

  // Upper left, each line in its colour.
  void devices(const std::vector<DeviceLine>& texts) {
    std::vector<DeviceLine> lines;
    double widest = 0.0;
    for (const DeviceLine& text : texts) {
      std::vector<std::string> parts;
      wrap(text.text, width_ - 2 * (margin_ + pad_), parts);
      for (std::string& part : parts) {
        widest = std::max(widest, width_of(part));
        lines.push_back({std::move(part), text.color});
      }
    }
    if (lines.empty()) return;
    const double step = 24.0 * scale_;  // as of labels
    const double wide = std::ceil(widest / step) * step + 2 * pad_;
    drawing_.card(margin_, margin_, wide, static_cast<double>(lines.size()) * line_ + pad_, kThickPaper, scale_);
    // Beside a short card there is room.
    if (margin_ + wide > 0.3 * width_) below_devices_ = margin_ + static_cast<double>(lines.size()) * line_ + pad_;
    double y = margin_ + std::round(pad_ / 2);
    for (const DeviceLine& line : lines) {
      drawing_.text(margin_ + pad_, y, line.text, line.color, scale_);
      y += line_;
    }
  }

 private:
  // Into lines that are at most so wide, at spaces; a longer word has a line of its own.
  void wrap(const std::string& text, double limit_px, std::vector<std::string>& lines) const {
    std::string line;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      const std::string longer = line.empty() ? word : line + ' ' + word;
      if (!line.empty() && width_of(longer) > limit_px) {
        lines.push_back(line);
        line = word;
      } else {
        line = longer;
      }
    }
    if (!line.empty()) lines.push_back(line);
  }
  double width_of(const std::string& line) const { return drawing_.letters()->width(line, scale_); }

  double width_, height_, scale_, margin_, pad_, line_;
  double above_labels_ = 1e9, below_devices_ = 0.0;
  TextDrawing& drawing_;
};

}  // namespace

void draw_overlay(const OverlayText& text, TextDrawing& drawing) {
  Overlay overlay(drawing.letters()->scale(), drawing);
  overlay.labels(text.labels);
  overlay.devices(text.devices);
  overlay.tasks(text.tasks);
  overlay.messages(text.messages);
}

}  // namespace ambf::render
