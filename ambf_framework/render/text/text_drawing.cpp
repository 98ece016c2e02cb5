#include "render/text/text_drawing.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <utility>

namespace ambf::render {

namespace {

constexpr double kCorner_px = 6.0;  // radius at scale 1
// An index of Dear ImGui's has 16 bits: a list ends well before, so that one more text always fits.
constexpr int kMaxVertices = 40'000;
constexpr std::size_t kMaxLetters = 4'000;  // of one text: more than any picture is wide

ImU32 color_of(const TextColor& color) {
  return ImGui::ColorConvertFloat4ToU32({color[0], color[1], color[2], color[3]});
}
ImVec2 at(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }

}  // namespace

TextDrawing::TextDrawing(std::shared_ptr<const Lettering> letters, int width_px, int height_px)
    : letters_(std::move(letters)), width_(width_px), height_(height_px) {}

TextDrawing::~TextDrawing() = default;

ImDrawList& TextDrawing::list() {
  if (lists_.empty() || lists_.back()->VtxBuffer.Size > kMaxVertices) {
    lists_.push_back(std::make_unique<ImDrawList>(&letters_->shared()));
    lists_.back()->_ResetForNewFrame();
    lists_.back()->PushClipRect({0.0F, 0.0F}, at(width_, height_));
  }
  return *lists_.back();
}

void TextDrawing::text(double x_px, double y_px, const std::string& line, const TextColor& color, double scale) {
  const auto size = static_cast<float>(Lettering::line_height(scale));
  const char* begin = line.data();
  list().AddText(nullptr, size, at(x_px, y_px), color_of(color), begin, begin + std::min(line.size(), kMaxLetters));
}

void TextDrawing::card(double x_px, double y_px, double width_px, double height_px, const TextColor& color,
                       double scale) {
  list().AddRectFilled(at(x_px, y_px), at(x_px + width_px, y_px + height_px), color_of(color),
                       static_cast<float>(kCorner_px * scale));
}

}  // namespace ambf::render
