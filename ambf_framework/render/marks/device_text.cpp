#include "render/marks/device_text.h"

#include <algorithm>
#include <cstdio>

namespace ambf::render {

namespace {

constexpr DebugColor kInk = {0.93F, 0.95F, 0.97F, 1.0F};

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string line_of(const state::DeviceInfo& info, const state::DeviceStatus& status, const DeviceRemark& remark) {
  char rate[32];
  std::snprintf(rate, sizeof rate, "%.0f Hz", status.rate_hz);
  std::string line = info.name + " [" + info.hardware_name + "] : " + rate;
  if (status.mode != state::DeviceMode::clutch) line += std::string(" : ") + state::name_of(status.mode);
  if (status.rotation == state::RotationReference::world) line += " : world axes";
  if (!remark.text.empty()) line += " : " + remark.text;
  return remark.detail.empty() ? line : line + ": " + remark.detail;
}

std::string short_name(const std::string& full_name) { return full_name.substr(full_name.rfind('/') + 1); }

}  // namespace

bool is_left(const state::DeviceInfo& info, const state::DeviceStatus& status) {
  return info.on_demand && (!status.connected || !status.ready);
}

DeviceRemark remark_on(const state::DeviceInfo& info, const state::DeviceStatus& status) {
  using state::DeviceFault;
  if (is_left(info, status)) return {DeviceAlert::none, status.not_ready};
  if (status.cycle == 0 && !info.message.empty()) return {DeviceAlert::fails, "does not work", info.message};
  if (status.cycle == 0) return {DeviceAlert::waits, "starting"};
  const bool fails = status.fault != DeviceFault::none && status.fault != DeviceFault::paused;
  if (fails) {
    const bool has_reason = status.fault == DeviceFault::not_ready && status.not_ready[0] != '\0';
    const bool searched = status.fault == DeviceFault::not_found || status.fault == DeviceFault::lost ||
                          status.fault == DeviceFault::no_effector;
    return {DeviceAlert::fails, has_reason ? status.not_ready : state::name_of(status.fault),
            searched ? info.message : std::string()};
  }
  if (status.fault == DeviceFault::paused) return {DeviceAlert::waits, "paused"};
  if (!status.started) return {DeviceAlert::waits, "starting"};
  if (status.camera_clutched) return {DeviceAlert::waits, status.camera_locked ? "camera" : "camera is taken"};
  if (status.clutched) return {DeviceAlert::waits, status.follows_partner ? "clutched, follows" : "clutched"};
  if (status.at_limit) return {DeviceAlert::waits, "at the limit"};
  return {};
}

DebugColor color_of(const state::DeviceInfo& info, DeviceAlert alert) {
  if (alert == DeviceAlert::waits) return kDeviceWaits;
  if (alert == DeviceAlert::fails) return kDeviceFails;
  return {static_cast<float>(info.color.x), static_cast<float>(info.color.y), static_cast<float>(info.color.z), 1.0F};
}

bool pairs_with(const state::DeviceInfo& info, state::ObjectId camera) {
  return !camera.valid() || std::find(info.cameras.begin(), info.cameras.end(), camera) != info.cameras.end();
}

std::vector<DeviceLine> device_lines(const state::DeviceAbility& devices, state::ObjectId camera) {
  std::vector<DeviceLine> lines, left;
  std::string names;
  bool felt = false;
  for (unsigned device = 0; device < devices.count(); ++device) {
    const std::shared_ptr<const state::DeviceInfo> info = devices.info(device);
    if (!pairs_with(*info, camera)) continue;
    state::DeviceStatus status;
    devices.status(device, status);
    const DeviceRemark remark = remark_on(*info, status);
    if (is_left(*info, status)) {
      if (info->effector.valid() && !remark.text.empty()) {
        left.push_back({short_name(info->effector_name) + ": " + remark.text, color_of(*info)});
      }
      continue;
    }
    names += (names.empty() ? "" : " <> ") + info->name;
    felt |= info->force || info->torque;
    lines.push_back({line_of(*info, status, remark), color_of(*info, remark.alert)});
  }
  if (!lines.empty()) lines.insert(lines.begin(), {"Controlling Devices: [ " + names + " ]", kInk});
  lines.insert(lines.end(), left.begin(), left.end());
  if (felt && !devices.forces()) lines.push_back({"forces off", kDeviceWaits});
  return lines;
}

std::string value_text(state::DeviceParameter parameter, const math::Vec3& value) {
  if (parameter == state::DeviceParameter::mode) return state::name_of(static_cast<state::DeviceMode>(value.x));
  if (parameter == state::DeviceParameter::scheme) return state::name_of(static_cast<state::SharingScheme>(value.x));
  if (parameter == state::DeviceParameter::rotation_reference) return value.x == 0.0 ? "camera" : "world";
  const state::DeviceParameterInfo& info = state::info_of(parameter);
  std::string text = number_text(value.x);
  const bool alike = !info.by_axis || (value.x == value.y && value.y == value.z);
  if (!alike) text += ", " + number_text(value.y) + ", " + number_text(value.z);
  return *info.unit == '\0' ? text : text + ' ' + info.unit;
}

}  // namespace ambf::render
