// Paints structures and poses on a canvas. One for each OpenGL context: it holds what contexts
// cannot share (framebuffers, vertex arrays), the rest is in the SharedStore. The windows and the pictures without a
// display are both painted by it, and so agree. Main thread (or whichever thread owns the context); its own context
// must be current in every call, construction and destruction included. Private to render/.
#pragma once

#include <string>
#include <vector>

#include "render/drawing/outline_pass.h"
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
  Extras extras;           // its text only where the resolution is full: else it is drawn over what shows the picture
  double line_px = 2.0;    // width of the outline
  const ShaderPair* all_bodies_shader =
      nullptr;  // ADF's `preprocessing shaders`: instead of each body's own, before black
};

class PictureComposer {
 public:
  PictureComposer(const Gl& gl, SharedStore& shared)
      : shared_(shared), renderer_(gl, shared), outline_(gl), debug_(gl), text_(gl), canvas_(gl), shadow_target_(gl) {}
  bool build(std::string& why) { return text_.build(why); }

  // Of what the SharedStore took last. False with the reason in `why`.
  bool paint(const PictureJob& job, std::string& why);
  // Whether the canvas shows what `job` asks for already, at whatever quality: nothing has moved by more than can be
  // seen, and nothing is drawn over the scene.
  bool shows(const PictureJob& job) const;
  // Over what the bound framebuffer shows.
  void draw_over(const TextDrawing& drawing) { text_.draw(drawing); }

  Canvas& canvas() { return canvas_; }
  std::size_t instances_drawn() const { return renderer_.instances_drawn(); }

 private:
  SharedStore& shared_;
  SceneRenderer renderer_;
  OutlinePass outline_;
  WorldShapesRenderer debug_;
  TextRenderer text_;
  Canvas canvas_;
  GlFramebuffer shadow_target_;

  // What the last picture was made of.
  struct Painted {
    std::uint64_t structure_version = 0, looks_version = 0;
    ScenePoses poses;
    Camera camera;
    int width = 0, height = 0;
    bool normal_maps = false, multipass = false, plain = false;  // plain: nothing was drawn over the scene
    std::vector<std::uint32_t> outlined;
    std::vector<BodyLook> looks;
  };
  Painted painted_;
};

}  // namespace ambf::render
