// Pieces of source that several shaders share. Private to render/shaders*.cpp.
#pragma once

namespace ambf::render {

inline constexpr const char* kVersion = "#version 330 core\n";

// Linear light -> display. The tone curve is Khronos' PBR Neutral: colours below 0.8 stay what they are, brighter
// ones roll off without changing hue.
inline constexpr const char* kDisplay = R"(
vec3 tone_mapped(vec3 color) {
  const float start = 0.8 - 0.04, desaturation = 0.15;
  float x = min(color.r, min(color.g, color.b));
  color -= x < 0.08 ? x - 6.25 * x * x : 0.04;
  float peak = max(color.r, max(color.g, color.b));
  if (peak < start) return color;
  float d = 1.0 - start;
  float new_peak = 1.0 - d * d / (peak + d - start);
  color *= new_peak / peak;
  return mix(color, vec3(new_peak), 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0));
}
// The sRGB curve within 0.3 % by square roots, which processors do several times faster than powers.
vec3 srgb(vec3 linear) {
  vec3 a = sqrt(linear), b = sqrt(a), c = sqrt(b);
  return max(0.662002687 * a + 0.684122060 * b - 0.323583601 * c - 0.0225411470 * linear, vec3(0.0));
}
)";

// A calm sky: light grey blue at the horizon, darker above and below. `up` is the sine of the elevation. Display
// values.
inline constexpr const char* kSky = R"(
vec3 sky(float up) {
  const vec3 horizon = vec3(0.80, 0.835, 0.87), zenith = vec3(0.47, 0.55, 0.65), nadir = vec3(0.52, 0.55, 0.58);
  float square = up * up;  // flat at the horizon, so that no line is seen there
  return mix(horizon, up > 0.0 ? zenith : nadir, 1.06 * square / (square + 0.06));
}
)";

}  // namespace ambf::render
