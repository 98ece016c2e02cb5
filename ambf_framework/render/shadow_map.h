// How far one light sees: a depth picture from its place, made once for all windows, and only when something moved. Main thread,
// context current. Private to render/.
#pragma once

#include <string>

#include "render/gl/program.h"
#include "render/lights.h"
#include "render/mesh_drawing.h"
#include "render/quality.h"

namespace ambf::render {

class ShadowMap {
 public:
  explicit ShadowMap(const Gl& gl) : gl_(gl) {}
  bool build(std::string& why);

  // What belongs to the context that is current.
  struct Context {
    const GpuStore& store;
    MeshDrawing& meshes;
    GLuint framebuffer = 0;
  };
  // Brings the map in line with where things and lights are: draws `scene` from the first of `lights` that asks for shadows, unless it
  // already shows that, or `quality` lets it lag behind. Leaves the framebuffer binding changed.
  void update(const Context& context, const DrawScene& scene, const std::vector<math::Pose>& T_world_body,
              const std::vector<Light>& lights, const Quality& quality);

  int light() const { return light_; }  // index of the light it belongs to, -1: none
  GLuint texture() const { return depth_.name(); }
  const Mat4& world_to_texture() const { return world_to_texture_; }  // clip cube moved to [0, 1]
  double texel_m() const { return texel_m_; }                         // size of a texel where the scene is
  int side() const { return side_; }

 private:
  void render(const Context& context, const DrawScene& scene, const std::vector<math::Pose>& T_world_body,
              const std::vector<Light>& lights, int largest_side);
  void resize(int side);

  const Gl& gl_;
  Program program_;
  GlTexture depth_;
  DrawList list_;
  Mat4 world_to_texture_;
  double texel_m_ = 0.0;
  int side_ = 0, light_ = -1;
  std::uint64_t shown_ = 0, seen_ = 0;  // moments: what the map shows, what was asked for last
  unsigned missed_ = 0;                 // moments since the map was drawn
};

}  // namespace ambf::render
