// A camera and a light for scenes that tests write as structs, named as files name them: "CAMERA eye" is /test/eye.
#pragma once

#include <string>

#include "scene/description.h"

namespace ambf {

inline scene::Camera test_camera(const math::Vec3& location = {}, const std::string& parent = "") {
  scene::Camera camera;
  camera.identity.identifier = "CAMERA eye";
  camera.identity.name = "eye";
  camera.identity.name_space = "/test/";
  camera.location = location;
  camera.parent = parent;
  return camera;
}

inline scene::Light test_light(const math::Vec3& location = {}) {
  scene::Light light;
  light.identity.identifier = "LIGHT lamp";
  light.identity.name = "lamp";
  light.identity.name_space = "/test/";
  light.location = location;
  return light;
}

}  // namespace ambf
