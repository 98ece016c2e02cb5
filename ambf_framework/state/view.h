// How cameras see, how lights shine and what the world looks like: plain data that ADF files set and programs change
// while the simulation runs. Any thread, C++17.
#pragma once

#include <string>

#include "math/types.h"

namespace ambf::state {

// How a perspective picture differs from one of square pixels with the camera's axis in its middle. In heights of the
// picture, so that it holds for every resolution: a wider picture shows more at both sides.
struct Optics {
  // Beyond these no picture shows anything that can be recognised: of the focal lengths to each other, and of the axis.
  static constexpr double kMaxRatio = 100.0, kMaxAside = 10.0;

  double focal_ratio = 1.0;                  // horizontal to vertical focal length, both in pixels
  double axis_right = 0.0, axis_down = 0.0;  // from the picture's middle to where the axis meets it
  double skew = 0.0;  // of vertical focal lengths: a point at slope 1 downwards is drawn so much further to the right
};

// Of a camera; live values are in CameraState::lens.
struct Lens {
  double near_m = 0.1, far_m = 10.0;  // clipping planes
  double field_of_view_rad = 0.7;     // 2 atan(height / (2 focal length)): vertical where the axis is in the middle
  Optics optics;                      // without effect while the projection is orthographic
  bool orthographic = false;
  double orthographic_width_m = 0.0;  // kept while the projection is perspective
  bool stereo = false;
  double eye_separation_m = 0.2,
         focal_length_m = 0.5;  // focal length: distance of the plane where both eyes see the same
};

enum class LightType { spot, point, directional };

// Of a light; live values are in LightState::beam.
struct Beam {
  LightType type = LightType::spot;
  double cutoff_angle_rad = 0.7;  // spot: from the axis to the edge of the cone
  double spot_exponent = 0.7;
  double attenuation_constant = 1.0, attenuation_linear = 0.0, attenuation_quadratic = 0.0;  // 1, 1/m, 1/m^2
  int shadow_quality = 0;                                                                    // 0 (none) .. 5
};

inline bool operator==(const Optics& a, const Optics& b) {
  return a.focal_ratio == b.focal_ratio && a.axis_right == b.axis_right && a.axis_down == b.axis_down &&
         a.skew == b.skew;
}
inline bool operator==(const Lens& a, const Lens& b) {
  return a.near_m == b.near_m && a.far_m == b.far_m && a.field_of_view_rad == b.field_of_view_rad &&
         a.optics == b.optics && a.orthographic == b.orthographic && a.orthographic_width_m == b.orthographic_width_m &&
         a.stereo == b.stereo && a.eye_separation_m == b.eye_separation_m && a.focal_length_m == b.focal_length_m;
}
inline bool operator==(const Beam& a, const Beam& b) {
  return a.type == b.type && a.cutoff_angle_rad == b.cutoff_angle_rad && a.spot_exponent == b.spot_exponent &&
         a.attenuation_constant == b.attenuation_constant && a.attenuation_linear == b.attenuation_linear &&
         a.attenuation_quadratic == b.attenuation_quadratic && a.shadow_quality == b.shadow_quality;
}

// The user's own shaders: full paths of GLSL files. Empty: none.
struct ShaderFiles {
  std::string vertex, fragment;
  bool given() const { return !vertex.empty() || !fragment.empty(); }
};

// What a camera publishes besides its state: every interval-th picture of it.
struct ImageStream {
  bool on = false;
  unsigned interval = 1;
  unsigned width = 640, height = 480;  // px
};

// Added to depths, along the viewing ray: m.
struct DepthNoise {
  bool on = false;
  double mean = 0.0, std_dev = 0.0, bias = 0.0;
};

// A cube of six pictures around everything: full paths of image files.
struct Skybox {
  std::string right, left, top, bottom, front, back;
  ShaderFiles shaders;
  bool given() const { return !right.empty(); }
};

// What belongs to no object.
struct WorldLook {
  Skybox skybox;
  ShaderFiles shaders;  // of bodies without their own
};

// Empty when fit to use, else what is wrong: NaN, near >= far, angles, widths or ratios out of range.
std::string check(const Optics& optics);
std::string check(const Lens& lens);
std::string check(const Beam& beam);

}  // namespace ambf::state
