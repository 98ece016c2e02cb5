#include "render/lights.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "render/shaders.h"

namespace ambf::render {

namespace {

// One light gives a white sheet that faces it this much; each further one adds less.
constexpr double kFirstLight = 1.15, kAllLights = 1.7;

Light shoulder_light(const Camera& viewer) {
  Light light;
  const math::Pose& T = viewer.T_world_camera;
  const math::Vec3 aside = 0.4 * right(T) + 0.6 * up(T);
  light.point_world = T.position + aside + 0.5 * backward(T);
  light.direction_world = math::normalized(-1.0 * (backward(T) + 0.3 * aside));
  light.cutoff_angle_rad = 1.5;
  return light;
}

}  // namespace

std::vector<Light> lights_of(const state::Structure& structure, const ScenePoses& poses, const Camera& viewer) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < structure.lights.size() && i < poses.lights.size(); ++i) {
    if (lights.size() == kMaxLights) break;
    const state::LightInfo& info = structure.lights[i];
    Light light;
    light.point_world = poses.lights[i].position;
    light.direction_world = math::rotate(poses.lights[i].orientation, {1.0, 0.0, 0.0});
    light.cutoff_angle_rad = info.cutoff_angle_rad;
    light.spot_exponent = info.spot_exponent;
    light.attenuation_constant = info.attenuation_constant;
    light.attenuation_linear = info.attenuation_linear;
    light.attenuation_quadratic = info.attenuation_quadratic;
    light.shadow_quality = info.shadow_quality;
    lights.push_back(light);
  }
  if (lights.empty()) lights.push_back(shoulder_light(viewer));
  const double count = static_cast<double>(lights.size());
  for (Light& light : lights) light.intensity = std::min(kFirstLight, kAllLights / count);
  return lights;
}

bool shadow_camera(const Light& light, const Sphere& scene, Camera& camera) {
  constexpr double kWidest = 1.3;  // rad, half the angle of view
  if (scene.radius <= 0.0) return false;
  const double distance = math::norm(scene.centre - light.point_world);
  const double cone = std::clamp(light.cutoff_angle_rad, 0.02, kWidest);
  if (distance > 1.05 * scene.radius && std::asin(scene.radius / distance) < cone) {
    // Outside, and the scene is narrower than the cone: look at the scene alone, for finer texels.
    camera.T_world_camera = looking_at(light.point_world, scene.centre);
    camera.field_of_view_rad = 2.0 * std::asin(scene.radius / distance);
  } else {
    camera.T_world_camera = looking_at(light.point_world, light.point_world + light.direction_world);
    camera.field_of_view_rad = 2.0 * cone;
  }
  camera.near_m = std::max(distance - scene.radius, 0.02 * (distance + scene.radius));
  camera.far_m = distance + 2.0 * scene.radius;  // what receives shadows may lie a little behind
  camera.orthographic_width_m = 0.0;
  return true;
}

int shadow_map_side(int quality) {
  constexpr int kSides[] = {0, 512, 768, 1024, 1536, 2048};
  return kSides[std::clamp(quality, 0, 5)];
}

}  // namespace ambf::render
