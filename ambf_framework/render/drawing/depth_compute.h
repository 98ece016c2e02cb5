// Points of a depth picture by a user's shaders (`depth compute shaders`) instead of from what DepthPass measures:
// they read the depth buffer and say for each pixel where its point is (docs/rendering.md). One a context. The
// context's thread. Private to render/.
#pragma once

#include <string>

#include "render/camera/camera.h"
#include "render/gl/handle.h"
#include "render/shaders/user_shaders.h"

namespace ambf::render {

class DepthCompute {
 public:
  explicit DepthCompute(const Gl& gl);

  // Leaves the result bound for reading: GL_RGBA, GL_FLOAT; x right, y up, z backwards from the camera in m, then
  // whether there is a point at all. False with the reason in `why`.
  bool draw(UserProgram& user, GLuint depth_texture, const Camera& camera, int width, int height, std::string& why);

 private:
  bool resize(int width, int height, std::string& why);

  const Gl& gl_;
  GlVertexArray vertex_array_;
  GlBuffer corners_;
  GlFramebuffer framebuffer_;
  GlRenderbuffer points_;
  int width_ = 0, height_ = 0;
};

}  // namespace ambf::render
