// Groups of keys that only tables of scene/ refer to, and words that several of them share. Constant data.
#pragma once

#include "scene/description.h"
#include "scene/keys.h"

namespace ambf::scene {

struct BlockKind;

template <class Enum>
constexpr Word word(std::string_view text, Enum value) {
  return {text, static_cast<int>(value)};
}

inline constexpr Word kOutputWords[] = {
    word("FORCE", ControllerOutput::force),       word("force", ControllerOutput::force),
    word("EFFORT", ControllerOutput::force),      word("effort", ControllerOutput::force),
    word("VELOCITY", ControllerOutput::velocity), word("velocity", ControllerOutput::velocity),
    word("POSITION", ControllerOutput::position), word("position", ControllerOutput::position)};

namespace group {
extern const Group rates, shaders, gains, geometry, placed_shape, rgb, ambient, inertia, friction, body_damping,
    cartesian_controller, joint_gains, joint_limits, range_xyz, linear_angular, clipping_plane, stereo, resolution,
    depth_noise, mouse, attenuation, soft_body, soft_config, ghost_object, vehicle, wheel, suspension, steering_limits,
    volume, images, sensor, ray, parametric, sensor_friction, actuator, haptic_gain, controller_gain, button_mapping,
    enclosure, skybox;
}  // namespace group

// One file each in blocks/.
namespace kind {
extern const BlockKind body, soft_body, ghost_object, sensor, actuator, joint, vehicle, camera, light, volume;
}  // namespace kind

}  // namespace ambf::scene
