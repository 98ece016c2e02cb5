// The joints of the scene for kinematics, as bodies and joints are in one frame. Any thread. C++17.
#pragma once

#include <vector>

#include "kinematics/mechanism.h"
#include "state/frame.h"

namespace ambf::crtk {

// Bodies are numbered by their slots. Nothing while something is not finite.
std::vector<kinematics::MechanismJoint> mechanism_joints(const state::Frame& frame);

}  // namespace ambf::crtk
