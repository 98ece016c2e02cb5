#include "render/marks/layer_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "math/rotation.h"
#include "mesh/appearance.h"
#include "render/scene/object_kind.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

constexpr DebugColor kMoving = {0.96F, 0.56F, 0.14F, 1.0F}, kAsleep = {0.33F, 0.56F, 0.96F, 1.0F},
                     kStatic = {0.66F, 0.70F, 0.74F, 1.0F};
constexpr DebugColor kMass = {0.74F, 0.46F, 0.95F, 1.0F};
constexpr DebugColor kPick = {0.68F, 1.0F, 0.18F, 1.0F};  // green-yellow
constexpr DebugColor kVelocity = {0.15F, 0.80F, 0.85F, 1.0F}, kTurning = {0.95F, 0.45F, 0.75F, 1.0F};

DebugColor with_alpha(DebugColor color, float alpha) {
  color[3] = alpha;
  return color;
}

const math::Pose& pose_of(const LayerInput& in, std::size_t slot) { return in.poses.bodies[slot]; }
math::Pose com_of(const LayerInput& in, std::size_t slot) {
  return pose_of(in, slot) * in.frame.structure->bodies[slot].T_body_com;
}
std::size_t body_count(const LayerInput& in) {
  return std::min({in.frame.structure->bodies.size(), in.poses.bodies.size(), in.frame.bodies.size()});
}

void draw_frame(const LayerInput& in, std::size_t slot, WorldShapes& out) {
  constexpr double kOfRadius = 0.7, kShortest_px = 18.0, kLongest_px = 55.0, kWidth_px = 2.5;
  const math::Pose& T = pose_of(in, slot);
  const double wanted = kOfRadius * bounds_of(in.frame.structure->bodies[slot]).radius;
  const double length =
      std::clamp(wanted, in.scale.metres(T.position, kShortest_px), in.scale.metres(T.position, kLongest_px));
  out.axes(T, length, kWidth_px * in.scale.ui());
}

void draw_parts(const mesh::Appearance* appearance, const math::Pose& T_world_body, const DebugColor& faces,
                const DebugColor& edges, bool all_edges, WorldShapes& out) {
  if (appearance == nullptr) return;
  for (const mesh::AppearancePart& part : appearance->parts) {
    out.mesh(part.mesh, T_world_body * part.T_body_part, part.scale, faces, edges, all_edges);
  }
}

// Of all visible bodies, or of those that look so.
void draw_edges(const LayerInput& in, WorldShapes& out, bool all) {
  constexpr DebugColor kEdges = {0.05F, 0.07F, 0.10F, 0.75F};
  for (std::size_t slot = 0; slot < body_count(in); ++slot) {
    const mesh::Appearance* appearance = in.frame.structure->bodies[slot].appearance.get();
    const BodyLook look = look_of(in.looks, slot);
    if (appearance == nullptr || !appearance->visible || look.hidden || (!all && !look.wireframe)) continue;
    draw_parts(appearance, pose_of(in, slot), {}, kEdges, true, out);
  }
}

}  // namespace

PixelScale::PixelScale(const Camera& camera, int width_px, int height_px, double ui_scale)
    : T_camera_world_(math::inverse(camera.T_world_camera)), near_m_(camera.near_m), ui_scale_(ui_scale) {
  if (camera.orthographic_width_m > 0.0) {
    constant_ = camera.orthographic_width_m / std::max(1, width_px);
  } else {
    per_metre_ = 2.0 * std::tan(camera.field_of_view_rad / 2.0) / std::max(1, height_px);
  }
}

double PixelScale::metres(const math::Vec3& point_world, double px) const {
  const double depth = std::max(near_m_, -(T_camera_world_ * point_world).x);
  return ui_scale_ * px * (per_metre_ * depth + constant_);
}

Sphere bounds_of(const state::BodyInfo& body) {
  for (const mesh::Appearance* appearance : {body.appearance.get(), body.collision_appearance.get()}) {
    Sphere bounds{{}, -1.0};
    if (appearance == nullptr) continue;
    for (const mesh::AppearancePart& part : appearance->parts) {
      if (part.mesh == nullptr) continue;
      const mesh::BoundingBox& box = part.mesh->bounds;
      bounds = around(bounds,
                      {part.T_body_part * (0.5 * part.scale * (box.min + box.max)), 0.5 * part.scale * box.diagonal()});
    }
    if (bounds.radius >= 0.0) return bounds;
  }
  return {};
}

