// Joints with several free directions (cone twist, six dof): where each of them is, how far it may go, and how that
// is shown. The coordinates are those that physics limits (physics/joints/joint_rows.cpp). Pure functions, any
// thread.
#pragma once

#include <vector>

#include "render/marks/world_shapes.h"
#include "state/structure.h"

namespace ambf::render {

struct SpanCoordinate {
  const char* name = "";
  bool turns = true;  // rad; else m
  double value = 0.0;
  double low = 0.0, high = 0.0;  // low > high: free
  bool free() const { return low > high; }
  bool locked() const { return low == high; }
  bool at_limit() const;  // of those that are neither free nor locked
};

// Cone twist: swing and twist; the swing's limit is that of the direction in which it is swung. Six dof: shifts x, y,
// z and turns about x, y, z. Empty for joints without a span.
std::vector<SpanCoordinate> span_coordinates(const state::JointInfo& joint, const math::Pose& T_world_parent,
                                             const math::Pose& T_world_child);

struct SpanMarks {
  double radius = 0.0;  // m
  double pixel = 0.0;   // m
  double ui = 1.0;
  DebugColor color{};
};
// The cone, or the box and the arcs, within which the child may move, and where it is.
void draw_span(const state::JointInfo& joint, const math::Pose& T_world_parent, const math::Pose& T_world_child,
               const SpanMarks& marks, WorldShapes& out);

}  // namespace ambf::render
