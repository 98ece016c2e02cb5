// Random rotations and poses for the tests of mapping and forces: never the identity by chance.
#pragma once

#include <random>

#include "math/rotation.h"
#include "math/types.h"

namespace ambf::devices::testing {

class RandomMotion {
 public:
  explicit RandomMotion(unsigned seed) : rng_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  math::Vec3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  math::Vec3 direction() {
    std::normal_distribution<double> normal;
    return math::normalized(math::Vec3{normal(rng_), normal(rng_), normal(rng_)});
  }
  math::Quat rotation() { return math::from_axis_angle(direction(), uniform(0.2, 3.0)); }
  math::Pose pose(double size = 1.0) { return {vector(size), rotation()}; }

  // A hand's motion within a tick.
  math::Pose moved(const math::Pose& from, double metres, double radians) {
    const math::Quat turned = math::exp(vector(radians)) * from.orientation;
    return {from.position + vector(metres), math::normalized(turned)};
  }

 private:
  std::mt19937 rng_;
};

inline double angle_between(const math::Quat& a, const math::Quat& b) {
  return math::norm(math::log(math::inverse(a) * b));
}

}  // namespace ambf::devices::testing
