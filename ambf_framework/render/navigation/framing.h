// The view that shows everything there is, for a world without a camera. Pure functions, any thread.
#pragma once

#include <vector>

#include "render/navigation/mouse.h"
#include "render/scene/scene_batches.h"
#include "state/frame.h"

namespace ambf::render {

// Around each thing that is drawn, but for what is so large that it must be ground or sky; around that too when there
// is nothing else.
std::vector<Sphere> things_in(const SceneBatches& scene, const std::vector<math::Pose>& T_world_body);

// Of a frame, for who keeps no SceneBatches. Slow: makes one.
std::vector<Sphere> things_in(const state::Frame& frame);

struct Framing {
  Camera camera;
  View view;  // the same in the world's frame, with the target in the middle of all things
};
// From the front right and above, as near as shows all of `things` (at least one).
Framing framing(const std::vector<Sphere>& things, double aspect);

}  // namespace ambf::render
