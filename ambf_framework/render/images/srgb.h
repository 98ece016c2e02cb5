// From numbers of pictures and files to light. Pure functions, any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace ambf::render {

using LinearColor = std::array<float, 3>;  // light, not the display's coding of it

// ADF and MTL colours were chosen by looking at a display, so they are read as sRGB.
inline float linear_from_srgb(float value) {
  const float v = std::clamp(value, 0.0F, 1.0F);
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

}  // namespace ambf::render
