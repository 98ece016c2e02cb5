// The noise that a camera's file asks for on its depths. The same frame of the same camera gets the same noise,
// whatever else is drawn. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "state/frame.h"

namespace ambf::render {

std::uint64_t noise_seed(const state::Frame& frame, std::uint32_t camera_slot);

// Adds bias and a normally distributed value with that mean and deviation to every depth but NaN.
void add_noise(std::vector<float>& depth_m, const state::DepthNoise& noise, std::uint64_t seed);

}  // namespace ambf::render
