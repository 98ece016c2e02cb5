// Values of a body that can be read but hardly be meant: repaired, refused or hinted at, with a finding. Loader thread.
#pragma once

#include "model/detail/findings.h"
#include "physics/shape.h"
#include "scene/description.h"

namespace ambf::model {

// The principal moments that the body gets. No body has one above the sum of the other two: a small excess is hinted
// at, a large one (base::kMaxInertiaExcess) repaired to the nearest moments that a body can have.
math::Vec3 usable_inertia(const math::Vec3& given, const scene::Identity& body, Findings& findings);

// Whether a mesh of so many points may be this body's collision shape: a POINT_CLOUD has a bound
// (base::kMaxCloudPoints).
bool usable_cloud(std::size_t points, const scene::Body& body, Findings& findings);

// Whether the collision shape is small enough for the world (base::kMaxLength_m). Hints at meshes of moving bodies that
// are most likely written in another unit. `key`: where its size comes from.
bool usable_size(const physics::Shape& shape, const scene::Body& body, const char* key, Findings& findings);

}  // namespace ambf::model
