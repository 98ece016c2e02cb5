// Proximity sensors: each ray finds the nearest body other than the sensor's own.
#include "model/kinds/sensor/detail/ray_reader.h"

namespace ambf::model {
namespace {

struct LiveProximity final : LiveSensor {
  LiveProximity(const std::vector<state::SensorRay>& rays, int rays_per_step)
      : reader(rays, RayRules::own_body, rays_per_step) {
    reader.forget(hits);
  }
  void read(const LiveWorld::Impl& live, std::uint32_t slot) override { reader.read(live, slot, hits); }
  void refresh(const LiveWorld::Impl& live, std::uint32_t slot) override { reader.refresh(live, slot, hits); }
  void forget() override { reader.forget(hits); }
  void settle(const LiveWorld::Impl& live, std::uint32_t slot) override {
    forget();
    refresh(live, slot);
  }

  RayReader reader;
};

}  // namespace

SensorType proximity_sensor_type() {
  SensorType row;
  row.make = [](const scene::Sensor& described,
                const std::vector<state::SensorRay>& rays) -> std::unique_ptr<LiveSensor> {
    return std::make_unique<LiveProximity>(rays, described.rays_per_step);
  };
  return row;
}

}  // namespace ambf::model
