// Scenes in, pictures out: draws what a camera sees into the framebuffer that is bound. Knows no windows, no physics, no control. One a
// context; what contexts share comes from the SharedStore. Main thread. Private to render/.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "render/flat_drawing.h"
#include "render/gl/program.h"
#include "render/lights.h"
#include "render/mesh_drawing.h"
#include "render/shared_store.h"

namespace ambf::render {

struct Picture {
  Camera camera;
  int width = 0, height = 0;  // px
  const std::vector<math::Pose>* T_world_body = nullptr;
  const std::vector<Light>* lights = nullptr;
  bool soft_shadows = true;
  Tint tint;
  const FlatDrawing* marks = nullptr;  // over everything
};

class SceneRenderer {
 public:
  SceneRenderer(const Gl& gl, SharedStore& shared)
      : gl_(gl), shared_(shared), meshes_(gl), flat_array_(gl), flat_(gl) {}
  bool build(std::string& why);  // compiles the shaders; false with the compiler's words

  void draw(const Picture& picture);
  MeshDrawing& meshes() { return meshes_; }
  std::size_t instances_drawn() const { return list_.instances.size(); }  // in the last picture

 private:
  void use_variant(const Picture& picture, const MeshVariant& variant);
  void set_picture(const Picture& picture, Program& program);
  void set_surface(const Surface& surface);
  void draw_background(const Camera& camera, double aspect);
  void draw_flat(const FlatDrawing& drawing);
  void make_font();

  const Gl& gl_;
  SharedStore& shared_;
  Program* variant_ = nullptr;         // in use
  std::set<const Program*> prepared_;  // know the lights and camera of this picture
  Program flat_program_;
  MeshDrawing meshes_;
  GlVertexArray flat_array_;
  GlBuffer flat_;
  GlTexture font_;
  DrawList list_;
  Mat4 world_to_clip_;
};

}  // namespace ambf::render
