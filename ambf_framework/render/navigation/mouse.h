// How gestures of the mouse move a view. A view is a camera's pose in its parent's frame (x backwards, y right, z up)
// and how far ahead its target lies. Pixels count to the right and down. Pure functions, any thread.
#pragma once

#include "math/types.h"

namespace ambf::render {

struct View {
  math::Pose T_parent_camera;
  double target_distance_m = 1.0;
};

// The reference's scales, each times the camera's multiplier.
inline constexpr double kPanPerPixel = 0.01;                 // m
inline constexpr double kLookPerPixel = 0.3 / 57.295779513;  // rad
inline constexpr double kOrbitPerPixel = 0.0075;             // rad
inline constexpr double kDollyPerNotch = 0.1;                // m
inline constexpr double kSlow = 0.1;                         // while left Shift is held
inline constexpr double kPitchLimit_rad = 1.5;               // above and below the horizon
inline constexpr double kMinTargetDistance_m = 0.5;

math::Vec3 target_of(const View& view);  // in the parent's frame

// The scene follows the pointer. `metres_per_pixel` from pan_scale().
View pan(const View& view, double right_px, double down_px, double metres_per_pixel);
// At most so fast that the target stays under the pointer. `height_px`: of the picture, `field_of_view_rad`: vertical.
double pan_scale(const View& view, double multiplier, double field_of_view_rad, double height_px);

// The view turns to where the pointer goes: yaw about the parent's z, pitch about its own right axis.
View look(const View& view, double right_px, double down_px, double radians_per_pixel);
// The scene turns with the pointer, about the target.
View orbit(const View& view, double right_px, double down_px, double radians_per_pixel);

// Forwards by so many notches. A target that comes closer than `min_target_m` moves ahead.
View dolly(const View& view, double notches, double multiplier, double min_target_m);

}  // namespace ambf::render
