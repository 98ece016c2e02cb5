// Measures instead of painting: for each pixel how far along the view axis the first surface is, and whose it is.
// Exact, so without several samples a pixel, lights or blending: a transparent surface counts like any other, one
// that cannot be seen at all does not. One a context. The context's thread. Private to render/.
#pragma once

#include <string>

#include "render/drawing/mesh_instancer.h"
#include "render/gl/program.h"

namespace ambf::render {

class DepthPass {
 public:
  explicit DepthPass(const Gl& gl) : gl_(gl), meshes_(gl) {}
  bool build(std::string& why);

  // Leaves the result bound for reading: GL_RG, GL_FLOAT; m (0 where nothing is), then the body's slot + 1 (0 where
  // nothing is). False with the reason in `why`.
  bool draw(const GpuStore& store, const SceneBatches& scene, const std::vector<math::Pose>& T_world_body,
            const Camera& camera, int width, int height, std::string& why);

  // The depth buffer of what was drawn last, to be read.
  GLuint depth_texture() const { return depth_.name(); }

 private:
  bool resize(int width, int height, std::string& why);

  const Gl& gl_;
  Program program_;
  MeshInstancer meshes_;
  GlFramebuffer framebuffer_;
  GlRenderbuffer measured_;
  GlTexture depth_;
  DrawList list_;
  int width_ = 0, height_ = 0;
};

}  // namespace ambf::render
