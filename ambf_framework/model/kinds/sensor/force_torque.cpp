// Force torque sensors: what a joint does to its child, as force and torque at the sensor.
#include "math/rotation.h"
#include "model/kinds/sensor.h"
#include "model/kinds/sensor/detail/step_reading.h"

namespace ambf::model {
namespace {

class LiveForceTorque final : public LiveStepReading {
 public:
  using LiveStepReading::LiveStepReading;
  static constexpr std::size_t kSaved = kSavedNumbers;

 private:
  void measure(const LiveWorld::Impl& live, std::uint32_t slot, bool follows) override {
    linear_ = angular_ = {};
    const std::uint32_t joint = state::sensors(*live.structure)[slot].joint;
    if (!follows || joint == state::kNone) return;
    const physics::Joint& measured = *live.tables.joints()[joint].joint;
    const math::Wrench wrench = measured.reaction_on_child();
    const math::Pose T_world_sensor = pose_of_sensor(live, slot);
    const math::Vec3 arm = measured.child().com_pose().position - T_world_sensor.position;
    const math::Quat R_sensor_world = math::inverse(T_world_sensor.orientation);
    linear_ = math::rotate(R_sensor_world, wrench.force);
    angular_ = math::rotate(R_sensor_world, wrench.torque + math::cross(arm, wrench.force));
  }
};

}  // namespace

SensorType force_torque_sensor_type() {
  SensorType row;
  row.type = state::SensorType::force_torque;
  row.make = [](const scene::Sensor& described, const std::vector<state::SensorRay>&) -> std::unique_ptr<LiveSensor> {
    return std::make_unique<LiveForceTorque>(described.noise);
  };
  row.casts_rays = false;
  row.saved_numbers = [](const state::SensorInfo&) { return LiveForceTorque::kSaved; };
  return row;
}

}  // namespace ambf::model
