// Draws Dear ImGui's triangles over the bound framebuffer of any of our contexts, window or not (its own renderer loads
// OpenGL in a way that only works with windows). Main thread, context current.
#pragma once

#include <string>

#include "render/gl/handle.h"
#include "render/gl/program.h"

struct ImDrawList;

namespace ambf::render {

class ImGuiRenderer {
 public:
  explicit ImGuiRenderer(const Gl& gl) : gl_(gl) {}

  bool build(std::string& why);  // false with the compiler's message
  void set_font(const unsigned char* texels, int width, int height);

  // Lists are drawn between the two. `vertex_array`: of the current context. Afterwards blending, culling and scissors
  // are off, depth tests on.
  void begin(GLuint vertex_array, float width_px, float height_px);
  void draw(const ImDrawList& list);
  void end();

 private:
  const Gl& gl_;
  Program program_;
  GlTexture font_;
  GlBuffer vertices_, indices_;
  float height_px_ = 0.0F;
};

}  // namespace ambf::render
