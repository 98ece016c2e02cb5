// The first hit of a ray on what a window shows: drawn surfaces, and collision shapes where they are shown. Does not
// use physics, so no body is touched or woken. Pure function, any thread.
#pragma once

#include <optional>
#include <vector>

#include "math/types.h"
#include "render/camera/camera.h"
#include "render/scene/body_looks.h"

namespace ambf::render {

struct SurfaceHit {
  std::uint32_t body = state::kNone;  // slot
  math::Vec3 point_body, point_world;
};

// `looks`: of the visuals, by slot. A ray passes hidden bodies; it hits wireframes as if they had faces.
std::optional<SurfaceHit> first_surface(const state::Structure& structure, const std::vector<math::Pose>& T_world_body,
                                        const std::vector<BodyLook>& looks, bool collision_shapes, const Ray& ray);

}  // namespace ambf::render
