#include "render/marks/flat_drawing.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "render/marks/detail/font.h"

namespace ambf::render {

namespace {

using Clip = std::array<double, 4>;

// Texture coordinates of a part of the font's atlas.
std::array<float, 4> texture_box(int x, int y, int width, int height) {
  const auto u = [](int texel) { return static_cast<float>(texel) / static_cast<float>(kFontAtlasWidth); };
  const auto v = [](int texel) { return static_cast<float>(texel) / static_cast<float>(kFontAtlasHeight); };
  return {u(x), v(y), u(x + width), v(y + height)};
}

// Cuts the segment where it passes behind the viewer (w near 0). False when nothing is left.
bool cut(Clip& a, Clip& b) {
  constexpr double kNearest = 1e-4;
  if (a[3] < kNearest && b[3] < kNearest) return false;
  if (a[3] >= kNearest && b[3] >= kNearest) return true;
  Clip& behind = a[3] < b[3] ? a : b;
  const Clip& seen = a[3] < b[3] ? b : a;
  const double share = (kNearest - behind[3]) / (seen[3] - behind[3]);
  for (std::size_t i = 0; i < 4; ++i) behind[i] += share * (seen[i] - behind[i]);
  return true;
}

}  // namespace

void FlatDrawing::line(const Mat4& world_to_clip, const math::Vec3& a, const math::Vec3& b, double width_px,
                       const FlatColor& color) {
  Clip from = transform(world_to_clip, a), to = transform(world_to_clip, b);
  if (!cut(from, to)) return;
  double dx = (to[0] / to[3] - from[0] / from[3]) * width_, dy = (to[1] / to[3] - from[1] / from[3]) * height_;
  const double length = std::hypot(dx, dy);
  if (!(length > 1e-9)) return;
  // Half the width across the line, in clip units.
  const double across_x = -dy / length * width_px / width_, across_y = dx / length * width_px / height_;
  const auto corner = [&](const Clip& end, double side) {
    return FlatVertex{
        {static_cast<float>(end[0] + side * across_x * end[3]), static_cast<float>(end[1] + side * across_y * end[3]),
         static_cast<float>(end[2]), static_cast<float>(end[3])},
        color,
        {-1.0F, -1.0F}};
  };
  const FlatVertex q[4] = {corner(from, -1), corner(from, 1), corner(to, 1), corner(to, -1)};
  for (const int i : {0, 1, 2, 0, 2, 3}) triangles_.push_back(q[i]);
}

void FlatDrawing::axes(const Mat4& world_to_clip, const math::Pose& T_world_frame, double length_m, double width_px) {
  const math::Vec3& origin = T_world_frame.position;
  line(world_to_clip, origin, T_world_frame * math::Vec3{length_m, 0, 0}, width_px, {0.86F, 0.18F, 0.16F, 1.0F});
  line(world_to_clip, origin, T_world_frame * math::Vec3{0, length_m, 0}, width_px, {0.15F, 0.62F, 0.22F, 1.0F});
  line(world_to_clip, origin, T_world_frame * math::Vec3{0, 0, length_m}, width_px, {0.16F, 0.36F, 0.85F, 1.0F});
}

void FlatDrawing::quad(double left, double top, double right, double bottom, const FlatColor& color,
                       const std::array<float, 4>& texture_box) {
  const auto corner = [&](double x, double y, float u, float v) {
    return FlatVertex{
        {static_cast<float>(2.0 * x / width_ - 1.0), static_cast<float>(1.0 - 2.0 * y / height_), 0.0F, 1.0F},
        color,
        {u, v}};
  };
  const auto [u0, v0, u1, v1] = texture_box;
  const FlatVertex q[4] = {corner(left, top, u0, v0), corner(left, bottom, u0, v1), corner(right, bottom, u1, v1),
                           corner(right, top, u1, v0)};
  for (const int i : {0, 1, 2, 0, 2, 3}) triangles_.push_back(q[i]);
}

void FlatDrawing::rectangle(double x_px, double y_px, double width_px, double height_px, const FlatColor& color) {
  quad(x_px, y_px, x_px + width_px, y_px + height_px, color, {-1.0F, -1.0F, -1.0F, -1.0F});
}

void FlatDrawing::card(double x_px, double y_px, double width_px, double height_px, const FlatColor& color,
                       double scale) {
  const auto [face, zoom] = lettering(scale);
  const Glyph& disc = face->glyphs[kDisc];
  const int half = disc.width / 2;
  const double radius = std::min({half * zoom, width_px / 2, height_px / 2});
  const double right = x_px + width_px, bottom = y_px + height_px;
  for (const int column : {0, 1}) {
    for (const int row : {0, 1}) {
      const double x = column == 0 ? x_px : right - radius, y = row == 0 ? y_px : bottom - radius;
      quad(x, y, x + radius, y + radius, color, texture_box(disc.x + column * half, disc.y + row * half, half, half));
    }
  }
  rectangle(x_px + radius, y_px, width_px - 2 * radius, radius, color);
  rectangle(x_px, y_px + radius, width_px, height_px - 2 * radius, color);
  rectangle(x_px + radius, bottom - radius, width_px - 2 * radius, radius, color);
}

void FlatDrawing::text(double x_px, double y_px, const std::string& line, const FlatColor& color, double scale) {
  const auto [face, zoom] = lettering(scale);
  double pen = x_px;
  for (std::size_t at = 0; at < line.size();) {
    const Glyph& glyph = next_glyph(*face, line, at);
    // On whole pixels, so that each texel is one.
    const double left = std::round(pen + glyph.left * zoom), top = std::round(y_px + glyph.top * zoom);
    if (glyph.width > 0) {
      quad(left, top, left + glyph.width * zoom, top + glyph.height * zoom, color,
           texture_box(glyph.x, glyph.y, glyph.width, glyph.height));
    }
    pen += glyph.advance / 64.0 * zoom;
  }
}

}  // namespace ambf::render
