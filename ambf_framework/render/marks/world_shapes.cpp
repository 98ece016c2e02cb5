#include "render/marks/world_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/rotation.h"

namespace ambf::render {

namespace {

constexpr DebugColor kAxisColors[3] = {
    {0.90F, 0.22F, 0.20F, 1.0F}, {0.20F, 0.70F, 0.28F, 1.0F}, {0.24F, 0.46F, 0.95F, 1.0F}};
constexpr double kArcStep_rad = std::numbers::pi / 24.0;

std::array<float, 3> packed(const math::Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::array<std::uint8_t, 4> packed(const DebugColor& color) {
  std::array<std::uint8_t, 4> out{};
  for (std::size_t i = 0; i < 4; ++i) {
    out[i] = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(color[i], 0.0F, 1.0F)));
  }
  return out;
}

// The corners of a box; bit 0, 1, 2 of the index: on the x, y, z side.
std::array<math::Vec3, 8> corners_of(const math::Pose& T_world_box, const math::Vec3& size) {
  std::array<math::Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const math::Vec3 corner{(i & 1U) != 0 ? 0.5 : -0.5, (i & 2U) != 0 ? 0.5 : -0.5, (i & 4U) != 0 ? 0.5 : -0.5};
    corners[i] = T_world_box * math::Vec3{corner.x * size.x, corner.y * size.y, corner.z * size.z};
  }
  return corners;
}

// visit(a, b) for each piece of an arc.
template <class Visit>
void each_piece(const math::Vec3& centre, const math::Vec3& axis, const math::Vec3& start, double angle_rad,
                Visit&& visit) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(angle_rad) / kArcStep_rad)));
  math::Vec3 before = centre + start;
  for (int i = 1; i <= pieces; ++i) {
    const math::Vec3 next = centre + math::rotate(math::from_axis_angle(axis, angle_rad * i / pieces), start);
    visit(before, next);
    before = next;
  }
}

}  // namespace

void WorldShapes::wedge(const math::Vec3& a, const math::Vec3& b, const DebugColor& color, double from_px, double to_px,
                        Seen seen) {
  lines_[index(seen)].push_back(
      {packed(a), packed(b), static_cast<float>(0.5 * from_px), static_cast<float>(0.5 * to_px), packed(color)});
}

void WorldShapes::line(const math::Vec3& a, const math::Vec3& b, const DebugColor& color, double width_px, Seen seen) {
  wedge(a, b, color, width_px, width_px, seen);
}

void WorldShapes::point(const math::Vec3& at, const DebugColor& color, double diameter_px, Seen seen) {
  wedge(at, at, color, diameter_px, diameter_px, seen);
}

void WorldShapes::arrow(const math::Vec3& from, const math::Vec3& to, const DebugColor& color, double head_m,
                        double width_px, Seen seen) {
  constexpr double kHeadWidth = 5.0, kLongestHead = 0.5;  // of the shaft's width; of the arrow's length
  const double length = math::norm(to - from);
  if (!(length > 0.0)) return;
  const double head = std::min(head_m, kLongestHead * length);
  const math::Vec3 neck = to - (head / length) * (to - from);
  wedge(from, neck, color, width_px, width_px, seen);
  wedge(neck, to, color, -kHeadWidth * width_px, 0.0, seen);
}

void WorldShapes::axes(const math::Pose& T_world_frame, double length_m, double width_px, Seen seen) {
  const math::Vec3 ends[3] = {{length_m, 0, 0}, {0, length_m, 0}, {0, 0, length_m}};
  for (int i = 0; i < 3; ++i) line(T_world_frame.position, T_world_frame * ends[i], kAxisColors[i], width_px, seen);
}

void WorldShapes::box(const math::Pose& T_world_box, const math::Vec3& size_m, const DebugColor& color, double width_px,
                      Seen seen) {
  const auto corners = corners_of(T_world_box, size_m);
  for (std::size_t i = 0; i < 8; ++i) {
    for (const std::size_t side : {1U, 2U, 4U}) {
      if ((i & side) == 0) line(corners[i], corners[i | side], color, width_px, seen);
    }
  }
}

void WorldShapes::filled_box(const math::Pose& T_world_box, const math::Vec3& size_m, const DebugColor& color,
                             Seen seen) {
  const auto c = corners_of(T_world_box, size_m);
  constexpr std::size_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) {
    triangle(c[f[0]], c[f[1]], c[f[2]], color, seen);
    triangle(c[f[0]], c[f[2]], c[f[3]], color, seen);
  }
}

void WorldShapes::sphere(const math::Vec3& centre, double radius_m, const DebugColor& color, double width_px,
                         Seen seen) {
  constexpr double kFull = 2.0 * std::numbers::pi;
  arc(centre, {1, 0, 0}, {0, radius_m, 0}, kFull, color, width_px, seen);
  arc(centre, {0, 1, 0}, {0, 0, radius_m}, kFull, color, width_px, seen);
  arc(centre, {0, 0, 1}, {radius_m, 0, 0}, kFull, color, width_px, seen);
}

void WorldShapes::arc(const math::Vec3& centre, const math::Vec3& axis, const math::Vec3& start, double angle_rad,
                      const DebugColor& color, double width_px, Seen seen) {
  each_piece(centre, axis, start, angle_rad,
             [&](const math::Vec3& a, const math::Vec3& b) { wedge(a, b, color, -width_px, -width_px, seen); });
}

void WorldShapes::sector(const math::Vec3& centre, const math::Vec3& axis, const math::Vec3& start, double angle_rad,
                         const DebugColor& color, Seen seen) {
  each_piece(centre, axis, start, angle_rad,
             [&](const math::Vec3& a, const math::Vec3& b) { triangle(centre, a, b, color, seen); });
}

void WorldShapes::triangle(const math::Vec3& a, const math::Vec3& b, const math::Vec3& c, const DebugColor& color,
                           Seen seen) {
  for (const math::Vec3& corner : {a, b, c}) triangles_[index(seen)].push_back({packed(corner), packed(color)});
}

void WorldShapes::mesh(std::shared_ptr<const mesh::Mesh> mesh, const math::Pose& T_world_mesh, double scale,
                       const DebugColor& faces, const DebugColor& edges, bool all_edges) {
  if (mesh != nullptr) meshes_.push_back({std::move(mesh), T_world_mesh, scale, faces, edges, all_edges});
}

void WorldShapes::text(const math::Vec3& at, std::string text, const DebugColor& color, double size_m, double clear_m) {
  texts_.push_back({at, std::move(text), color, size_m, clear_m});
}

void WorldShapes::clear() {
  for (auto& lines : lines_) lines.clear();
  for (auto& triangles : triangles_) triangles.clear();
  meshes_.clear();
  texts_.clear();
}

bool WorldShapes::empty() const {
  const auto none = [](const auto& list) { return list.empty(); };
  return std::all_of(lines_.begin(), lines_.end(), none) && std::all_of(triangles_.begin(), triangles_.end(), none) &&
         meshes_.empty() && texts_.empty();
}

}  // namespace ambf::render
