#include "model/detail/view_builder.h"

#include <cmath>
#include <filesystem>

#include "math/rotation.h"

namespace ambf::model {

math::Pose camera_pose(const scene::Camera& camera) {
  const math::Vec3 back = math::normalized(camera.location - camera.look_at, {1.0, 0.0, 0.0});
  math::Vec3 right = math::cross(camera.up, back);
  if (math::norm(right) < 1e-9)
    right = math::cross(std::abs(back.z) < 0.9 ? math::Vec3{0, 0, 1} : math::Vec3{0, 1, 0}, back);
  right = math::normalized(right);
  const math::Vec3 up = math::cross(back, right);
  const double R[9] = {back.x, right.x, up.x, back.y, right.y, up.y, back.z, right.z, up.z};
  return {camera.location, math::from_matrix(R)};
}

math::Pose light_pose(const scene::Light& light) {
  return {light.location, math::rotation_between({1.0, 0.0, 0.0}, math::normalized(light.direction, {0.0, 0.0, -1.0}))};
}

state::ShaderFiles shader_files(const scene::Shaders& shaders) {
  const auto file = [&](const std::string& name) {
    return name.empty() ? std::string() : (std::filesystem::path(shaders.path) / name).string();
  };
  return {file(shaders.vertex), file(shaders.fragment)};
}

state::WorldLook world_look(const scene::World& world) {
  state::WorldLook look;
  look.shaders = shader_files(world.shaders);
  if (!world.skybox) return look;
  const scene::Skybox& box = *world.skybox;
  const auto file = [&](const std::string& name) { return (std::filesystem::path(box.path) / name).string(); };
  look.skybox = {file(box.right), file(box.left),           file(box.top), file(box.bottom), file(box.front),
                 file(box.back),  shader_files(box.shaders)};
  return look;
}

state::CameraInfo camera_info(const scene::Camera& camera) {
  state::CameraInfo info;
  info.parent_name = camera.parent;
  info.lens = camera.lens;
  info.visible = camera.visible;
  info.monitor = camera.monitor;
  info.controlling_devices = camera.controlling_devices;
  info.pan = camera.mouse.pan;
  info.rotate = camera.mouse.rotate;
  info.scroll = camera.mouse.scroll;
  info.arcball = camera.mouse.arcball;
  info.look_at = camera.look_at;
  info.image = camera.image;
  info.depth = camera.depth;
  info.depth_noise = camera.depth_noise;
  info.preprocessing_shaders = shader_files(camera.preprocessing_shaders);
  info.depth_shaders = shader_files(camera.depth_compute_shaders);
  info.multipass = camera.multipass;
  return info;
}

state::LightInfo light_info(const scene::Light& light) {
  state::LightInfo info;
  info.parent_name = light.parent;
  info.beam = light.beam;
  return info;
}

scene::Camera default_camera(const std::string& name_space) {
  scene::Camera camera;
  camera.identity.identifier = camera.identity.name = "default_camera";
  camera.identity.name_space = name_space;
  camera.location = {4.0, 0.0, 2.0};
  camera.look_at = {-1.0, 0.0, 0.0};
  return camera;
}

scene::Light default_light(const std::string& name_space) {
  scene::Light light;
  light.identity.identifier = light.identity.name = "default_light";
  light.identity.name_space = name_space;
  light.location = {2.0, 2.0, 5.0};
  light.direction = {-2.0, -2.0, -5.0};  // towards the origin
  return light;
}

}  // namespace ambf::model
