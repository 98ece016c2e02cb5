// What the panel does with a window's view besides what the mouse does: looks from a side, centres, and writes a camera
// as ADF. Pure functions, any thread.
#pragma once

#include <array>
#include <string>

#include "render/camera/camera.h"
#include "render/navigation/mouse.h"

namespace ambf::render {

enum class Side { front, back, left, right, top, bottom, corner };
inline constexpr std::array<const char*, 7> kSideNames = {"Front", "Back", "Left", "Right", "Top", "Bottom", "Corner"};

// `view` of a camera whose parent's frame is T_world_parent, turned to look at its target from a side of the world:
// front is from +x.
View seen_from(const View& view, const math::Pose& T_world_parent, Side side);
// Shifted so that `point_world` is where it looks, at the same distance and in the same direction.
View centred_on(const View& view, const math::Pose& T_world_parent, const math::Vec3& point_world);
// Shifted along with something that moved by `shift_world`.
View shifted(const View& view, const math::Pose& T_world_parent, const math::Vec3& shift_world);

// To where another camera is.
View moved_to(const View& view, const math::Pose& T_world_parent, const math::Pose& T_world_camera);

// The keys of a camera block, for pasting into an ADF file: location, look at, up and the lens. `parent`: empty for the
// world.
std::string as_adf(const std::string& name, const View& view, const Camera& camera, const std::string& parent);

}  // namespace ambf::render
