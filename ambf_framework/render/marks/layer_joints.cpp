// Joints and contacts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "math/rotation.h"
#include "render/marks/joint_span.h"
#include "render/marks/layer_shapes.h"

namespace ambf::render {

namespace {

constexpr DebugColor kJoint = {0.99F, 0.80F, 0.18F, 1.0F}, kSpring = {0.55F, 0.85F, 0.35F, 1.0F},
                     kAtLimit = {0.95F, 0.22F, 0.18F, 1.0F}, kCommanded = {0.20F, 0.80F, 0.95F, 1.0F},
                     kPlain = {0.80F, 0.82F, 0.85F, 1.0F};

DebugColor faint(DebugColor color, float alpha) {
  color[3] = alpha;
  return color;
}

// One joint, in the world.
struct JointView {
  const state::JointInfo& info;
  const state::JointState& state;
  math::Vec3 pivot, axis;  // of the parent; unit
  math::Pose T_world_parent, T_world_child, T_child_com;
  double radius = 0.0;  // m, of what is drawn
  double child_radius = 0.0;
  double pixel = 0.0;  // m
  double ui = 1.0;
  bool at_limit() const {
    constexpr double kNear = 0.01;  // of the range
    const double margin = kNear * (info.upper - info.lower);
    return info.has_limits && (state.position < info.lower + margin || state.position > info.upper - margin);
  }
};

math::Vec3 across(const math::Vec3& v, const math::Vec3& axis) { return v - math::dot(v, axis) * axis; }

// Where the child's side of the joint points now, as a unit vector across the axis: from the pivot to the child's
// centre of mass, or along whichever of the child's own axes lies most across when the centre is on the axis. It
// turns with the child.
math::Vec3 needle_of(const JointView& joint) {
  const math::Vec3 to_com = across(joint.T_world_child * joint.T_child_com.position - joint.pivot, joint.axis);
  if (math::norm(to_com) > 1e-3) return math::normalized(to_com);
  math::Vec3 best;
  for (const math::Vec3& own : {math::Vec3{1, 0, 0}, math::Vec3{0, 1, 0}, math::Vec3{0, 0, 1}}) {
    const math::Vec3 candidate = across(math::rotate(joint.T_world_child.orientation, own), joint.axis);
    if (math::norm(candidate) > math::norm(best) + 1e-3) best = candidate;
  }
  return math::normalized(best);
}

void draw_revolute(const JointView& joint, const DebugColor& color, WorldShapes& out) {
  const double r = joint.radius, ui = joint.ui;
  const math::Vec3 &pivot = joint.pivot, &axis = joint.axis;
  out.arrow(pivot - 0.9 * r * axis, pivot + 1.3 * r * axis, color, 10.0 * joint.pixel, 2.0 * ui, Seen::through);
  const math::Vec3 needle = needle_of(joint);
  const double q = joint.state.position;
  const auto at = [&](double angle) { return math::rotate(math::from_axis_angle(axis, angle - q), r * needle); };
  const double range = joint.info.upper - joint.info.lower;
  if (joint.info.has_limits && range < 2.0 * std::numbers::pi) {
    out.sector(pivot, axis, at(joint.info.lower), range, faint(color, 0.22F), Seen::through);
    out.arc(pivot, axis, at(joint.info.lower), range, color, 1.5 * ui, Seen::through);
    for (const double end : {joint.info.lower, joint.info.upper}) {
      out.line(pivot, pivot + at(end), color, 1.0 * ui, Seen::through);
    }
  } else {
    out.arc(pivot, axis, r * needle, 2.0 * std::numbers::pi, faint(color, 0.6F), 1.0 * ui, Seen::through);
  }
  if (joint.state.commanded_type == state::JointCommandType::position) {
    out.line(pivot, pivot + 1.12 * at(joint.state.commanded), kCommanded, 1.5 * ui, Seen::through);
  }
  out.line(pivot, pivot + 1.12 * at(q), joint.at_limit() ? kAtLimit : color, 3.5 * ui, Seen::through);
}

void draw_prismatic(const JointView& joint, const DebugColor& color, WorldShapes& out) {
  const double ui = joint.ui;
  const auto at = [&](double travel) { return joint.pivot + travel * joint.axis; };
  const double q = joint.state.position;
  if (joint.info.has_limits) {
    out.line(at(joint.info.lower), at(joint.info.upper), faint(color, 0.55F), 5.0 * ui, Seen::through);
    for (const double end : {joint.info.lower, joint.info.upper}) out.point(at(end), color, 8.0 * ui, Seen::through);
  }
  out.arrow(at(q), at(q) + joint.radius * joint.axis, color, 10.0 * joint.pixel, 2.0 * ui, Seen::through);
  if (joint.state.commanded_type == state::JointCommandType::position) {
    out.point(at(joint.state.commanded), kCommanded, 8.0 * ui, Seen::always);
  }
  out.point(at(q), joint.at_limit() ? kAtLimit : color, 11.0 * ui, Seen::always);
}

// So that what is hardly below zero is not "-0.0".
double rounded(double value, double parts) { return std::round(value * parts) / parts + 0.0; }

void draw_value(const JointView& joint, WorldShapes& out) {
  const bool turns =
      joint.info.type == state::JointType::revolute || joint.info.type == state::JointType::torsion_spring;
  char value[32];
  if (turns) {
    std::snprintf(value, sizeof value, " %.1f\u00b0", rounded(joint.state.position * 180.0 / std::numbers::pi, 10.0));
  } else {
    std::snprintf(value, sizeof value, " %.2f mm", rounded(1e3 * joint.state.position, 100.0));
  }
  out.text(joint.pivot, joint.info.name + value, joint.at_limit() ? kAtLimit : kJoint, joint.child_radius,
           joint.radius);
}

void draw_joint(const JointView& joint, WorldShapes& out) {
  switch (joint.info.type) {
    case state::JointType::revolute:
      draw_revolute(joint, kJoint, out);
      draw_value(joint, out);
      break;
    case state::JointType::torsion_spring:
      draw_revolute(joint, kSpring, out);
      draw_value(joint, out);
      break;
    case state::JointType::prismatic:
      draw_prismatic(joint, kJoint, out);
      draw_value(joint, out);
      break;
    case state::JointType::linear_spring:
      draw_prismatic(joint, kSpring, out);
      draw_value(joint, out);
      break;
    case state::JointType::fixed: out.point(joint.pivot, kPlain, 8.0 * joint.ui, Seen::through); break;
    case state::JointType::p2p: out.point(joint.pivot, kJoint, 11.0 * joint.ui, Seen::through); break;
    case state::JointType::cone_twist:
    case state::JointType::six_dof:
    case state::JointType::six_dof_spring: {
      const DebugColor& color = joint.info.type == state::JointType::six_dof_spring ? kSpring : kJoint;
      draw_span(joint.info, joint.T_world_parent, joint.T_world_child, {joint.radius, joint.pixel, joint.ui, color},
                out);
      out.text(joint.pivot, joint.info.name, color, joint.child_radius, joint.radius);
      break;
    }
  }
}

}  // namespace

void draw_joints(const LayerInput& in, WorldShapes& out) {
  constexpr double kOfRadius = 0.7, kSmallest_px = 18.0, kLargest_px = 46.0;
  const state::Structure& structure = *in.frame.structure;
  const std::size_t bodies = std::min(structure.bodies.size(), in.poses.bodies.size());
  for (std::size_t slot = 0; slot < std::min(structure.joints.size(), in.frame.joints.size()); ++slot) {
    const state::JointInfo& info = structure.joints[slot];
    if (info.parent_body >= bodies || info.child_body >= bodies) continue;
    const math::Pose& T_parent = in.poses.bodies[info.parent_body];
    JointView joint{info,
                    in.frame.joints[slot],
                    T_parent * info.pivot_parent,
                    math::normalized(math::rotate(T_parent.orientation, info.axis_parent)),
                    T_parent,
                    in.poses.bodies[info.child_body],
                    structure.bodies[info.child_body].T_body_com};
    joint.ui = in.scale.ui();
    joint.pixel = in.scale.metres(joint.pivot, 1.0);
    joint.child_radius = std::max(bounds_of(structure.bodies[info.child_body]).radius, 1e-3);
    joint.radius = std::clamp(kOfRadius * joint.child_radius, kSmallest_px * joint.pixel, kLargest_px * joint.pixel);
    draw_joint(joint, out);
  }
}

void draw_force(const LayerInput& in, const math::Vec3& at_world, const math::Vec3& force_world, WorldShapes& out) {
  constexpr double kDecade_px = 16.0, kLeast_N = 0.001, kHead_px = 9.0;
  const double newtons = math::norm(force_world);
  if (!(newtons > 0.0)) return;
  const double length = in.scale.metres(at_world, kDecade_px * std::log10(1.0 + newtons / kLeast_N));
  out.arrow(at_world, at_world + (length / newtons) * force_world, force_color(newtons),
            in.scale.metres(at_world, kHead_px), 2.0 * in.scale.ui(), Seen::through);
}

// An arrow shows what acts on the body that moves; between two moving ones, on the first.
void draw_contacts(const LayerInput& in, WorldShapes& out) {
  constexpr double kPoint_px = 7.0, kNearPoint_px = 4.0;
  constexpr DebugColor kNear = {0.75F, 0.78F, 0.82F, 0.8F};  // nothing is pressed there
  const double step_s = in.frame.run.step_s;
  for (const state::ContactState& contact : in.frame.contacts) {
    const double ui = in.scale.ui();
    if (!(contact.impulse > 0.0) || !(step_s > 0.0)) {
      out.point(contact.point_world, kNear, kNearPoint_px * ui, Seen::through);
      continue;
    }
    const math::Vec3 on_a = (1.0 / step_s) * (contact.impulse * contact.normal_world + contact.friction_world);
    const double newtons = math::norm(on_a);
    const bool a_is_static =
        contact.body_a >= in.frame.structure->bodies.size() || in.frame.structure->bodies[contact.body_a].mass <= 0.0;
    draw_force(in, contact.point_world, (a_is_static ? -1.0 : 1.0) * on_a, out);
    out.point(contact.point_world, force_color(newtons), kPoint_px * ui, Seen::through);
  }
}

}  // namespace ambf::render
