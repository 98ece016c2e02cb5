// How far one light sees: a depth picture from its place, made once a frame for all windows. Main thread, context current. Private to
// render/.
#pragma once

#include <string>

#include "render/gl/program.h"
#include "render/lights.h"
#include "render/mesh_drawing.h"

namespace ambf::render {

class ShadowMap {
 public:
  explicit ShadowMap(const Gl& gl) : gl_(gl) {}
  bool build(std::string& why);

  // Draws `scene` from the first of `lights` that asks for shadows. Leaves the framebuffer binding changed.
  void render(const GpuStore& store, MeshDrawing& meshes, const DrawScene& scene,
              const std::vector<math::Pose>& T_world_body, const std::vector<Light>& lights, int largest_side);
  void disable() { light_ = -1; }

  int light() const { return light_; }  // index of the light it belongs to, -1: none
  GLuint texture() const { return depth_.name(); }
  const Mat4& world_to_texture() const { return world_to_texture_; }  // clip cube moved to [0, 1]
  double texel_m() const { return texel_m_; }                         // size of a texel where the scene is
  int side() const { return side_; }

 private:
  void resize(int side);

  const Gl& gl_;
  Program program_;
  GlTexture depth_;
  GlFramebuffer framebuffer_;
  DrawList list_;
  Mat4 world_to_texture_;
  double texel_m_ = 0.0;
  int side_ = 0, light_ = -1;
};

}  // namespace ambf::render
