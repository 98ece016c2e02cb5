#include "adf/detail/body_parser.h"

#include <algorithm>

#include "adf/detail/bind.h"

namespace ambf::adf {

namespace {

// A channel that is given makes forces; the absent one keeps its output (ADF 4).
void finish_channel(const Fields& controller, const std::string& key, scene::ChannelGains& gains, Report& report) {
  if (!controller.has(key)) return;
  const Fields map = controller.map(key);
  gains.output = scene::ControllerOutput::force;
  const auto check = [&](const char* gain, const math::Vec3& value) {
    if (std::min({value.x, value.y, value.z}) < 0.0)
      report.warning(map.mark(gain), "controller/" + key + "/" + gain, kDrivesAway);
  };
  check("P", gains.p), check("I", gains.i), check("D", gains.d);
}

void finish_controller(const Fields& block, scene::Body& body, Report& report) {
  if (!block.has("controller")) {
    if (block.has("controller output type")) {
      report.warning(block.mark("controller output type"), "controller output type",
                     "has no effect without `controller`",
                     "add `controller: {linear: {P: , D: }, angular: {P: , D: }}`");
    }
    return;
  }
  const Fields controller = block.map("controller");
  finish_channel(controller, "linear", body.linear, report);
  finish_channel(controller, "angular", body.angular, report);
  // One key for both channels.
  if (block.has("controller output type")) {
    const auto output = read_choice<scene::ControllerOutput>(block, scene::group::kBody, "controller output type");
    body.linear.output = body.angular.output = output.value_or(scene::ControllerOutput::force);
  }
}

}  // namespace

std::optional<scene::Body> parse_body(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  Report& report = file.report;
  auto visual = parse_visual(block, file);
  auto collision = parse_collision(block, file);
  if (!visual || !collision) return std::nullopt;

  auto body = read<scene::Body>(fields.value(), scene::group::kBody, file.options.defaults);
  body.identity = parse_identity(block, file, names);
  body.visual = std::move(*visual);
  body.collision = std::move(*collision);
  body.scale = body.collision.scale = body.visual.scale;
  if (!fields.has("mass")) report.information(block.where, "mass", "missing; 1 kg is assumed", "0 makes a static body");
  if (fields.has("inertia")) {
    const Fields inertia = fields.map("inertia");
    body.inertia = math::Vec3{inertia.number("ix", 0.0), inertia.number("iy", 0.0), inertia.number("iz", 0.0)};
  }
  finish_controller(fields, body, report);
  return body;
}

}  // namespace ambf::adf
