// Paints structures and poses on a canvas. One for each OpenGL context: it holds what contexts
// cannot share (framebuffers, vertex arrays), the rest is in the SharedStore. The windows and the pictures without a
// display are both painted by it, and so agree. Main thread (or whichever thread owns the context); its own context
// must be current in every call, construction and destruction included. Private to render/.
#pragma once

#include <string>
#include <vector>

#include "render/drawing/scene_renderer.h"
#include "render/drawing/shared_store.h"
#include "render/gl/canvas.h"
#include "render/marks/world_shapes_renderer.h"
#include "render/pictures/extras.h"
#include "render/scene/motion.h"
#include "render/scene/quality.h"
#include "render/text/text_renderer.h"

namespace ambf::render {

struct PictureJob {
  const state::Structure* structure = nullptr;
  // Windows painted in one turn should be given the same: shadows are then drawn once.
  const ScenePoses* poses = nullptr;
  Camera camera;
  int width = 0, height = 0;  // px
  Quality quality;
  bool normal_maps = true;
  bool multipass = false;  // ADF's key of cameras: transparent things that cross each other are seen right
  Extras extras;
  const ShaderPair* all_bodies_shader =
      nullptr;  // ADF's `preprocessing shaders`: instead of each body's own, before black
};

class PictureComposer {
 public:
  PictureComposer(const Gl& gl, SharedStore& shared)
      : shared_(shared), renderer_(gl, shared), debug_(gl), text_(gl), canvas_(gl), shadow_target_(gl) {}
  bool build(std::string& why) { return text_.build(why); }

  // Of what the SharedStore took last. False with the reason in `why`.
  bool paint(const PictureJob& job, std::string& why);
  // Over what the bound framebuffer shows.
  void draw_over(const TextDrawing& drawing) { text_.draw(drawing); }

  Canvas& canvas() { return canvas_; }
  std::size_t instances_drawn() const { return renderer_.instances_drawn(); }

 private:
  SharedStore& shared_;
  SceneRenderer renderer_;
  WorldShapesRenderer debug_;
  TextRenderer text_;
  Canvas canvas_;
  GlFramebuffer shadow_target_;
};

}  // namespace ambf::render