DebugColor force_color(double newtons) {
  constexpr DebugColor kSteps[] = {
      {0.28F, 0.42F, 0.95F, 1.0F}, {0.18F, 0.75F, 0.88F, 1.0F},
      {0.35F, 0.82F, 0.35F, 1.0F}, {0.98F, 0.85F, 0.20F, 1.0F},
      {0.98F, 0.55F, 0.12F, 1.0F}, {0.93F, 0.22F, 0.18F, 1.0F}};  // a decade each, from 1 mN
  const double at = std::clamp(std::log10(std::max(newtons, 1e-9)) + 3.0, 0.0, 5.0);
  const auto below = static_cast<std::size_t>(std::min(std::floor(at), 4.0));
  const auto share = static_cast<float>(at - static_cast<double>(below));
  DebugColor color{};
  for (std::size_t i = 0; i < 4; ++i) color[i] = (1.0F - share) * kSteps[below][i] + share * kSteps[below + 1][i];
  return color;
}

std::string force_text(double newtons) {
  char text[32];
  if (newtons < 0.9995) {
    std::snprintf(text, sizeof text, "%.0f mN", 1e3 * newtons);
  } else if (newtons < 999.5) {
    std::snprintf(text, sizeof text, newtons < 9.95 ? "%.1f N" : "%.0f N", newtons);
  } else {
    std::snprintf(text, sizeof text, "%.1f kN", 1e-3 * newtons);
  }
  return text;
}

void draw_frames(const LayerInput& in, WorldShapes& out) {
  for (std::size_t slot = 0; slot < body_count(in); ++slot) draw_frame(in, slot, out);
}

void draw_picked_frame(const LayerInput& in, WorldShapes& out) {
  const state::Structure& structure = *in.frame.structure;
  const std::uint32_t object = state::find(structure, in.picked);
  if (object == state::kNone || !is_body(structure.objects[object])) return;
  const std::uint32_t slot = structure.objects[object].slot;
  if (slot < body_count(in)) draw_frame(in, slot, out);
}

void draw_collision_shapes(const LayerInput& in, WorldShapes& out) {
  constexpr float kFaces = 0.32F, kStaticFaces = 0.16F, kEdges = 0.95F;
  for (std::size_t slot = 0; slot < body_count(in); ++slot) {
    const state::BodyInfo& body = in.frame.structure->bodies[slot];
    const DebugColor& color = body.mass <= 0.0 ? kStatic : in.frame.bodies[slot].asleep ? kAsleep : kMoving;
    draw_parts(body.collision_appearance.get(), pose_of(in, slot),
               with_alpha(color, body.mass <= 0.0 ? kStaticFaces : kFaces), with_alpha(color, kEdges), false, out);
  }
}

void draw_wireframe(const LayerInput& in, WorldShapes& out) { draw_edges(in, out, true); }

// The box of the body's mass and inertia: Ix = m / 12 (sy^2 + sz^2), and so on in turn.
void draw_masses(const LayerInput& in, WorldShapes& out) {
  constexpr DebugColor kRim = {0.05F, 0.05F, 0.08F, 0.9F}, kCentre = {1.0F, 1.0F, 1.0F, 1.0F};
  for (std::size_t slot = 0; slot < body_count(in); ++slot) {
    const state::BodyInfo& body = in.frame.structure->bodies[slot];
    if (body.mass <= 0.0) continue;
    const math::Pose T = com_of(in, slot);
    const auto side = [&](double along, double across_1, double across_2) {
      return std::sqrt(std::max(0.0, 6.0 / body.mass * (across_1 + across_2 - along)));
    };
    const math::Vec3& inertia = body.inertia;
    const math::Vec3 size{side(inertia.x, inertia.y, inertia.z), side(inertia.y, inertia.z, inertia.x),
                          side(inertia.z, inertia.x, inertia.y)};
    const double ui = in.scale.ui();
    out.filled_box(T, size, with_alpha(kMass, 0.14F), Seen::through);
    out.box(T, size, with_alpha(kMass, 0.9F), 1.3 * ui, Seen::through);
    out.point(T.position, kRim, 10.0 * ui, Seen::always);
    out.point(T.position, kCentre, 6.0 * ui, Seen::always);
  }
}

