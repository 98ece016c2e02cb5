// Lines, arrows, frames, boxes, spheres, surfaces and words in space, over a scene: what layers, sensors, soft bodies
// and devices show of themselves. A list that anybody fills and that world_shapes_renderer.h draws in a few calls;
// nothing here knows OpenGL or cameras, so what is drawn is tested by reading the list. Widths are in pixels whatever
// the distance. Main thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "math/types.h"
#include "mesh/mesh.h"

namespace ambf::render {

using DebugColor = std::array<float, 4>;  // as displayed, alpha last

// How things before it hide it.
enum class Seen : std::uint8_t {
  in_front,  // hidden, as the scene is
  through,   // shows faintly through what hides it
  always,    // over everything
};
inline constexpr std::size_t kSeenCount = 3;

// Round at both ends, so that one of no length is a disc; of two widths, it is a wedge.
struct DebugLine {
  std::array<float, 3> from{}, to{};             // world, m
  float from_half_px = 1.0F, to_half_px = 1.0F;  // half the width; below zero: cut off straight at that end
  std::array<std::uint8_t, 4> color{};
};

struct DebugVertex {
  std::array<float, 3> point{};  // world, m
  std::array<std::uint8_t, 4> color{};
};

// A whole mesh, its faces and its edges each in one colour; of alpha 0: not drawn. Edges are those where the surface
// bends sharply, or all.
struct DebugMesh {
  std::shared_ptr<const mesh::Mesh> mesh;
  math::Pose T_world_mesh;
  double scale = 1.0;
  DebugColor faces{}, edges{};
  bool all_edges = false;
};

// Words beside a point. Those that would cover others are left out, the small and far first (label_layout.h).
struct DebugText {
  math::Vec3 point;  // world, m
  std::string text;
  DebugColor color{1.0F, 1.0F, 1.0F, 1.0F};
  double size_m = 0.0;  // of what is named: fades as that gets small in the picture; 0: does not, and is never left out
  double clear_m = 0.0;  // around the point, not to be covered
};

class WorldShapes {
 public:
  void line(const math::Vec3& a, const math::Vec3& b, const DebugColor& color, double width_px = 1.5,
            Seen seen = Seen::in_front);
  void point(const math::Vec3& at, const DebugColor& color, double diameter_px = 8.0, Seen seen = Seen::in_front);
  // With a head at `to`, which is shorter than the arrow. The head's length is in metres, its width in pixels.
  void arrow(const math::Vec3& from, const math::Vec3& to, const DebugColor& color, double head_m,
             double width_px = 2.0, Seen seen = Seen::in_front);
  // x red, y green, z blue.
  void axes(const math::Pose& T_world_frame, double length_m, double width_px = 2.5, Seen seen = Seen::always);
  // Edges of a box about its frame's origin.
  void box(const math::Pose& T_world_box, const math::Vec3& size_m, const DebugColor& color, double width_px = 1.5,
           Seen seen = Seen::in_front);
  void filled_box(const math::Pose& T_world_box, const math::Vec3& size_m, const DebugColor& color,
                  Seen seen = Seen::in_front);
  // Three circles.
  void sphere(const math::Vec3& centre, double radius_m, const DebugColor& color, double width_px = 1.5,
              Seen seen = Seen::in_front);
  // About `axis` (unit), beginning at centre + start (perpendicular to the axis; its length is the radius).
  void arc(const math::Vec3& centre, const math::Vec3& axis, const math::Vec3& start, double angle_rad,
           const DebugColor& color, double width_px = 1.5, Seen seen = Seen::in_front);
  void sector(const math::Vec3& centre, const math::Vec3& axis, const math::Vec3& start, double angle_rad,
              const DebugColor& color, Seen seen = Seen::in_front);
  void triangle(const math::Vec3& a, const math::Vec3& b, const math::Vec3& c, const DebugColor& color,
                Seen seen = Seen::in_front);
  void mesh(std::shared_ptr<const mesh::Mesh> mesh, const math::Pose& T_world_mesh, double scale,
            const DebugColor& faces, const DebugColor& edges, bool all_edges = false);
  void text(const math::Vec3& at, std::string text, const DebugColor& color = {1.0F, 1.0F, 1.0F, 1.0F},
            double size_m = 0.0, double clear_m = 0.0);

  void clear();  // keeps the memory
  bool empty() const;

  const std::vector<DebugLine>& lines(Seen seen) const { return lines_[index(seen)]; }
  const std::vector<DebugVertex>& triangles(Seen seen) const { return triangles_[index(seen)]; }  // three each
  const std::vector<DebugMesh>& meshes() const { return meshes_; }
  const std::vector<DebugText>& texts() const { return texts_; }

 private:
  static std::size_t index(Seen seen) { return static_cast<std::size_t>(seen); }
  void wedge(const math::Vec3& a, const math::Vec3& b, const DebugColor& color, double from_px, double to_px,
             Seen seen);

  std::array<std::vector<DebugLine>, kSeenCount> lines_;
  std::array<std::vector<DebugVertex>, kSeenCount> triangles_;
  std::vector<DebugMesh> meshes_;
  std::vector<DebugText> texts_;
};

}  // namespace ambf::render
