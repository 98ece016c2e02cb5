// Motion of one joint towards a goal with bounded speed and acceleration, from whatever motion it is in. Pure
// functions, any thread. C++17.
#pragma once

namespace ambf::crtk {

struct JointMotion {
  double position = 0.0, velocity = 0.0;  // m or rad, and per second
};

struct MotionLimits {
  double velocity = 1.0, acceleration = 1.0;  // above 0
};

// One step of h_s seconds. The velocity changes by at most acceleration x h_s, and the joint comes to rest exactly at
// the goal. Returns whether it rests there.
bool advance(JointMotion& motion, double goal, const MotionLimits& limits, double h_s);

}  // namespace ambf::crtk