void draw_names(const LayerInput& in, WorldShapes& out) {
  constexpr double kGround_m = 2.0;  // the middle of what is larger says nothing
  const state::Structure& structure = *in.frame.structure;
  for (std::size_t slot = 0; slot < body_count(in); ++slot) {
    const Sphere bounds = bounds_of(structure.bodies[slot]);
    if (bounds.radius > kGround_m) continue;
    out.text(pose_of(in, slot) * bounds.centre, structure.objects[structure.bodies[slot].object].local_name,
             {0.96F, 0.97F, 0.98F, 1.0F}, std::max(bounds.radius, 1e-3));
  }
}

// Where the centre of mass will be, and how far the body will have turned, after kAhead.
void draw_velocities(const LayerInput& in, WorldShapes& out) {
  constexpr double kAhead_s = 0.1, kLeast_px = 2.0, kHead_px = 9.0;
  for (std::size_t slot = 0; slot < body_count(in); ++slot) {
    if (in.frame.structure->bodies[slot].mass <= 0.0) continue;
    const math::Twist& twist = in.frame.bodies[slot].twist_world;
    const math::Vec3 com = com_of(in, slot).position;
    const double least = in.scale.metres(com, kLeast_px), head = in.scale.metres(com, kHead_px), ui = in.scale.ui();
    if (math::norm(twist.linear) * kAhead_s > least) {
      out.arrow(com, com + kAhead_s * twist.linear, kVelocity, head, 2.0 * ui, Seen::through);
    }
    const double rate = math::norm(twist.angular), radius = bounds_of(in.frame.structure->bodies[slot]).radius;
    if (rate * kAhead_s * radius < least) continue;
    const math::Vec3 axis = (1.0 / rate) * twist.angular;
    const math::Vec3 start = radius * math::rotate(math::rotation_between({0, 0, 1}, axis), {1, 0, 0});
    const double angle = std::min(rate * kAhead_s, 6.2);
    out.arc(com, axis, start, angle, kTurning, 2.0 * ui, Seen::through);
    const math::Vec3 tip = math::rotate(math::from_axis_angle(axis, angle), start);
    out.arrow(com + tip - 1.01 * head * math::normalized(math::cross(axis, tip)), com + tip, kTurning, head, 2.0 * ui,
              Seen::through);
  }
}

void draw_picks(const LayerInput& in, WorldShapes& out) {
  constexpr double kPoint_px = 15.0, kHead_px = 12.0;
  constexpr DebugColor kRim = {0.10F, 0.16F, 0.02F, 0.85F};
  for (const state::PickState& pick : in.frame.picks) {
    if (pick.body >= body_count(in)) continue;
    const math::Vec3 held = pose_of(in, pick.body) * pick.point_body;
    const double ui = in.scale.ui();
    out.arrow(held, pick.target_world, kPick, in.scale.metres(pick.target_world, kHead_px), 2.5 * ui, Seen::always);
    out.point(held, kRim, kPoint_px * ui, Seen::always);
    out.point(held, kPick, (kPoint_px - 3.0) * ui, Seen::always);
    const bool moved = in.frame.structure->bodies[pick.body].mass <= 0.0;
    if (!moved) out.text(held, force_text(math::norm(pick.force_world)), kPick);
  }
  for (const state::SoftPick& pick : state::soft_picks(in.frame)) {
    const double ui = in.scale.ui();
    out.arrow(pick.point_world, pick.target_world, kPick, in.scale.metres(pick.target_world, kHead_px), 2.5 * ui,
              Seen::always);
    out.point(pick.point_world, kRim, kPoint_px * ui, Seen::always);
    out.point(pick.point_world, kPick, (kPoint_px - 3.0) * ui, Seen::always);
    out.text(pick.point_world, force_text(math::norm(pick.force_world)), kPick);
  }
}

void draw_layers(const Layers& layers, const LayerInput& in, WorldShapes& out) {
  if (!layers.shows(LayerId::wireframe)) draw_edges(in, out, false);
  for (std::size_t i = 0; i < all_layers().size(); ++i) {
    const auto layer = static_cast<LayerId>(i);
    const auto draw = all_layers()[i].draw;
    if (draw == nullptr || !layers.shows(layer)) continue;
    if (layer == LayerId::picked_frame && layers.shows(LayerId::frames)) continue;  // it is among all of them
    draw(in, out);
  }
}

}  // namespace ambf::render
