// The arrows and rings by which an object is moved in the scene: where they are, which of them the pointer is on, and
// how far a drag of one goes. Along and about the axes of the world. Pure functions, any thread.
#pragma once

#include <array>
#include <optional>

#include "render/camera/camera.h"
#include "render/marks/layer_shapes.h"
#include "render/marks/world_shapes.h"

namespace ambf::render {

// An arrow shifts, a ring turns; about x, y or z.
struct GizmoHandle {
  bool turns = false;
  int axis = 0;
  bool operator==(const GizmoHandle&) const = default;
};

// A picture and a place in it.
struct GizmoPointer {
  Camera camera;
  double width = 1.0, height = 1.0, x = 0.0, y = 0.0;  // px
};

struct GizmoShape {
  math::Vec3 centre;  // world, m
  double arrow_m = 0.0, ring_m = 0.0;
  bool rings = true;
};

math::Vec3 axis_of(const GizmoHandle& handle);
// As large in the picture wherever the object is.
GizmoShape gizmo_at(const math::Vec3& centre_world, const PixelScale& scale, bool rings);
// None: the pointer is beside it, or it lies behind the camera. `reach_px`: how far beside counts as on.
std::optional<GizmoHandle> handle_at(const GizmoShape& shape, const GizmoPointer& pointer, double reach_px);

// How far, since the pointer was at `from`: m along the arrow's axis, or rad about the ring's. None where the pointer
// says nothing, as with an arrow that points at the viewer.
std::optional<double> way_along(const GizmoShape& shape, const GizmoHandle& handle, const GizmoPointer& from,
                                const GizmoPointer& to);

// In which direction from the centre (unit, in the ring's plane) the pointer takes a ring.
math::Vec3 grip_of(const GizmoShape& shape, const GizmoHandle& ring, const GizmoPointer& pointer);

// The one under the pointer, or dragged, is bright.
void draw_gizmo(const GizmoShape& shape, const Camera& camera, const std::optional<GizmoHandle>& bright,
                double ui_scale, WorldShapes& out);

}  // namespace ambf::render
