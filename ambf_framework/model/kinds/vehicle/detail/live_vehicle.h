// A vehicle in the simulation: its wheels, and what it is ordered to do. Physics thread. For use inside
// model/kinds/vehicle* only.
#pragma once

#include <utility>
#include <vector>

#include "model/detail/live_impl.h"
#include "physics/wheels.h"
#include "state/vehicles.h"

namespace ambf::model {

struct LiveVehicle final : LivePlaced {
  explicit LiveVehicle(std::vector<physics::Wheel> made)
      : wheels(std::move(made)), wanted_(wheels.size()), orders_(wheels.size()) {}

  // Of the newest command in force, cut to what each wheel can do.
  void want(const state::VehicleCommand& command, const state::VehicleInfo& info);
  void want_nothing();
  // Before a step.
  void act(const LiveWorld::Impl& live, std::uint32_t slot, double h_s);
  // After it: its wheels are where the chassis and the ground put them.
  void follow(const LiveWorld::Impl& live, std::uint32_t slot);
  // The same without a step.
  void settle(const LiveWorld::Impl& live, std::uint32_t slot);
  state::WheelState wheel_state(std::size_t i, const state::VehicleWheel& info, const math::Pose& T_body_com) const;

  physics::Wheels wheels;
  bool handbrake = false;

 private:
  void place(const LiveWorld::Impl& live, std::uint32_t slot, const physics::Body& chassis) const;

  std::vector<physics::WheelOrder> wanted_;
  math::Wrench wrench_world_;                // on the chassis
  std::vector<physics::WheelOrder> orders_;  // of the coming step
};

// Null: the vehicle of this slot hangs on no body.
physics::Body* chassis_of(const LiveWorld::Impl& live, std::uint32_t slot);

}  // namespace ambf::model
