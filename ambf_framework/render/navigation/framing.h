// The view that shows all of some things: of a world without a camera, or of what was loaded. Pure functions, any
// thread.
#pragma once

#include <vector>

#include "render/navigation/mouse.h"
#include "render/scene/scene_batches.h"
#include "state/frame.h"

namespace ambf::render {

// Around each thing that is drawn, but for the room (object_kind.h) and what is so large that it must be ground or
// sky; around these too when there is nothing else.
std::vector<Sphere> things_in(const state::Structure& structure, const SceneBatches& scene,
                              const std::vector<math::Pose>& T_world_body);
// The same of models with ids above `newer_than`; none when there are none.
std::vector<Sphere> things_of_models(const state::Structure& structure, const SceneBatches& scene,
                                     const std::vector<math::Pose>& T_world_body, state::ModelId newer_than);

// Of a frame, for who keeps no SceneBatches. Slow: makes one.
std::vector<Sphere> things_in(const state::Frame& frame);

struct Framing {
  Camera camera;
  View view;  // the same in the world's frame, with the target in the middle of all things
};
// From the front right and above, as near as shows all of `things` (at least one).
Framing framing(const std::vector<Sphere>& things, double aspect);
// The same with the angle and the direction of view of `like`, given in the world's frame.
Framing framing(const std::vector<Sphere>& things, double aspect, const Camera& like);

}  // namespace ambf::render
