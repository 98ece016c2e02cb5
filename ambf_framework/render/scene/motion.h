// Where everything is at the moment a picture shows: the newest frame when physics publishes faster than the display
// draws, else a moment between the two newest frames, so that slow physics still moves smoothly (one frame late). No
// OpenGL. Main thread.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "math/types.h"
#include "state/frame.h"

namespace ambf::render {

struct ScenePoses {
  std::vector<math::Pose> bodies;               // in the world, by slot
  std::vector<std::vector<math::Pose>> placed;  // of objects with a parent: by the kind's number, then slot
  std::vector<state::Lens> lenses;              // of the cameras
  std::vector<state::Beam> beams;               // of the lights
  std::vector<math::Vec3> nodes;                // of soft bodies: node_positions(), m

  // Null for an object without a pose (a joint), or one that is newer than these poses.
  const math::Pose* of(const state::ObjectInfo& object) const;
};

class Motion {
 public:
  // Copies the poses of a newer frame; the frame itself may go afterwards.
  void take(const state::Frame& frame);

  // Poses to draw at `now_ns` (steady clock). Empty before the first frame.
  const ScenePoses& at(std::int64_t now_ns);

  const std::shared_ptr<const state::Structure>& structure() const { return newest_.structure; }

 private:
  struct Instant {
    std::uint64_t sequence = 0, epoch = 0;
    std::int64_t steady_ns = 0;
    std::shared_ptr<const state::Structure> structure;
    ScenePoses poses;
  };
  Instant older_, newest_;
  ScenePoses between_;
};

}  // namespace ambf::render
