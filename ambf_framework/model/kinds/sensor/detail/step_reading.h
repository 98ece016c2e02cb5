// A sensor whose reading belongs to the last step: it is kept from step to step, saved, and starts anew where steps
// do (after a load or a reset).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/counter_noise.h"
#include "model/kinds/sensor.h"
#include "state/readings.h"

namespace ambf::model {

class LiveStepReading : public LiveSensor {
 public:
  explicit LiveStepReading(const scene::SensorNoise& noise) : noise_(noise) {}

  void read(const LiveWorld::Impl& live, std::uint32_t slot) final {
    measure(live, slot, known_);
    known_ = true;
    add_noise(live);
  }
  void refresh(const LiveWorld::Impl& live, std::uint32_t slot) final {
    if (known_) return;
    measure(live, slot, false);
    known_ = true;
  }
  void forget() final {}
  void reset() final { known_ = false; }
  void fill(const LiveWorld::Impl&, std::uint32_t slot, state::Frame& frame) const final {
    state::SensorReading& reading = state::sensor_readings(frame)[slot];
    reading.linear = linear_;
    reading.angular = angular_;
  }

  // Of a snapshot: whether there is a reading, and the reading; what a type adds follows.
  static constexpr std::size_t kSavedNumbers = 7;
  void save(const LiveWorld::Impl&, std::vector<double>& numbers) const final {
    numbers = {known_ ? 1.0 : 0.0, linear_.x, linear_.y, linear_.z, angular_.x, angular_.y, angular_.z};
    save_extra(numbers);
  }
  void restore(const LiveWorld::Impl&, std::span<const double> numbers) final {
    known_ = numbers[0] != 0.0;
    linear_ = {numbers[1], numbers[2], numbers[3]};
    angular_ = {numbers[4], numbers[5], numbers[6]};
    restore_extra(numbers.subspan(kSavedNumbers));
  }

 protected:
  // Sets the reading. `follows`: there is one of the step before.
  virtual void measure(const LiveWorld::Impl& live, std::uint32_t slot, bool follows) = 0;
  virtual void save_extra(std::vector<double>& /*numbers*/) const {}
  virtual void restore_extra(std::span<const double> /*numbers*/) {}

  math::Vec3 linear_, angular_;

 private:
  // A function of the sensor's identifier and the step, so that runs repeat.
  void add_noise(const LiveWorld::Impl& live) {
    if (noise_.linear == 0.0 && noise_.angular == 0.0) return;
    const auto noise = [&](std::uint64_t first, double deviation) {
      const auto of = [&](std::uint64_t axis) { return base::normal_noise(noise_seed, live.steps, first + axis); };
      return math::Vec3{of(0), of(1), of(2)} * deviation;
    };
    linear_ += noise(0, noise_.linear);
    angular_ += noise(3, noise_.angular);
  }

  const scene::SensorNoise noise_;
  bool known_ = false;  // there is a reading of the last step, or of where steps begin
};

}  // namespace ambf::model
