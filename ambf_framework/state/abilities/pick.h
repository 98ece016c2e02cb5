// The ability to grasp and drag bodies with a pointer. Any thread; nothing waits for the physics thread. C++17.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "math/types.h"
#include "state/ids.h"

namespace ambf::state {

// The first object hit by a pick ray.
struct PickHit {
  ObjectId object;
  math::Vec3 point_world;
  double distance_m = 0.0;
};

// One pointer's grasp of at most one body. Several pointers may grasp several bodies, or the same one. Destroying the
// port releases the body. Not thread-safe.
class PickPort {
 public:
  virtual ~PickPort() = default;
  virtual std::uint32_t id() const = 0;  // PickState::picker
  // Casts a ray on the physics thread and grasps the first body it hits at the hit point, until the next pick() or
  // release(). `done` must be quick; it is called on another thread after the frame that shows the grasp.
  virtual void pick(const math::Vec3& from_world, const math::Vec3& to_world,
                    std::function<void(bool, const PickHit&)> done) = 0;
  // Sets the target of the grasped point. A spring pulls a moving body there; a static body is moved. While paused, a
  // moving body is moved too, with everything jointed to it, unless joints connect it to something static.
  virtual void drag(const math::Vec3& target_world) = 0;
  virtual void release() = 0;
};

class PickAbility {
 public:
  virtual ~PickAbility() = default;
  // Null when base::kMaxPicks ports exist.
  virtual std::unique_ptr<PickPort> make_pick_port() = 0;
};

}  // namespace ambf::state
