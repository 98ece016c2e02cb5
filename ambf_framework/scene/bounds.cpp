#include "scene/bounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/bounds.h"

namespace ambf::scene {

namespace {

// The first row that fits counts; the last fits every key.
constexpr Bound kBounds[] = {
    {"m", "", "positions and sizes", base::kMaxLength_m},
    {"kg", "", "masses that are not 0", base::kMaxMass_kg, base::kMinMass_kg},
    {"kg m^2", "", "moments of inertia", base::kMaxInertia},
    {"", "scale", "scales", base::kMaxScale, base::kMinScale},
    {"rad", "", "angles", base::kMaxAngle_rad},
    {"rad or m", "", "joint positions", base::kMaxLength_m},
    {"m or rad", "", "rest positions of springs", base::kMaxLength_m},
    {"m/s^2", "", "gravity", base::kMaxAcceleration},
    {"N", "", "forces", base::kMaxForce},
    {"Ns or Nms", "", "impulses of motors", base::kMaxForce},
    {"N/m or Nm/rad", "", "stiffnesses", base::kMaxGain},
    {"Ns/m or Nms/rad", "", "dampings", base::kMaxGain},
    {"Hz", "", "rates", base::kMaxRate_hz},
    {"", "", "gains, and every other number", base::kMaxGain},
};

}  // namespace

std::span<const Bound> bounds() { return kBounds; }

const Bound& bound_of(const Key& key) {
  const auto fits = [&key](const Bound& bound) {
    return bound.unit == key.unit && (bound.key.empty() || bound.key == key.name);
  };
  const auto found = std::find_if(std::begin(kBounds), std::end(kBounds), fits);
  return found == std::end(kBounds) ? *std::prev(std::end(kBounds)) : *found;
}

std::string out_of_bounds(double number, const Key& key) {
  const Bound& bound = bound_of(key);
  const double size = std::abs(number);
  const std::string unit = bound.unit.empty() ? "" : " " + std::string(bound.unit);
  if (size > bound.max && !(number > key.max)) return "at most " + text_of(bound.max) + unit;
  if (size < bound.min && number != 0.0) return "at least " + text_of(bound.min) + unit;
  return {};
}

}  // namespace ambf::scene
