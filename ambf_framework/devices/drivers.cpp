// The table of drivers, and what each of them does with the offsets of a device's mounting.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "devices/detail/library_search.h"
#include "devices/driver.h"
#include "devices/drivers/gamepad.h"
#include "devices/drivers/scripted.h"
#include "devices/drivers/spacenav.h"
#include "math/rotation.h"

namespace ambf::devices {

namespace {

std::vector<DriverKind>& registered() {
  static std::vector<DriverKind> kinds = {gamepad_kind(), scripted_kind(), spacenav_kind()};
  return kinds;
}

}  // namespace

void register_driver(DriverKind kind) {
  for (const DriverKind& other : registered()) {
    if (other.type == kind.type) throw std::logic_error("a driver of type '" + kind.type + "' is registered already");
  }
  registered().push_back(std::move(kind));
}

const std::vector<DriverKind>& driver_kinds() { return registered(); }

const DriverKind* find_driver(const DriverRequest& request) {
  const auto fits = [&](const DriverKind& kind) {
    if (!request.type.empty()) return kind.type == request.type;
    const auto& names = kind.hardware_names;
    return std::find(names.begin(), names.end(), request.hardware_name) != names.end();
  };
  const auto find = [&]() -> const DriverKind* {
    const auto found = std::find_if(registered().begin(), registered().end(), fits);
    return found == registered().end() ? nullptr : &*found;
  };
  LibrarySearch::instance().load_named(request);
  if (const DriverKind* kind = find()) return kind;
  LibrarySearch::instance().load_all();
  return find();
}

math::Pose to_user_frame(const DriverRequest& request, const math::Pose& T_base_tip) {
  math::Pose T_u_tip = math::inverse(request.T_base_offset) * T_base_tip * request.T_tip_offset;
  T_u_tip.orientation = math::normalized(T_u_tip.orientation);
  return T_u_tip;
}

math::Wrench to_base_axes(const DriverRequest& request, const math::Wrench& wrench_u) {
  const math::Quat& R_base_u = request.T_base_offset.orientation;
  return {math::rotate(R_base_u, wrench_u.force), math::rotate(R_base_u, wrench_u.torque)};
}

}  // namespace ambf::devices
