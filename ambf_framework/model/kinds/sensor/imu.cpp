// Inertial measurement units: specific force and angular velocity of the point where the sensor sits.
#include <algorithm>

#include "math/rotation.h"
#include "model/kinds/sensor.h"
#include "model/kinds/sensor/detail/step_reading.h"
#include "physics/world.h"

namespace ambf::model {
namespace {

// The mean acceleration of the last step is that of its body's twist over the step: a_p = a + alpha x r + w x (w x r).
class LiveImu final : public LiveStepReading {
 public:
  using LiveStepReading::LiveStepReading;
  static constexpr std::size_t kSaved = kSavedNumbers + 6;

 private:
  void measure(const LiveWorld::Impl& live, std::uint32_t slot, bool follows) override {
    const physics::Body* body = carrier_of(live, slot);
    const math::Twist now = body == nullptr ? math::Twist{} : body->twist();
    const math::Pose T_world_sensor = pose_of_sensor(live, slot);
    math::Vec3 acceleration;
    if (follows && body != nullptr) {
      const double h = live.physics->options().step;
      const math::Vec3 arm = T_world_sensor.position - body->com_pose().position;
      const math::Vec3 turning = (now.angular - before_.angular) * (1.0 / h);
      acceleration = (now.linear - before_.linear) * (1.0 / h) + math::cross(turning, arm) +
                     math::cross(now.angular, math::cross(now.angular, arm));
    }
    before_ = now;
    const math::Quat R_sensor_world = math::inverse(T_world_sensor.orientation);
    linear_ = math::rotate(R_sensor_world, acceleration - live.physics->options().gravity);
    angular_ = math::rotate(R_sensor_world, now.angular);
  }
  void save_extra(std::vector<double>& numbers) const override {
    for (const math::Vec3& v : {before_.linear, before_.angular}) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  }
  void restore_extra(std::span<const double> numbers) override {
    before_ = {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  }

  math::Twist before_;  // of its body, one step ago
};

}  // namespace

SensorType imu_sensor_type() {
  SensorType row;
  row.type = state::SensorType::imu;
  row.make = [](const scene::Sensor& described, const std::vector<state::SensorRay>&) -> std::unique_ptr<LiveSensor> {
    return std::make_unique<LiveImu>(described.noise);
  };
  row.casts_rays = false;
  row.saved_numbers = [](const state::SensorInfo&) { return LiveImu::kSaved; };
  return row;
}

}  // namespace ambf::model
