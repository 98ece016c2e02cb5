// Draws what a FlatDrawing collected over whatever the bound framebuffer holds. One a context. Main thread, context current. Private to
// render/.
#pragma once

#include <string>

#include "render/gl/handle.h"
#include "render/gl/program.h"
#include "render/marks/flat_drawing.h"

namespace ambf::render {

class FlatRenderer {
 public:
  explicit FlatRenderer(const Gl& gl) : gl_(gl), array_(gl), buffer_(gl) {}
  bool build(std::string& why);
  void draw(const FlatDrawing& drawing);

 private:
  bool make_font(std::string& why);

  const Gl& gl_;
  Program program_;
  GlVertexArray array_;
  GlBuffer buffer_;
  GlTexture font_;
};

}  // namespace ambf::render
