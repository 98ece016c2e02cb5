// The lights of a picture, from the structure's list and the frame's poses. Pure functions, any thread.
#pragma once

#include <vector>

#include "render/camera/camera.h"
#include "render/scene/motion.h"
#include "render/shaders/shaders.h"
#include "state/structure.h"

namespace ambf::render {

struct Light {
  state::LightType kind = state::LightType::spot;
  math::Vec3 point_world, direction_world;  // direction: where it shines, unit
  double cutoff_angle_rad = 0.7, spot_exponent = 0.7;
  double attenuation_constant = 1.0, attenuation_linear = 0.0, attenuation_quadratic = 0.0;
  double intensity = 1.0;
  int shadow_quality = 0;  // 0 .. 5
};

bool is_focused(const Light& light);     // a spot light weaker off its axis
bool is_attenuated(const Light& light);  // weaker with the distance

// At most kMaxLights of them (the first). When there are none, one from behind the viewer's shoulder. Intensities are
// shared so that many lights do not burn the picture out.
std::vector<Light> lights_of(const state::Structure& structure, const ScenePoses& poses, const Camera& viewer);

// What the light must see to shadow all of `scene`: one camera at its place; six (+x, -x, +y, -y, +z, -z) for a point
// light inside the scene; none when there is no scene.
std::vector<Camera> shadow_cameras(const Light& light, const Sphere& scene);
int shadow_map_side(int quality);  // texels
ShadowFilter shadow_filter(int quality);

}  // namespace ambf::render
