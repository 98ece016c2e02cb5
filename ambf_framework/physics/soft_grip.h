// Holds nodes of soft bodies on a rigid body that is chosen while the world runs: what actuators hold them with
// (EQUATIONS 16); or at places in the world, as pointers do. Each node hangs there by a spring; the holder feels the
// opposite force at the node, in the same step and before joints are solved. Stable for any hardness: springs are
// solved together with the links (soft/held_nodes.cpp). Made off the physics thread; once it holds anything only the
// physics thread may call anything here. Never owns bodies.
//
// It ends with its bodies, when either is reset, frozen or mounted, and by World::reset().
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>

#include "math/types.h"
#include "physics/body.h"
#include "physics/soft_body.h"

namespace ambf::physics {

namespace detail {
struct SoftGripData;
}

struct SoftGripOptions {
  double hardness = 1000.0;                                    // N/m a node, >= 0
  double damping = 1.0;                                        // N s/m a node, >= 0
  double max_force = std::numeric_limits<double>::infinity();  // N a node
  bool first = false;                                          // it acts before others, whichever began earlier
};

struct HeldNode {
  SoftBody* body = nullptr;
  std::size_t node = 0;
  math::Vec3 place;        // m, in the holder's COM frame; without a holder: world
  math::Vec3 force_world;  // N, on the node in the last step
};

class SoftGrip {
 public:
  static constexpr std::size_t kMaxNodes = 48;  // three of each of 16 faces

  explicit SoftGrip(const SoftGripOptions& options = {});
  ~SoftGrip();  // lets go
  SoftGrip(const SoftGrip&) = delete;
  SoftGrip& operator=(const SoftGrip&) = delete;

  // From the next step on, where it is now: nothing jumps. The first one chooses the holder. False and no change: it
  // holds that node already, or kMaxNodes, or by another holder; either is frozen; or both have not one world.
  bool hold(Body& holder, SoftBody& body, std::size_t node);
  // The same at a place in the holder's COM frame, of frozen ones, too: what was saved.
  bool hold_at(Body& holder, SoftBody& body, std::size_t node, const math::Vec3& place);
  // Where it is now, without a holder: shift() moves the place.
  bool hold_in_world(const World& world, SoftBody& body, std::size_t node);
  void shift(const math::Vec3& way_world);  // all places
  void set_max_force(double max_force);
  void release();  // does nothing while it holds nothing

  Body* holder() const;  // null: it holds nothing, or in the world
  std::span<const HeldNode> held() const;
  // Where a held node would be without load.
  math::Vec3 target(const HeldNode& node) const;
  bool holds_any_of(const SoftBody& body) const;

 private:
  std::unique_ptr<detail::SoftGripData> data_;
};

}  // namespace ambf::physics
