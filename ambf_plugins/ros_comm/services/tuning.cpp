#include "ros_comm/services/tuning.h"

#include <cmath>

#include "base/bounds.h"

namespace ambf::ros_comm {

namespace {

constexpr const char* kGravity = "gravity";

std::optional<state::Parameter> parameter_named(const std::string& name) {
  for (int i = 0; i < state::kParameterCount; ++i) {
    const auto parameter = static_cast<state::Parameter>(i);
    if (name == state::info_of(parameter).name) return parameter;
  }
  return std::nullopt;
}

}  // namespace

std::string read_tuning(const ambf_msgs::Tune::Request& request, const state::Structure& structure, Tuning& tuning) {
  if (request.names.size() != request.parameters.size() || request.names.size() != request.values.size())
    return "names, parameters and values must be equally many";
  for (std::size_t i = 0; i < request.names.size(); ++i) {
    const std::string &name = request.names[i], &wanted = request.parameters[i];
    if (name.size() > base::kMaxPath || wanted.size() > base::kMaxPath)
      return "a name has more than " + std::to_string(base::kMaxPath) + " bytes";
    const math::Vec3 value{request.values[i].x, request.values[i].y, request.values[i].z};
    if (name.empty() && wanted == kGravity) {
      if (!std::isfinite(value.x) || !std::isfinite(value.y) || !std::isfinite(value.z))
        return "gravity is not three finite numbers";
      tuning.gravity_world = value;
      continue;
    }
    const std::optional<state::Parameter> parameter = parameter_named(wanted);
    if (!parameter) return "there is no parameter '" + wanted + "'";
    const state::ParameterInfo& info = state::info_of(*parameter);
    const std::uint32_t index = state::find(structure, name, info.kind);
    if (index == state::kNone) return "no object with '" + wanted + "', or more than one, is called '" + name + "'";
    const math::Vec3 all = info.per_axis ? value : math::Vec3{value.x, value.x, value.x};
    if (std::string why = state::check(*parameter, all); !why.empty()) return name + ": " + why;
    tuning.changes.push_back({structure.objects[index].id, *parameter, all});
  }
  return {};
}

}  // namespace ambf::ros_comm
