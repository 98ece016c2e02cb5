// Ambient occlusion from depths (screen space): corners and contacts darken a little. Half the picture's size,
// blurred, then multiplied onto what was drawn. One a context. Main thread, context current. Private to render/.
#pragma once

#include "render/camera/camera.h"
#include "render/gl/canvas.h"
#include "render/gl/full_screen.h"
#include "render/shaders/programs.h"

namespace ambf::render {

class Occlusion {
 public:
  explicit Occlusion(const Gl& gl) : gl_(gl), layer_(gl) {}

  // Darkens what was drawn on `canvas` so far, as seen by `camera`. Leaves the canvas bound and blending off.
  void apply(Programs& programs, const FullScreenTriangle& screen, const Camera& camera, Canvas& canvas);

 private:
  const Gl& gl_;
  Layer layer_;
};

}  // namespace ambf::render
