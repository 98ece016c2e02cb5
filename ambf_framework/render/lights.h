// The lights of a picture, from the structure's list and the frame's poses. Pure functions, any thread.
#pragma once

#include <vector>

#include "render/camera.h"
#include "render/motion.h"
#include "state/structure.h"

namespace ambf::render {

struct Light {
  math::Vec3 point_world, direction_world;  // direction: where it shines, unit
  double cutoff_angle_rad = 0.7, spot_exponent = 0.7;
  double attenuation_constant = 1.0, attenuation_linear = 0.0, attenuation_quadratic = 0.0;
  double intensity = 1.0;
  int shadow_quality = 0;  // 0 .. 5
};

// At most kMaxLights of them (the first). When there are none, one from behind the viewer's shoulder. Intensities are shared so that
// many lights do not burn the picture out.
std::vector<Light> lights_of(const state::Structure& structure, const ScenePoses& poses, const Camera& viewer);

// What the light must see to shadow all of `scene`: a camera at its place. False when no picture can be taken from there (the
// light is inside the scene's bounds and shines wider than a camera can).
bool shadow_camera(const Light& light, const Sphere& scene, Camera& camera);
int shadow_map_side(int quality);  // texels

}  // namespace ambf::render
