#include "adf/detail/vehicle_parser.h"

#include <cmath>

#include "adf/detail/bind.h"
#include "adf/detail/body_parser.h"
#include "scene/vehicle.h"
#include "state/vehicles.h"

namespace ambf::adf {

namespace {

constexpr double kMinAngle = 0.01;  // rad, between axle and suspension
constexpr double kUsualSteering = 1.5707963;

bool check_directions(const Fields& fields, const std::string& path, scene::Wheel& wheel, Report& report) {
  const auto down = parse_axis(fields, "down direction", wheel.down, report);
  const auto axle = parse_axis(fields, "axel direction", wheel.axle, report);
  if (!down || !axle) return false;
  wheel.down = *down;
  wheel.axle = *axle;
  if (math::norm(math::cross(*down, *axle)) > std::sin(kMinAngle)) return true;
  report.error(fields.mark("axel direction"), path + "axel direction",
               "expected a direction across `down direction`, found one along it", "the wheel could not roll");
  return false;
}

void check_steering(const Fields& fields, const std::string& path, scene::Wheel& wheel, Report& report) {
  const Fields limits = fields.map("steering limits");
  if (wheel.steering_low > wheel.steering_high) {
    report.warning(limits.mark("low"), path + "steering limits", "low is above high", "they are exchanged");
    std::swap(wheel.steering_low, wheel.steering_high);
  }
  if (std::max(-wheel.steering_low, wheel.steering_high) > kUsualSteering)
    report.warning(limits.mark("high"), path + "steering limits", "more than a quarter turn; angles are in radians");
}

// Whether another wheel, or the chassis, is that body already.
bool is_taken(const scene::Vehicle& vehicle, const std::string& body) {
  for (const scene::Wheel& other : vehicle.wheels)
    if (other.body == body) return true;
  return vehicle.parent == body;
}

// False, and an error, when the wheel is none.
bool check_body(const Fields& fields, const std::string& path, const scene::Vehicle& vehicle, scene::Wheel& wheel,
                Report& report) {
  if (wheel.body.empty() && wheel.mesh.empty()) {
    report.error(fields.mark(), path + "body", "missing, and so is `mesh`", "name the body that is the wheel");
    return false;
  }
  if (wheel.body.empty()) return true;
  if (!wheel.mesh.empty()) {
    report.warning(fields.mark("mesh"), path + "mesh", "not used: `body` counts", "leave one of them out");
    wheel.mesh.clear();
  }
  if (!is_taken(vehicle, wheel.body)) return true;
  report.error(fields.mark("body"), path + "body", in_quotes(wheel.body) + " is the chassis or another wheel already",
               "each wheel needs a body of its own");
  return false;
}

// The body that is drawn as the wheel. A mesh that is missing is an error of what is drawn alone.
scene::Body drawn_wheel(const Fields& fields, const scene::Identity& vehicle, std::size_t number,
                        const FileContext& file) {
  scene::Body body;
  body.identity = vehicle;
  body.identity.identifier = "WHEEL " + std::to_string(number) + " of " + vehicle.name;
  body.identity.name = "wheel" + std::to_string(number) + "_of_" + vehicle.name;
  body.identity.passive = true;
  body.mass = 0.0;
  body.T_world_body = {};
  if (auto visual = parse_visual({body.identity.identifier, fields, fields.mark()}, file))
    body.visual = std::move(*visual);
  return body;
}

}  // namespace

std::optional<scene::KindBlock> parse_vehicle(const Block& block, const FileContext& file, NameBook& names,
                                              std::vector<scene::Body>& bodies) {
  const Fields& fields = block.fields;
  Report& report = file.report;
  auto vehicle = std::make_shared<scene::Vehicle>(
      read<scene::Vehicle>(fields.value(), *scene::kind::kVehicle.group, file.options.defaults));
  const std::vector<Fields> wheels = fields.maps("wheels");
  bool good = true;
  for (const Fields& each : wheels) {
    const std::string path = "wheels[" + std::to_string(vehicle->wheels.size()) + "]/";
    auto wheel = read<scene::Wheel>(each.value(), scene::group::kWheel, file.options.defaults);
    wheel.mesh = each.text("mesh");
    good &= check_body(each, path, *vehicle, wheel, report);
    good &= check_directions(each, path, wheel, report);
    check_steering(each, path, wheel, report);
    vehicle->wheels.push_back(std::move(wheel));
  }
  if (wheels.empty() || wheels.size() > state::kMaxWheels) {
    report.error(fields.mark("wheels"), "wheels", "expected 1 to 127, found " + std::to_string(wheels.size()));
    good = false;
  }
  if (!good) return std::nullopt;
  scene::Identity identity = parse_identity(block, file, names);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (vehicle->wheels[i].mesh.empty()) continue;
    bodies.push_back(drawn_wheel(wheels[i], identity, i, file));
    vehicle->wheels[i].body = bodies.back().identity.identifier;
  }
  return scene::KindBlock{&scene::kind::kVehicle, std::move(identity), std::move(vehicle)};
}

}  // namespace ambf::adf
