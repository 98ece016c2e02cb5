// Text and cards behind it on one picture, collected by Dear ImGui as triangles. No OpenGL here (text_renderer.h draws
// it). Main thread.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "render/text/lettering.h"

struct ImDrawList;

namespace ambf::render {

using TextColor = std::array<float, 4>;  // as displayed, alpha last

class TextDrawing {
 public:
  TextDrawing(std::shared_ptr<const Lettering> letters, int width_px, int height_px);
  ~TextDrawing();
  TextDrawing(const TextDrawing&) = delete;
  TextDrawing& operator=(const TextDrawing&) = delete;

  // Upper left corners in pixels from the upper left of the picture. `scale`: of the screen's density. UTF-8; a
  // character that the font lacks shows as '?'.
  void text(double x_px, double y_px, const std::string& line, const TextColor& color, double scale);
  // A rectangle with round corners.
  void card(double x_px, double y_px, double width_px, double height_px, const TextColor& color, double scale);

  int width() const { return width_; }
  int height() const { return height_; }
  const std::shared_ptr<const Lettering>& letters() const { return letters_; }
  const std::vector<std::unique_ptr<ImDrawList>>& lists() const { return lists_; }

 private:
  ImDrawList& list();

  std::shared_ptr<const Lettering> letters_;
  int width_, height_;
  std::vector<std::unique_ptr<ImDrawList>> lists_;
};

}  // namespace ambf::render
