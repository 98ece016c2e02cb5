// What a Grasp is made of. Private to physics/. Physics thread once in a world.
#pragma once

#include <optional>

#include "physics/grasp.h"
#include "physics/joints/joint_data.h"

namespace ambf::physics::detail {

// While a world has grasps, each of its bodies has room for so many at a time; a further one allocates once.
constexpr std::size_t kRoomForGrasps = 4;

struct GraspData {
  explicit GraspData(const GraspOptions& given) : options(given) {}

  GraspOptions options;
  WorldData* world = nullptr;
  std::optional<JointData> joint;  // in place, so that holding allocates nothing; absent: it holds nothing

  bool connects(const BodyData& body) const { return joint && (&joint->parent == &body || &joint->child == &body); }
  // The joint of a grasp of these frames, not in the world yet.
  JointData& make(BodyData& holder, BodyData& held, const btTransform& frame_in_holder,
                  const btTransform& frame_in_held);
};

}  // namespace ambf::physics::detail
