#include "adf/detail/body_parser.h"

#include <algorithm>

namespace ambf::adf {

namespace {

scene::Surface parse_surface(const Fields& block) {
  scene::Surface surface;
  const Fields friction = block.map("friction");
  surface.friction = friction.number("static", surface.friction);
  surface.rolling_friction = friction.number("rolling", surface.rolling_friction);
  surface.restitution = block.number("restitution", surface.restitution);
  const Fields damping = block.map("damping");
  surface.linear_damping = damping.number("linear", surface.linear_damping);
  surface.angular_damping = damping.number("angular", surface.angular_damping);
  return surface;
}

// A channel that is given makes forces; the absent one keeps P = 10, D = 1 on velocity (ADF 4).
scene::ChannelGains parse_channel(const Fields& controller, std::string_view key, Report& report) {
  scene::ChannelGains gains;
  if (!controller.has(key)) return gains;
  const Fields map = controller.map(key);
  gains.p = map.number_or_vector("P", gains.p);
  gains.i = map.number_or_vector("I", gains.i);
  gains.d = map.number_or_vector("D", gains.d);
  gains.output = scene::ControllerOutput::force;
  const auto tell = [&](const char* gain, const math::Vec3& value) {
    if (std::min({value.x, value.y, value.z}) < 0.0)
      report.warning(map.mark(gain), "controller/" + std::string(key) + "/" + gain, kDrivesAway);
  };
  tell("P", gains.p), tell("I", gains.i), tell("D", gains.d);
  return gains;
}

void parse_controller(const Fields& block, scene::Body& body, Report& report) {
  if (!block.has("controller")) {
    if (block.has("controller output type")) {
      report.warning(block.mark("controller output type"), "controller output type",
                     "has no effect without `controller`",
                     "add `controller: {linear: {P: , D: }, angular: {P: , D: }}`");
    }
    return;
  }
  const Fields controller = block.map("controller");
  body.linear = parse_channel(controller, "linear", report);
  body.angular = parse_channel(controller, "angular", report);
  if (const auto output = parse_output(block, "controller output type"))
    body.linear.output = body.angular.output = *output;
}

}  // namespace

std::optional<scene::Body> parse_body(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  Report& report = file.report;
  auto visual = parse_visual(block, file);
  auto collision = parse_collision(block, file);
  if (!visual || !collision) return std::nullopt;

  scene::Body body;
  body.identity = parse_identity(block, file, names);
  body.visual = std::move(*visual);
  body.collision = std::move(*collision);
  body.scale = fields.number("scale", 1.0);
  body.visual.scale = body.collision.scale = body.scale;
  if (!fields.has("mass")) report.information(block.where, "mass", "missing; 1 kg is assumed", "0 makes a static body");
  body.mass = fields.number("mass", body.mass);
  if (fields.has("inertia")) {
    const Fields inertia = fields.map("inertia");
    body.inertia = math::Vec3{inertia.number("ix", 0.0), inertia.number("iy", 0.0), inertia.number("iz", 0.0)};
  }
  body.inertial_offset = fields.pose("inertial offset");
  body.gravity = fields.vector("gravity");
  body.T_world_body = fields.pose("location").value_or(math::Pose{});
  body.surface = parse_surface(fields);
  parse_controller(fields, body, report);
  body.publish_children_names = fields.flag("publish children names", body.publish_children_names);
  body.publish_joint_names = fields.flag("publish joint names", body.publish_joint_names);
  body.publish_joint_positions = fields.flag("publish joint positions", body.publish_joint_positions);
  return body;
}

}  // namespace ambf::adf
