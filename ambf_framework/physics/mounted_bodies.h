// Bodies that something else places, as a vehicle does its wheels, and what wheels do to the body above them. Physics
// thread; bodies must be in a world.
#pragma once

#include "math/types.h"
#include "physics/body.h"

namespace ambf::physics {

// A mounted body weighs nothing and meets nothing, and its joints are off. What held it lets go.
void set_mounted(Body& body, bool mounted);
bool is_mounted(const Body& body);
// Puts the COM frame of a mounted body there. Wakes nobody.
void place_mounted(Body& body, const math::Pose& T_world_com, const math::Twist& twist_com_world);

// The mean twist of the coming step (COM, world axes) as gravity, damping and what was applied so far make it; joints
// and contacts are not counted.
math::Twist expected_twist(const Body& body);
// As Body::apply_wrench, of what carries the body as contacts do: it does not keep the body awake, and the twist that
// is shown afterwards is the mean one. Sleepers ignore it.
void support(Body& body, const math::Wrench& wrench_com_world);

}  // namespace ambf::physics
