// Input devices files (ADF 14).
#include "adf/detail/bind.h"
#include "adf/detail/files.h"
#include "adf/detail/key_check.h"
#include "adf/detail/open_file.h"
#include "scene/lookup.h"

namespace ambf::adf {

namespace {

constexpr double kMaxRatio = 1.0;

// A number, {P, D}, or {x, y, z}, which is P.
scene::DeviceGains read_gains(const Fields& owner, const char* key) {
  scene::DeviceGains gains;
  if (const auto number = owner.number(key)) {
    gains.p = math::Vec3{*number, *number, *number};
    return gains;
  }
  const Fields map = owner.map(key);
  if (map.has("x") || map.has("y") || map.has("z")) gains.p = owner.vector(key, {});
  if (map.has("P")) gains.p = map.number_or_vector("P", {});
  if (map.has("D")) gains.d = map.number_or_vector("D", {});
  return gains;
}

// All but the keys of `known`, those of inner maps as "axes/x".
void add_options(const Value& map, const std::string& path, const scene::Group* known,
                 std::map<std::string, std::string>& options) {
  for (std::size_t i = 0; i < map.size(); ++i) {
    const auto [name, value] = map.entry(i);
    if (!name.is_scalar() || (known != nullptr && scene::find_key(*known, name.text()) != nullptr)) continue;
    const std::string key = path + name.text();
    if (value.is_map()) {
      add_options(value, key + "/", nullptr, options);
    } else if (value.is_scalar()) {
      options[key] = value.text();
    }
  }
}

scene::DeviceDriver read_driver(const Fields& fields) {
  scene::DeviceDriver driver;
  if (!fields.has("driver")) return driver;
  const Fields map = fields.map("driver");
  driver.type = map.text("type");
  driver.T_base_offset = map.pose("base");
  driver.T_tip_offset = map.pose("tip");
  add_options(map.value(), {}, scene::find_key(scene::group::kInputDevice, "driver")->sub, driver.options);
  return driver;
}

std::optional<scene::InputDevice> parse_device(const Block& block, const std::string& folder, Report& report) {
  const Fields& fields = block.fields;
  auto device = read<scene::InputDevice>(fields.value(), scene::group::kInputDevice, {});
  device.name = block.identifier;
  device.driver = read_driver(fields);
  const Fields haptic = fields.map("haptic gain");
  device.haptic_linear = read_gains(haptic, "linear");
  device.haptic_angular = read_gains(haptic, "angular");
  const Fields controller = fields.map(fields.has("controller gain") ? "controller gain" : "controller");
  device.controller_linear = read_gains(controller, "linear");
  device.controller_angular = read_gains(controller, "angular");
  device.orientation_offset = fields.rotation("orientation offset");
  const std::string multibody = fields.text("simulated multibody");
  if (!multibody.empty()) device.multibody_file = resolve(folder, multibody);
  if (multibody.empty() && device.root_link.empty()) {
    report.error(fields.mark(), {}, "the device has neither `simulated multibody` nor `root link`",
                 "name the body that it moves, or a model to load for it");
    return std::nullopt;
  }
  return device;
}

// The dissertation's files give shares of the controller gain, those of 2.0 stiffness; both write `haptic gain`. One
// block that only the former has marks the file: `cameras`, a controller gain, and a linear haptic gain of at most 1.
bool has_old_form(const Block& block, const scene::InputDevice& device) {
  return block.fields.has("cameras") && device.controller_linear.given() && device.haptic_linear.p &&
         device.haptic_linear.p->x <= kMaxRatio;
}

void decide_haptic_gains(bool old_form, scene::InputDevice& device, const Block& block, Report& report) {
  using scene::HapticGainKind;
  if (device.haptic_gain_kind != HapticGainKind::automatic) return;
  const bool ratio = old_form && device.haptic_linear.p && device.haptic_linear.p->x <= kMaxRatio;
  device.haptic_gain_kind = ratio ? HapticGainKind::ratio : HapticGainKind::stiffness;
  if (!ratio) return;
  report.set_block(block.identifier);
  report.information(block.fields.mark("haptic gain"), "haptic gain",
                     "the form of this file is that of the dissertation: it is a share of the controller gain",
                     "`haptic gain kind: stiffness` makes it N/m");
}

}  // namespace

InputDevicesResult parse_input_devices(const std::string& text, const std::string& path) {
  Report report(path);
  const auto document = open_document(text, scene::group::kInputDevices, report);
  if (!document) return {std::nullopt, report.take()};
  scene::InputDevices file;
  file.file = path;
  const std::string folder = folder_of(path);
  Header header(document->root());
  file.listed = header.fields().texts("input devices");
  std::vector<Block> blocks;
  bool old_form = false;
  for (Block& block : header.blocks("input devices", scene::group::kInputDevice, report)) {
    report.set_block(block.identifier);
    auto device = parse_device(block, folder, report);
    if (!device) continue;
    old_form |= has_old_form(block, *device);
    file.devices.push_back(std::move(*device));
    blocks.push_back(std::move(block));
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) decide_haptic_gains(old_form, file.devices[i], blocks[i], report);
  report.set_block({});
  return {std::move(file), report.take()};
}

InputDevicesResult load_input_devices(const std::string& path) {
  const FileText file = read_text(path);
  if (!file.text) return {std::nullopt, {unreadable(path, file.problem)}};
  return parse_input_devices(*file.text, path);
}

}  // namespace ambf::adf
