// What windows and the panel write about an input device, and in which colour. Pure functions, any thread.
#pragma once

#include <string>
#include <vector>

#include "render/marks/world_shapes.h"
#include "state/abilities/devices.h"

namespace ambf::render {

inline constexpr DebugColor kDeviceWaits = {0.98F, 0.75F, 0.25F, 1.0F}, kDeviceFails = {1.0F, 0.42F, 0.38F, 1.0F};

// How much attention a device's state asks for.
enum class DeviceAlert { none, waits, fails };

// Why the tool does not follow the hand, or what the hand feels less of: "clutched", "camera", "no sample arrives", "at
// the limit". Empty with DeviceAlert::none.
struct DeviceRemark {
  DeviceAlert alert = DeviceAlert::none;
  std::string text;
  std::string detail{};  // what was searched and what to set, where that is known
};
// A status of cycle 0: its thread has not run.
DeviceRemark remark_on(const state::DeviceInfo& info, const state::DeviceStatus& status);

// Nobody has taken it in hand, and nobody needs to (DeviceInfo::on_demand): it moves nothing.
bool is_left(const state::DeviceInfo& info, const state::DeviceStatus& status);

// Its user's colour; amber and red by `alert`.
DebugColor color_of(const state::DeviceInfo& info, DeviceAlert alert = DeviceAlert::none);

// Whether it sees through this camera. An invalid one (a window's own view) is every device's.
bool pairs_with(const state::DeviceInfo& info, state::ObjectId camera);

// A line of a window's labels.
struct DeviceLine {
  std::string text;
  DebugColor color{1.0F, 1.0F, 1.0F, 1.0F};
};
// "Controlling Devices: [ left <> right ]" with the names of those that see through `camera`, then a line for each of
// them: "left [MTML] : 998 Hz", its mode unless that is the clutch, and the remark. Of those that are left, how their
// tool is taken in hand. At the end "forces off" (-e), where a hand could feel any. Empty without devices.
std::vector<DeviceLine> device_lines(const state::DeviceAbility& devices, state::ObjectId camera);

// "12 N/m", "1, 2, 3 N/m"; words for modes and references of rotations.
std::string value_text(state::DeviceParameter parameter, const math::Vec3& value);

}  // namespace ambf::render
