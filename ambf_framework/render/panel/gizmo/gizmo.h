// The gizmo of the selected object: arrows and rings that the pointer drags to move it. Main thread.
#pragma once

#include <optional>
#include <string>

#include "render/panel/gizmo/detail/gizmo_hand.h"
#include "render/panel/gizmo/detail/gizmo_shape.h"
#include "render/window/window_part.h"

namespace ambf::render {

class Gizmo {
 public:
  Gizmo(state::CommandAbility& command, state::PickAbility& pick) : hand_(command, pick) {}

  // Options.
  bool shown = false;
  bool snaps = false;
  double snap_m = 0.01, snap_rad = 0.2617993877991494;  // 15 degrees

  // What happened in the window, positions in its units. True when it was meant for the gizmo. What has to be shown to
  // the user: `message`.
  bool on_input(const WindowMoment& moment, const Input& input, state::ObjectId selected, std::string& message);
  // Once per picture. Returns a message for the user, or nothing.
  std::string observe(const state::Frame& frame, std::int64_t now_ns);
  void draw(const WindowMoment& moment, state::ObjectId selected, WorldShapes& out) const;
  void forget_pointer() { under_pointer_.reset(); }             // the pointer is over something else
  void let_go(const state::Frame& frame, std::int64_t now_ns);  // ends a drag, as releasing the button does

  bool dragging() const { return drag_.has_value(); }
  const std::optional<GizmoHandle>& under_pointer() const { return under_pointer_; }

  // Where the gizmo of an object is in this window; none where there is none to show. For drawing, and for what points
  // at it.
  std::optional<GizmoShape> shape(const WindowMoment& moment, state::ObjectId selected) const;

 private:
  struct Drag {
    state::ObjectId object;
    unsigned window = 0;
    GizmoHandle handle;
    GizmoShape shape;  // as it was at the beginning
    GizmoPointer from;
    math::Pose T_world_start;
    double way = 0.0;  // m or rad
  };
  math::Pose target_of(const Drag& drag) const;
  double snapped(const Drag& drag, double way) const;

  GizmoHand hand_;
  std::optional<GizmoHandle> under_pointer_;
  std::optional<Drag> drag_;
};

}  // namespace ambf::render
