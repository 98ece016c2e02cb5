// Which body and which cameras a device moves: Fig. 3.7 of the dissertation, over the structure of what is loaded. Its
// multibody is loaded before (a device names a model file of its own); then root links are searched among all bodies,
// those of other devices' multibodies included, so the order of devices does not matter. Pure functions, any thread.
#pragma once

#include <string>
#include <vector>

#include "scene/description.h"
#include "state/set_point.h"
#include "state/structure.h"

namespace ambf::devices {

struct Places {
  state::ObjectId body;  // invalid: none (yet); `problem` says why
  std::string body_name;
  std::vector<state::ObjectId> jaw_joints;  // below it, with limits
  state::EffectorGains own_gains;
  std::vector<state::ObjectId> cameras;  // first: the frame of reference
  std::vector<std::string> camera_names;
  std::string problem;
};

// `multibody`: name of the model that was loaded for the device; empty: none was, or not yet.
Places find_places(const state::Structure& structure, const scene::InputDevice& device, const std::string& multibody);

// Gains of a body that has no controller with forces for output: a spring that carries its mass, and that of what hangs
// on it, at kOwnFrequency, critically damped.
inline constexpr double kOwnFrequency = 40.0;  // rad/s
state::EffectorGains own_gains(const state::Structure& structure, std::uint32_t body);

}  // namespace ambf::devices
