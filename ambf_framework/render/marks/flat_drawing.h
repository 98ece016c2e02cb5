// Lines in space and text on the picture, collected as triangles in clip coordinates: nothing depends on line widths that drivers may
// not offer. No OpenGL here (scene_renderer.h draws it). Main thread.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/gl/matrix.h"

namespace ambf::render {

using FlatColor = std::array<float, 4>;  // as displayed, alpha last

struct FlatVertex {
  std::array<float, 4> position{};  // clip coordinates
  FlatColor color{};
  std::array<float, 2> texcoord{-1.0F, -1.0F};  // negative: no glyph
};

class FlatDrawing {
 public:
  FlatDrawing(int width_px, int height_px) : width_(width_px), height_(height_px) {}

  // From a to b (world), `width_px` wide; what is behind the viewer is cut off.
  void line(const Mat4& world_to_clip, const math::Vec3& a, const math::Vec3& b, double width_px,
            const FlatColor& color);
  // The axes of a frame: x red, y green, z blue.
  void axes(const Mat4& world_to_clip, const math::Pose& T_world_frame, double length_m, double width_px);

  // Upper left corners in pixels from the upper left of the picture. `scale`: of the screen's density (font.h has the sizes); UTF-8,
  // characters beyond Latin-1 show as one '?' each.
  void text(double x_px, double y_px, const std::string& line, const FlatColor& color, double scale = 1.0);
  void rectangle(double x_px, double y_px, double width_px, double height_px, const FlatColor& color);
  // The same with round corners.
  void card(double x_px, double y_px, double width_px, double height_px, const FlatColor& color, double scale = 1.0);

  const std::vector<FlatVertex>& triangles() const { return triangles_; }
  bool empty() const { return triangles_.empty(); }

 private:
  void quad(double left, double top, double right, double bottom, const FlatColor& color,
            const std::array<float, 4>& texture_box);

  int width_, height_;
  std::vector<FlatVertex> triangles_;
};

}  // namespace ambf::render
