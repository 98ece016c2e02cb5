// Draws one triangle over the whole picture with whatever program is in use, and holds textures that are drawn into.
// One a context. Main thread, context current. Private to render/.
#pragma once

#include "render/gl/handle.h"

namespace ambf::render {

class FullScreenTriangle {
 public:
  explicit FullScreenTriangle(const Gl& gl);
  void draw() const;

 private:
  const Gl& gl_;
  GlVertexArray vertex_array_;
  GlBuffer corners_;
};

// A colour texture, and a depth texture where wanted, that pictures are drawn into.
class Layer {
 public:
  explicit Layer(const Gl& gl) : gl_(gl) {}
  void resize(int width, int height, bool with_depth);
  void bind() const;  // draws go here
  GLuint color() const { return color_.name(); }
  GLuint depth() const { return depth_.name(); }

 private:
  const Gl& gl_;
  int width_ = 0, height_ = 0;
  GlTexture color_, depth_;
  GlFramebuffer framebuffer_;
};

}  // namespace ambf::render
