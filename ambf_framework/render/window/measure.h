// Measuring in a window: points picked on what it shows, the distance between two, the angle at the second of three.
// Points stay on the bodies they were picked on, so that what is measured goes on while these move. For the window's
// user alone. Main thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/camera/camera.h"
#include "render/scene/surface_ray.h"
#include "render/window/window_part.h"

namespace ambf::render {

class Measure {
 public:
  bool on() const { return on_; }
  void set_on(bool on);  // begins anew, or ends
  // What to do next.
  std::string hint() const;

  // While it is on: the left button picks a point, Esc ends it. True: nobody else gets it.
  bool on_input(const WindowMoment& moment, const Input& input);
  // Forgets the points when a body of theirs is gone.
  void draw(const WindowMoment& moment, WorldShapes& debug);

  // Where the points are now, up to three; less when something is gone.
  std::vector<math::Vec3> points(const state::Structure& structure, const ScenePoses& poses) const;
  // The text that stands in the scene.
  static std::string distance_text(double metres);
  static double angle_rad(const math::Vec3& a, const math::Vec3& corner, const math::Vec3& b);

 private:
  struct Point {
    state::ObjectId body;
    math::Vec3 point_body;
  };
  std::optional<SurfaceHit> under(const WindowMoment& moment, double x, double y) const;

  bool on_ = false;
  std::vector<Point> points_;
  bool pointer_here_ = false;
  double x_ = 0.0, y_ = 0.0;  // of the pointer, window units
  std::int64_t hovered_ns_ = 0;
  std::optional<SurfaceHit> hovered_;  // under the pointer, of that picture
};

}  // namespace ambf::render
