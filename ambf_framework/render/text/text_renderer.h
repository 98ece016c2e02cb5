// Draws a TextDrawing over the bound framebuffer. One for each context. Main thread, context current.
#pragma once

#include <memory>
#include <string>

#include "render/text/imgui_renderer.h"
#include "render/text/text_drawing.h"

namespace ambf::render {

class TextRenderer {
 public:
  explicit TextRenderer(const Gl& gl) : renderer_(gl), array_(gl) {}

  bool build(std::string& why) { return renderer_.build(why); }  // false with the compiler's message
  void draw(const TextDrawing& drawing);

 private:
  ImGuiRenderer renderer_;
  GlVertexArray array_;
  std::shared_ptr<const Lettering> letters_;  // whose texels the renderer has
};

}  // namespace ambf::render
