#include "render/drawing/detail/occlusion.h"

#include <algorithm>
#include <cmath>

namespace ambf::render {

namespace {

// How far corners reach: a part of what the picture is high at the distance of what is looked at.
constexpr double kReach = 0.06, kLeast_m = 0.004, kMost_m = 0.15;

float f(double x) { return static_cast<float>(x); }

}  // namespace

void Occlusion::apply(Programs& programs, const FullScreenTriangle& screen, const Camera& camera, Canvas& canvas) {
  const bool parallel = camera.orthographic_width_m > 0.0;
  const double aspect = static_cast<double>(canvas.width()) / canvas.height();
  const PicturePlane seen = picture_plane(camera, aspect);
  // Close-ups have a near far plane, overviews a far one.
  const double reach_m =
      std::clamp(kReach * seen.half_width * (parallel ? 1.0 : 0.3 * camera.far_m), kLeast_m, kMost_m);
  const auto prepare = [&](Program& program) {
    program.use();
    program.set("depth", 0);
    program.set("occlusion", 1);
    program.set("lens", f(camera.near_m), f(camera.far_m), f(seen.half_width), f(seen.half_height));
    program.set("middle", f(seen.middle_right), f(seen.middle_up), f(seen.slant));
    program.set("parallel", parallel ? 1.0F : 0.0F);
    program.set("radius_m", f(reach_m));
  };
  const GLuint depth = canvas.depth_texture();
  layer_.resize(std::max(canvas.width() / 2, 1), std::max(canvas.height() / 2, 1), false);
  layer_.bind();
  gl_.Disable(GL_DEPTH_TEST);
  gl_.DepthMask(GL_FALSE);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, depth);
  prepare(programs.occlusion());
  screen.draw();

  canvas.bind();
  gl_.ActiveTexture(GL_TEXTURE0 + 1);
  gl_.BindTexture(GL_TEXTURE_2D, layer_.color());
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ZERO, GL_SRC_COLOR);
  prepare(programs.occlusion_blur());
  screen.draw();
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthMask(GL_TRUE);
}

}  // namespace ambf::render
