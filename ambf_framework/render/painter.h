// Paints structures and poses on a canvas: everything a picture needs in one OpenGL context, whoever made that. The windows and the
// pictures without a display are both painted by it, and so agree. Main thread (or whichever thread owns the context), context
// current from construction to destruction. Private to render/.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "render/canvas.h"
#include "render/gpu_store.h"
#include "render/motion.h"
#include "render/quality.h"
#include "render/scene_renderer.h"
#include "render/shadow_map.h"

namespace ambf::render {

struct PaintJob {
  const state::Structure* structure = nullptr;
  const ScenePoses* poses = nullptr;
  Camera camera;
  int width = 0, height = 0;  // px
  Quality quality;
  Tint tint;
  const FlatDrawing* marks = nullptr;
};

class Painter {
 public:
  explicit Painter(const Gl& gl) : store_(gl), renderer_(gl, store_), shadows_(gl), canvas_(gl) {}
  bool build(std::string& why);

  // Brings meshes and textures in line with `structure`; does nothing when that has not changed. Findings are about textures.
  base::Diagnostics take(const state::Structure& structure);
  // Of what was taken last. False with the reason in `why`.
  bool paint(const PaintJob& job, std::string& why);

  Canvas& canvas() { return canvas_; }
  const DrawScene& scene() const { return scene_; }
  const GpuStore& store() const { return store_; }
  std::size_t instances_drawn() const { return renderer_.instances_drawn(); }

 private:
  GpuStore store_;
  SceneRenderer renderer_;
  ShadowMap shadows_;
  Canvas canvas_;
  MeshIdentity meshes_;
  DrawScene scene_;
  bool scene_made_ = false;
  std::uint64_t pictures_ = 0;
};

}  // namespace ambf::render
