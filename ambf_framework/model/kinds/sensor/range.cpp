// Range sensors: distances in metres, with noise that depends on step, element and seed alone.
#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "model/kinds/sensor/detail/ray_reader.h"

namespace ambf::model {
namespace {

// SplitMix64 (Steele, Lea, Flood 2014): a value for each counter.
std::uint64_t mixed(std::uint64_t counter) {
  std::uint64_t z = counter + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

// In [0, 1).
double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

struct LiveRange final : LiveSensor {
  LiveRange(const scene::Sensor& described, const std::vector<state::SensorRay>& rays)
      : reader(rays, RayRules::own_body, described.rays_per_step), noise(described.range_noise) {
    reader.forget(hits);
    // Sensors at different places differ without a seed of their own.
    base::Fnv1a hash;
    hash.add_text(described.parent);
    hash.add_bytes(&described.T_parent_sensor, sizeof described.T_parent_sensor);
    seed = mixed(hash.value() + static_cast<std::uint64_t>(described.noise_seed));
  }
  void read(const LiveWorld::Impl& live, std::uint32_t slot) override { reader.read(live, slot, hits); }
  void refresh(const LiveWorld::Impl& live, std::uint32_t slot) override { reader.refresh(live, slot, hits); }
  void forget() override { reader.forget(hits); }
  void settle(const LiveWorld::Impl& live, std::uint32_t slot) override {
    forget();
    refresh(live, slot);
  }

  // Box and Muller.
  double error_m(std::uint64_t step, std::size_t element) const override {
    if (!noise.on) return 0.0;
    const std::uint64_t counter = mixed(mixed(seed + noise_seed) + step) + 2 * element;
    const double radius = noise.std_dev * std::sqrt(-2.0 * std::log(1.0 - unit(mixed(counter))));
    return noise.mean + noise.bias + radius * std::cos(2.0 * std::numbers::pi * unit(mixed(counter + 1)));
  }

  RayReader reader;
  state::DepthNoise noise;
  std::uint64_t seed = 0;
};

}  // namespace

SensorType range_sensor_type() {
  SensorType row;
  row.type = state::SensorType::range;
  row.make = [](const scene::Sensor& described,
                const std::vector<state::SensorRay>& rays) -> std::unique_ptr<LiveSensor> {
    return std::make_unique<LiveRange>(described, rays);
  };
  return row;
}

}  // namespace ambf::model
