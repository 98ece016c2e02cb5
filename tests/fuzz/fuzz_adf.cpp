// Any bytes as each kind of ADF file: a description or a message, never a crash. What comes out must be finite and
// consistent.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "adf/adf.h"
#include "adf/check.h"

namespace {

using namespace ambf;

// libFuzzer reports an abort with its input.
void require(bool good) {
  if (!good) std::abort();
}

void check_body(const scene::Body& body) {
  require(body.mass >= 0.0 && std::isfinite(body.mass));
  require(body.scale > 0.0 && std::isfinite(body.scale));
  require(!body.identity.identifier.empty() || body.identity.where.line > 0);
  require(math::is_finite(body.T_world_body.position));
  for (const auto& placed : body.collision.shapes)
    require(std::isfinite(placed.geometry.radius) && placed.geometry.radius >= 0.0);
}

void check_joint(const scene::Joint& joint) {
  require(std::abs(math::norm(joint.parent_axis) - 1.0) < 1e-9 && std::abs(math::norm(joint.child_axis) - 1.0) < 1e-9);
  require(!joint.parent.empty() && !joint.child.empty() && joint.parent != joint.child);
  require(!joint.limits || (*joint.limits)[0] <= (*joint.limits)[1]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  adf::Options options;
  options.look_for_files = false;
  const scene::ColorTable colors{{"red", {1.0, 0.0, 0.0, 1.0}}};
  options.colors = &colors;

  const adf::ModelResult model = adf::parse_model(text, "fuzz.yaml", options);
  require(model.model.has_value() || base::has_errors(model.diagnostics));
  if (model.model) {
    for (const scene::Body& body : model.model->bodies) check_body(body);
    for (const scene::Joint& joint : model.model->joints) check_joint(joint);
    scene::Model without_orphans = *model.model;
    adf::take_out_orphans(without_orphans);
  }
  const adf::WorldResult world = adf::parse_world(text, "fuzz.yaml", options);
  require(world.world.has_value() || base::has_errors(world.diagnostics));
  const adf::LaunchResult launch = adf::parse_launch(text, "fuzz.yaml");
  require(launch.launch.has_value() || base::has_errors(launch.diagnostics));
  const adf::ColorsResult named = adf::parse_colors(text, "fuzz.yaml");
  require(named.colors.has_value() || base::has_errors(named.diagnostics));
  const adf::InputDevicesResult devices = adf::parse_input_devices(text, "fuzz.yaml");
  require(devices.devices.has_value() || base::has_errors(devices.diagnostics));
  adf::kind_of(text);
  for (const base::Diagnostic& diagnostic : model.diagnostics) require(!base::to_string(diagnostic).empty());
  return 0;
}
