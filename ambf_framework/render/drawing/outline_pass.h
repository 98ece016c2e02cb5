// Outlines of bodies, over everything drawn so far: a mask of the bodies, then a line along its edge. Works only in the
// rectangle of the picture that the bodies cover, and compiles its programs when first used. One a context. Main
// thread, context current. Private to render/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/drawing/mesh_instancer.h"
#include "render/drawing/shared_store.h"
#include "render/gl/canvas.h"
#include "render/gl/full_screen.h"
#include "render/gl/program.h"

namespace ambf::render {

class OutlinePass {
 public:
  explicit OutlinePass(const Gl& gl) : gl_(gl), meshes_(gl), screen_(gl), mask_(gl) {}

  struct Bodies {
    const std::vector<std::uint32_t>& outlined;  // slots
    const std::vector<BodyLook>& looks;          // by slot; hidden bodies have no outline
    const std::vector<math::Pose>& T_world_body;
  };
  // A line of `width_px` around each body on `canvas`, seen by `camera`. Leaves the canvas bound. False with the reason
  // in `why`.
  bool draw(SharedStore& shared, const Bodies& bodies, const Camera& camera, double width_px, Canvas& canvas,
            std::string& why);

 private:
  struct Rectangle {
    int left, bottom, width, height;
  };
  bool build(std::string& why);
  void choose(const SceneBatches& scene, const Bodies& bodies, const Camera& camera, const Mat4& world_to_clip);
  Rectangle covered(const Mat4& world_to_clip, double margin_px, int width, int height) const;

  const Gl& gl_;
  bool built_ = false;
  Program mask_program_, edge_program_;
  MeshInstancer meshes_;
  FullScreenTriangle screen_;
  Layer mask_;
  DrawList list_;
  std::vector<DrawCommand> chosen_;
  std::vector<Sphere> bounds_world_;  // of what is chosen
};

}  // namespace ambf::render
