#include "render/drawing/fixed_function.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "math/rotation.h"

namespace ambf::render {

namespace {

// Of each light that is on, beside white diffuse and specular light: masks made of gl_FrontLightProduct[0].ambient
// need some.
constexpr float kLightAmbient = 0.2F;

float f(double x) { return static_cast<float>(x); }

void set_light_off(Program& p, const std::string& light) {
  const auto set = [&](const char* name, auto... values) { p.set((light + name).c_str(), values...); };
  for (const char* color : {"ambient", "diffuse", "specular"}) set(color, 0.0F, 0.0F, 0.0F, 1.0F);
  set("position", 0.0F, 0.0F, 1.0F, 0.0F);
  set("halfVector", 0.0F, 0.0F, 1.0F, 0.0F);
  set("spotDirection", 0.0F, 0.0F, -1.0F);
  set("spotCutoff", 180.0F);
  set("spotCosCutoff", -1.0F);
  set("constantAttenuation", 1.0F);
}

void set_light(Program& p, const std::string& light, const Light& from, const Mat4& world_to_eye) {
  const auto set = [&](const char* name, auto... values) { p.set((light + name).c_str(), values...); };
  set("ambient", kLightAmbient, kLightAmbient, kLightAmbient, 1.0F);
  set("diffuse", 1.0F, 1.0F, 1.0F, 1.0F);
  set("specular", 1.0F, 1.0F, 1.0F, 1.0F);
  const auto at = transform(world_to_eye, from.point_world);
  const std::array<float, 16>& m = world_to_eye.m;
  const math::Vec3& d = from.direction_world;
  const math::Vec3 direction{m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
                             m[2] * d.x + m[6] * d.y + m[10] * d.z};
  const bool parallel = from.kind == state::LightType::directional;
  const math::Vec3 position = parallel ? -direction : math::Vec3{at[0], at[1], at[2]};
  set("position", f(position.x), f(position.y), f(position.z), parallel ? 0.0F : 1.0F);
  const math::Vec3 half = math::normalized(math::normalized(position) + math::Vec3{0.0, 0.0, 1.0});
  set("halfVector", f(half.x), f(half.y), f(half.z), 0.0F);
  set("spotDirection", f(direction.x), f(direction.y), f(direction.z));
  const bool spot = from.kind == state::LightType::spot;
  set("spotExponent", spot ? f(from.spot_exponent) : 0.0F);
  set("spotCutoff", spot ? f(from.cutoff_angle_rad * 180.0 / std::numbers::pi) : 180.0F);
  set("spotCosCutoff", spot ? f(std::cos(from.cutoff_angle_rad)) : -1.0F);
  set("constantAttenuation", f(from.attenuation_constant));
  set("linearAttenuation", f(from.attenuation_linear));
  set("quadraticAttenuation", f(from.attenuation_quadratic));
}

const ShadowView* first_single_view(const ShadowMap& shadows) {
  std::size_t view = 0;
  for (const LightVariant& light : shadows.lights()) {
    if (light.shadow_views == 1 && light.filter != ShadowFilter::none) return &shadows.views()[view];
    view += static_cast<std::size_t>(light.shadow_views);
  }
  return nullptr;
}

}  // namespace

void set_fixed_function_picture(Program& p, const Mat4& world_to_eye, const Mat4& eye_to_clip,
                                const std::vector<Light>& lights) {
  p.set("ambf_ProjectionMatrix", eye_to_clip);
  p.set("projectionMat", eye_to_clip);
  p.set("viewMat", world_to_eye);
  for (std::size_t i = 0; i < kMaxLights; ++i) {
    const std::string light = "ambf_LightSource[" + std::to_string(i) + "].";
    if (i < lights.size()) {
      set_light(p, light, lights[i], world_to_eye);
    } else {
      set_light_off(p, light);
    }
  }
}

void set_fixed_function_shadow(Program& p, const Mat4& world_to_eye, const ShadowMap& shadows) {
  const ShadowView* view = first_single_view(shadows);
  Mat4 eye_to_texture;
  if (view != nullptr) {
    eye_to_texture = view->world_to_texture * inverse(world_to_eye);
    p.set("ambf_ShadowTile", view->tile[0], view->tile[1], view->tile[2], view->tile[3]);
  } else {
    eye_to_texture.m[15] = 1.0F;  // (0, 0, 0, 1): nothing lies nearer to the light
    p.set("ambf_ShadowTile", 0.0F, 0.0F, 1.0F, 1.0F);
  }
  const std::array<float, 16>& m = eye_to_texture.m;
  const char* const planes[] = {"ambf_EyePlaneS[1]", "ambf_EyePlaneT[1]", "ambf_EyePlaneR[1]", "ambf_EyePlaneQ[1]"};
  for (std::size_t row = 0; row < 4; ++row) p.set(planes[row], m[row], m[4 + row], m[8 + row], m[12 + row]);
}

// The file's numbers, as the display shows them: old shaders know no linear light.
void set_fixed_function_material(Program& p, const Surface& surface) {
  const auto set = [&](const char* name, const std::array<float, 3>& c) {
    p.set(name, c[0], c[1], c[2], surface.alpha);
  };
  set("ambf_FrontMaterial.emission", surface.given.emission);
  set("ambf_FrontMaterial.ambient", surface.given.ambient);
  set("ambf_FrontMaterial.diffuse", surface.given.diffuse);
  set("ambf_FrontMaterial.specular", surface.given.specular);
  p.set("ambf_FrontMaterial.shininess", surface.shininess);
}

void set_fixed_function_place(Program& p, const Mat4& world_to_eye, const Mat4& eye_to_clip,
                              const InstanceData& instance) {
  Mat4 part_to_world;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column)
      part_to_world.m[4 * column + row] = instance.rows[4 * row + column];
  }
  part_to_world.m[15] = 1.0F;
  const Mat4 part_to_eye = world_to_eye * part_to_world;
  p.set("ambf_ModelViewMatrix", part_to_eye);
  p.set("ambf_ModelViewProjectionMatrix", eye_to_clip * part_to_eye);
  // Inverse and transposed; scales are the same along all axes, so it is the rotation over the square of the scale.
  const std::array<float, 16>& m = part_to_eye.m;
  const float square = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
  std::array<float, 9> normal{};
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t row = 0; row < 3; ++row) normal[3 * column + row] = m[4 * column + row] / square;
  }
  p.set("ambf_NormalMatrix", normal);
}

}  // namespace ambf::render
