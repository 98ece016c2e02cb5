// What a Body is made of. Private to physics/. Physics thread once in a world.
#pragma once

#include <cstdint>
#include <vector>

#include "physics/body.h"
#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct WorldData;
struct JointData;

// A ball within a convex part of a body, about the part's centre.
struct SweptBall {
  btVector3 centre;  // in the COM frame
  double radius;     // m
};

struct BodyData {
  BodyData(const BodyDefinition& parameters, Body& owner);

  Body& owner;
  BodyDefinition initial;
  SharedShape shape;
  btTransform T_com_body;
  btVector3 inertia;
  btRigidBody rigid;
  WorldData* world = nullptr;

  std::vector<const BodyData*> excluded;  // do not collide with these; once for each joint that says so
  std::vector<JointData*> joints;         // in the world, attached to this body

  double contact_margin = 0.0;                 // m, how far outside its shape contacts of this body are kept
  double rolling_lever_limit = SIMD_INFINITY;  // m; of rolling friction
  bool stiffened = false;                      // its inertia is increased
  bool frozen = false;                         // World::freeze_diverged(); static to Bullet
  bool mounted = false;                        // set_mounted() (mounted_bodies.h); static to Bullet
  double linear_retained = 1.0;                // of the velocity after one step of damping
  double angular_retained = 1.0;

  // Free motion (free_motion.h). Whether the twist is that of the pose's instant, not the mean of the last step.
  bool instant_twist = true;
  // Of the step under way: the gravity that no force balances, the torque of forces, the twist before its impulses, the
  // mean twist and the pose expected of it, and angular momentum with what forces add. World axes.
  btVector3 falls_by{0, 0, 0}, start_torque{0, 0, 0};
  btVector3 start_linear{0, 0, 0}, start_angular{0, 0, 0}, mean_linear{0, 0, 0}, mean_turn{0, 0, 0};
  btVector3 angular_momentum{0, 0, 0};
  btTransform next_pose = btTransform::getIdentity();
  // As the step found it, and what acts on it from outside (N, Nm): for a step that is taken in parts (step_parts.cpp).
  btTransform step_pose = btTransform::getIdentity();
  btVector3 step_linear{0, 0, 0}, step_angular{0, 0, 0}, step_force{0, 0, 0}, step_torque{0, 0, 0};
  bool begun = false;            // in this step; a body that wakes in its middle begins in the next
  bool round = true;             // rotates as a ball does
  bool slow_turn = true;         // in a step: what joints do depends little on how it turns
  bool pushed_by_joint = false;  // as a force, beside the rows
  bool supported = false;        // by support() (mounted_bodies.h) in this step

  // Static bodies: the pose given last (so that giving it again does nothing), and where move_to() carries it.
  math::Pose given_pose;
  bool moving_to = false;
  math::Pose move_target;

  // Where the body was when its contacts were last computed, and whether it has moved away from there.
  btTransform collided_pose = btTransform::getIdentity();
  bool collided = false;       // false: compute them, whatever the pose
  bool moved = true;           // in this step
  double same_contacts = 0.0;  // m, what counts as not having moved

  // Of the last step with a crowd (contacts/crowd_limit.h): moving bodies near it, and those of the crowd that it
  // meets.
  std::uint32_t near_bodies = 0, met_bodies = 0;

  // What is swept along its way when it moves by more than swept_from in a step (contacts/swept_motion.h).
  std::vector<SweptBall> swept_balls;
  double swept_from = SIMD_INFINITY;  // m, the smallest of their radii

  // Sleeping: where it was when it last moved noticeably, and how long that is ago.
  btTransform rest_pose = btTransform::getIdentity();
  double rest_time = 0.0;  // s
  double reach = 0.0;      // m, of the farthest point from the COM
  bool may_sleep = true;

  // How far any point of the body may have gone from where it would be at `then`: an upper bound, m.
  double displacement_from(const btTransform& then) const;

  bool is_static() const { return rigid.isStaticOrKinematicObject(); }  // also while it is frozen
  // A spring's force of this step acts for half of it: it does not move yet, or flies.
  bool begins_motion() const { return is_static() || instant_twist; }
  bool asleep() const { return !is_static() && rigid.getActivationState() == ISLAND_SLEEPING; }
  void wake();
  // Puts the COM frame there, with everything that depends on it but the broadphase.
  void place(const btTransform& T_world_com);
  void set_initial_state();
  // Before a step of h seconds: its inertia for that step, which joints under tension increase
  // (joints/taut_bodies.cpp).
  void stiffen(double h);
  // Its inertia until stiffen() is called next, as the inverse in principal axes; never less than its own.
  void set_stiffness(const btVector3& inverse_inertia);
  void end_stiffness();
  // While Bullet does not know the body, or before a restart.
  void set_frozen(bool freeze);
  void set_mounted(bool mount);
};

inline BodyData& data_of(const btCollisionObject& object) { return *static_cast<BodyData*>(object.getUserPointer()); }

// One has no collision groups, or they share one.
bool groups_meet(const BodyData& a, const BodyData& b);
// Neither joints nor groups nor sets forbid that these two touch.
bool may_meet(const BodyData& a, const BodyData& b);
// The same, and one of them moves.
bool may_collide(const BodyData& a, const BodyData& b);

}  // namespace ambf::physics::detail
