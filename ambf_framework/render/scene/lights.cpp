#include "render/scene/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/rotation.h"
#include "render/shaders/shaders.h"

namespace ambf::render {

namespace {

// What a white sheet that faces a light gets from it. A light that asks for shadows is the key light, the others
// fill; all together give no more than kAllLights.
constexpr double kKeyLight = 1.05, kFillLight = 0.5, kAllLights = 1.6;

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

bool is_focused(const Light& light) { return light.kind == state::LightType::spot && light.spot_exponent != 0.0; }

bool is_attenuated(const Light& light) {
  return light.kind != state::LightType::directional &&
         (light.attenuation_linear != 0.0 || light.attenuation_quadratic != 0.0);
}

std::vector<Light> lights_of(const state::Structure& structure, const ScenePoses& poses, const Camera& viewer) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < structure.lights.size() && lights.size() < kMaxLights; ++i) {
    const math::Pose* T_world_light = poses.of(structure.objects[structure.lights[i].object]);
    if (T_world_light == nullptr) break;
    const state::Beam& beam = i < poses.beams.size() ? poses.beams[i] : structure.lights[i].beam;
    Light light;
    light.point_world = T_world_light->position;
    light.direction_world = math::rotate(T_world_light->orientation, {1.0, 0.0, 0.0});
    light.kind = beam.type;
    light.cutoff_angle_rad = beam.cutoff_angle_rad;
    light.spot_exponent = beam.spot_exponent;
    light.attenuation_constant = beam.attenuation_constant;
    light.attenuation_linear = beam.attenuation_linear;
    light.attenuation_quadratic = beam.attenuation_quadratic;
    light.shadow_quality = beam.shadow_quality;
    lights.push_back(light);
  }
  if (lights.empty()) lights.push_back(shoulder_light(viewer));
  const bool has_key = std::any_of(lights.begin(), lights.end(), [](const Light& l) { return l.shadow_quality > 0; });
  double sum = 0.0;
  for (Light& light : lights) sum += light.intensity = light.shadow_quality > 0 || !has_key ? kKeyLight : kFillLight;
  for (Light& light : lights) light.intensity *= std::min(1.0, kAllLights / sum);
  return lights;
}

std::vector<Camera> shadow_cameras(const Light& light, const Sphere& scene) {
  constexpr double kWidest = 1.3;  // rad, half the angle of view
  constexpr double kFace =
      std::numbers::pi / 2.0 + 0.06;  // rad; wider than a face of the cube, for filters across its edges
  if (scene.radius <= 0.0) return {};
  Camera camera;
  if (light.kind == state::LightType::directional) {
    camera.T_world_camera = looking_at(scene.centre - 2.0 * scene.radius * light.direction_world, scene.centre);
    camera.orthographic_width_m = 2.0 * scene.radius;
    camera.near_m = 0.9 * scene.radius;
    camera.far_m = 40.0 * scene.radius;  // what receives shadows may lie far behind
    return {camera};
  }
  const double distance = math::norm(scene.centre - light.point_world);
  const double cone = std::clamp(light.cutoff_angle_rad, 0.02, kWidest);
  camera.near_m = std::max(distance - scene.radius, 0.02 * (distance + scene.radius));
  camera.far_m = 4.0 * (distance + scene.radius);
  const bool outside = distance > 1.05 * scene.radius;
  const double half_angle = outside ? std::asin(scene.radius / distance) : kWidest;
  if (outside && half_angle < kWidest && (light.kind == state::LightType::point || half_angle < cone)) {
    // The scene is narrower than what the light shines on: look at the scene alone, for finer texels.
    camera.T_world_camera = looking_at(light.point_world, scene.centre);
    camera.field_of_view_rad = 2.0 * half_angle;
    return {camera};
  }
  if (light.kind == state::LightType::spot) {
    camera.T_world_camera = looking_at(light.point_world, light.point_world + light.direction_world);
    camera.field_of_view_rad = 2.0 * cone;
    return {camera};
  }
  std::vector<Camera> cameras;
  for (const math::Vec3& axis : {math::Vec3{1, 0, 0}, math::Vec3{0, 1, 0}, math::Vec3{0, 0, 1}}) {
    for (const double side : {1.0, -1.0}) {
      camera.T_world_camera = looking_at(light.point_world, light.point_world + side * axis);
      camera.field_of_view_rad = kFace;
      cameras.push_back(camera);
    }
  }
  return cameras;
}

int shadow_map_side(int quality) {
  constexpr int kSides[] = {0, 512, 1024, 1024, 2048, 2048};
  return kSides[std::clamp(quality, 0, 5)];
}

ShadowFilter shadow_filter(int quality) {
  constexpr ShadowFilter kFilters[] = {ShadowFilter::none,   ShadowFilter::hard,   ShadowFilter::soft4,
                                       ShadowFilter::soft16, ShadowFilter::soft16, ShadowFilter::contact};
  return kFilters[std::clamp(quality, 0, 5)];
}

}  // namespace ambf::render
