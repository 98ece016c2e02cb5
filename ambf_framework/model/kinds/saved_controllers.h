// Parameters and controllers of bodies and joints in a saved state. For use inside model/kinds/ only.
#pragma once

#include "model/cartesian_controller.h"
#include "model/detail/state_bytes.h"
#include "model/joint_controller.h"
#include "state/parameters.h"

namespace ambf::model {

inline constexpr double kMaxCommanded = 1e9;  // state::check

template <class Parameters>
void transfer_parameters(StateArchive& archive, Parameters& parameters, state::ObjectKind kind) {
  for (int i = 0; i < state::kParameterCount; ++i) {
    const auto parameter = static_cast<state::Parameter>(i);
    const state::ParameterInfo& info = state::info_of(parameter);
    if (info.kind != kind) continue;
    math::Vec3 value = value_of(parameters, parameter);
    archive.number(value.x, info.min, info.max, info.name);
    if (info.per_axis) archive.number(value.y, info.min, info.max, info.name);
    if (info.per_axis) archive.number(value.z, info.min, info.max, info.name);
    set_value(parameters, parameter, value);
  }
}

inline void transfer_value(StateArchive& archive, math::Pose& value) {
  transfer_pose(archive, value, kMaxSaved, "the controller's set-point");
}
inline void transfer_value(StateArchive& archive, math::Twist& value) {
  transfer_vector(archive, value.linear, kMaxSaved, "the set-point's rate");
  transfer_vector(archive, value.angular, kMaxSaved, "the set-point's rate");
}
inline void transfer_value(StateArchive& archive, double& value) {
  archive.number(value, -kMaxSaved, kMaxSaved, "the controller's set-point");
}

template <class Value, class Rate>
void transfer_reference(StateArchive& archive, ReferenceRate<Value, Rate>& reference) {
  transfer_value(archive, reference.last);
  transfer_value(archive, reference.rate);
  archive.number(reference.since_change_s, 0.0, reference.kLongAgo_s, "the set-point's age");
  archive.number(reference.hold_left_s, -kMaxSaved, reference.kLongAgo_s, "the set-point's time to live");
  archive.flag(reference.running, "whether the set-point moves");
}

inline void transfer_controller(StateArchive& archive, CartesianController::State& controller) {
  for (math::Vec3* part : {&controller.linear_integral, &controller.angular_integral, &controller.last_linear_error,
                           &controller.last_angular_error})
    transfer_vector(archive, *part, kMaxSaved, "the controller's memory");
  archive.flag(controller.running, "whether the controller runs");
  transfer_reference(archive, controller.reference);
}

inline void transfer_controller(StateArchive& archive, JointController::State& controller) {
  archive.number(controller.integral, -kMaxSaved, kMaxSaved, "the controller's integral");
  archive.number(controller.last_error, -kMaxSaved, kMaxSaved, "the controller's last error");
  archive.flag(controller.running, "whether the controller runs");
  transfer_reference(archive, controller.reference);
}

}  // namespace ambf::model
