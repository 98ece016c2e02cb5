// From the descriptions of cameras and lights to their frames and what Structure has of them. Pure functions, any
// thread.
#pragma once

#include "math/types.h"
#include "scene/description.h"
#include "state/structure.h"

namespace ambf::model {

// Camera frame: x backwards (location - look at), y right, z up; where `up` is along the view, any right-hand side will
// do.
math::Pose camera_pose(const scene::Camera& camera);
// Shines along +x.
math::Pose light_pose(const scene::Light& light);

// All but object and parent_object.
state::ShaderFiles shader_files(const scene::Shaders& shaders);
state::WorldLook world_look(const scene::World& world);
state::CameraInfo camera_info(const scene::Camera& camera);
state::LightInfo light_info(const scene::Light& light);

// The world file's own where it names none (ADF 3).
scene::Camera default_camera(const std::string& name_space);
scene::Light default_light(const std::string& name_space);

}  // namespace ambf::model
