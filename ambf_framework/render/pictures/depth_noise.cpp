#include "render/pictures/detail/depth_noise.h"

#include <cmath>

#include "base/hash.h"

namespace ambf::render {

namespace {

// SplitMix64 (Steele, Lea, Flood 2014): a value for each counter, so that a pixel's noise depends on nothing but seed
// and place.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }  // [0, 1)

}  // namespace

std::uint64_t noise_seed(const state::Frame& frame, std::uint32_t camera_slot) {
  const state::Structure& structure = *frame.structure;
  base::Fnv1a hash;
  hash.add_text(structure.objects[structure.cameras[camera_slot].object].name);
  return mixed(hash.value() ^ mixed(frame.sim_step));
}

void add_noise(std::vector<float>& depth_m, const state::DepthNoise& noise, std::uint64_t seed) {
  if (!noise.on) return;
  constexpr double kTwoPi = 6.283185307179586;
  const double shift = noise.mean + noise.bias;
  // Box and Muller: two values at a time.
  for (std::size_t i = 0; i < depth_m.size(); i += 2) {
    const double radius = noise.std_dev * std::sqrt(-2.0 * std::log(1.0 - unit(mixed(seed + i))));
    const double angle = kTwoPi * unit(mixed(seed + i + 1));
    depth_m[i] += static_cast<float>(shift + radius * std::cos(angle));
    if (i + 1 < depth_m.size()) depth_m[i + 1] += static_cast<float>(shift + radius * std::sin(angle));
  }
}

}  // namespace ambf::render
