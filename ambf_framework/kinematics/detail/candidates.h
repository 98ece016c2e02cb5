// Solutions without limits, and the choice among them. Inside this folder.
#pragma once

#include <vector>

#include "kinematics/arm.h"
#include "kinematics/detail/frames.h"

namespace ambf::kinematics {

constexpr double kNothing = 1e-10;  // a length (m) or the sine of an angle that gives no direction

struct Candidate {
  Joints joints;
  std::vector<bool> free;  // left open by the pose, as in the seed
  bool missed = false;     // not reached: the nearest pose
};
using Candidates = std::vector<Candidate>;

// PSM and Raven: 8 (six joints); ECM: 4.
Candidates remote_center(const Arm& arm, const Frame& target, const Joints& seed);
// `offset` (rad) moves the free parameter away from the seed's.
Candidates gimbal(const Arm& arm, const Frame& target, const Joints& seed, double offset);
Candidates spherical_shoulder_and_wrist(const Arm& arm, const Frame& target, const Joints& seed, double offset);

// Joint motion (rad) after which the chain has the same pose again: whole turns of every axis that the joint moves, so
// more than one of its own where a ratio is a fraction. 0: none (prismatic, or no small number of turns).
double period(const Chain& chain, std::size_t joint);
// Whole periods added: within limits as near to the seed as possible, else as near to the limits as possible.
double wrapped(const Chain& chain, std::size_t joint, double value, double seed);
// Distance beyond the limits, m or rad; 0 within rounding of them.
double excess(const Chain& chain, std::size_t joint, double value);
// Width of the joint's range, 1 where there is none: what makes rad and m comparable.
double range(const Chain& chain, std::size_t joint);
Joints clipped(const Chain& chain, const Joints& joints);

// The legal candidate nearest to the seed; where there is none, the nearest to the limits.
Answer choose(const Arm& arm, const Frame& target, const Joints& seed, const Candidates& found);

// What a call was given, made usable: false where it is not.
bool usable(const Chain& chain, const math::Pose& pose, const Joints& seed);
Answer invalid(const Chain& chain, const Joints& seed);

}  // namespace ambf::kinematics
