// One ray against one collision shape, exactly. Private to physics/rays/. Physics thread; knows no bodies.
#pragma once

#include "physics/detail/shape_data.h"

namespace ambf::physics::detail {

// In the frame of the shape, m.
struct LocalRay {
  btVector3 start, along;  // start + fraction * along, fraction 0 .. 1
};

struct LocalHit {
  double fraction = 1.0;  // what is not nearer than this is not looked for
  btVector3 normal{0, 0, 0};
  int triangle = -1;
  bool hit = false;
};

// Replaces `hit` where the shape is met at a smaller fraction. `from_inside`: a start inside a convex part meets it at
// fraction 0; else that part is not seen.
void cast_ray(const ShapeData& shape, const LocalRay& ray, bool from_inside, LocalHit& hit);

}  // namespace ambf::physics::detail
