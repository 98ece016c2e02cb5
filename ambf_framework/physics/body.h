// A rigid body. Made off the physics thread; from World::add() to World::remove() only the physics thread may call
// anything here. Never owns its world, joints or names. SI units; "world" vectors are in world axes, the twist is
// that of the centre of mass (COM). The body frame is the ADF's (the mesh's); T_body_com places the COM frame in it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "math/types.h"
#include "physics/shape.h"
#include "scene/description.h"

namespace ambf::physics {

namespace detail {
struct BodyData;
}

struct BodyDefinition {
  double mass = 1.0;                  // kg; 0: static
  std::optional<math::Vec3> inertia;  // principal, kg m^2, in the COM frame; absent: from the shape
  math::Pose T_body_com;              // must be the one the shape was built with
  math::Pose T_world_body;            // initial pose
  scene::Surface surface;
  std::optional<math::Vec3> gravity;   // m/s^2; absent: the world's
  SharedShape shape;                   // null: empty
  std::vector<int> collision_groups;   // bodies with groups collide only with bodies without, or sharing one
  std::uint32_t no_collision_set = 0;  // bodies of the same set (not 0) never collide with each other
  std::uint32_t user_index = 0;        // for the owner; not used here
};

class Body {
 public:
  explicit Body(const BodyDefinition& parameters);
  ~Body();  // leaves its world; its joints must be gone. Off the physics thread only once it has left
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  bool is_static() const;
  double mass() const;
  math::Vec3 inertia() const;  // principal, as used
  const math::Pose& T_body_com() const;
  std::uint32_t user_index() const;
  void set_user_index(std::uint32_t index);

  math::Pose pose() const;      // T_world_body
  math::Pose com_pose() const;  // T_world_com
  math::Pose initial_com_pose() const;
  // Of the COM, world axes. In flight (forces alone acted in the last step) and where it was set: at the instant of
  // pose(). Else, held by a joint or in touch: the mean over the last step, with which the body came to pose().
  math::Twist twist() const;
  math::Vec3 velocity_at(const math::Vec3& point_world) const;

  // Teleports; the twist stays, as that of this instant. Wakes the body and what touched it before or touches it now.
  // Setting the pose it already has does nothing.
  void set_pose(const math::Pose& T_world_body);
  void set_twist(const math::Twist& twist_com_world);
  // What gravity adds to a twist set now, on the mean of the coming step (m/s): half of what a whole step adds, all of
  // it under Bullet's solvers.
  math::Vec3 gravity_on_set_twist() const;
  // The wrench (COM, world axes) which in one step does what set_twist() does at once. 0 outside a world.
  math::Wrench wrench_of_set_twist(const math::Twist& twist_com_world) const;
  // Static bodies: the next step carries the body there, with the velocity that takes, so that friction carries along
  // what rests on it; then it stands still again. Moving bodies: as set_pose.
  void move_to(const math::Pose& T_world_body);

  // Forces last for one step and add up. Static bodies ignore them. Zero does not wake a sleeper, all else does.
  void apply_wrench(const math::Wrench& wrench_com_world);
  void apply_force(const math::Vec3& force_world, const math::Vec3& point_world);
  void apply_torque(const math::Vec3& torque_world);
  void apply_impulse(const math::Vec3& impulse_world, const math::Vec3& point_world);  // Ns, at once
  math::Wrench applied_wrench() const;  // what has been applied since the last step, gravity excepted (COM, world)

  void set_gravity(const std::optional<math::Vec3>& gravity);  // absent: the world's
  math::Vec3 gravity() const;

  // Also for contacts that exist already.
  void set_surface(const scene::Surface& surface);
  scene::Surface surface() const;

  void wake();
  bool asleep() const;
  bool frozen() const;  // World::freeze_diverged()
  // A body that may never sleep (it is observed closely, or moved by a plugin behind our back).
  void set_sleeping_allowed(bool allowed);

  // Initial pose, no velocity, no force, not frozen.
  void reset();

  detail::BodyData& data() const { return *data_; }

 private:
  std::unique_ptr<detail::BodyData> data_;
};

}  // namespace ambf::physics
