// Open chains of revolute and prismatic axes: forward kinematics, Jacobians, numeric inverse. Pure functions, any
// thread. Joint vectors that are too short or too long count as zeros, or are cut.
#pragma once

#include <string>
#include <vector>

#include "kinematics/answer.h"
#include "math/types.h"

namespace ambf::kinematics {

// One moving axis: motion along or about z after a fixed transform from the frame before.
struct Step {
  math::Pose before;
  int joint = 0;  // index in the joint vector
  bool prismatic = false;
  double ratio = 1.0;  // motion = ratio x joint position
};

struct Chain {
  std::vector<Step> steps;
  math::Pose tip;                  // in the frame of the last axis
  Joints lower, upper;             // may be infinite; their length is the number of joints
  Joints home;                     // within limits
  std::vector<std::string> names;  // of the joints

  std::size_t size() const { return lower.size(); }
};

// T_base_tip.
math::Pose forward(const Chain& chain, const Joints& joints);

// The axes of the tip's velocity. Both mean the point at the tip: along the base's axes, or the tip's.
enum class JacobianFrame { spatial, body };

// 6 x n, row-major: linear (m/s), then angular velocity (rad/s) of the tip for unit joint velocities. CRTK's
// spatial/jacobian and body/jacobian.
std::vector<double> jacobian(const Chain& chain, const Joints& joints, JacobianFrame frame);

// Distance (m) and angle (rad) between poses.
struct PoseDifference {
  double distance = 0.0, angle = 0.0;
};
PoseDifference difference(const math::Pose& a, const math::Pose& b);

// Joints that reach the pose, found by damped least squares within limits from the seed, home and six more points: a
// solution that it does not find may exist.
Answer inverse(const Chain& chain, const math::Pose& pose, const Joints& seed);

// A joint of ADF: pivots (m) and unit axes in the body frames of parent and child, offset of the child and of the joint
// (rad, about the axis; also of a prismatic one).
struct AdfGeometry {
  math::Vec3 parent_pivot{}, child_pivot{};
  math::Vec3 parent_axis{0.0, 0.0, 1.0}, child_axis{0.0, 0.0, 1.0};
  double child_offset = 0.0, joint_offset = 0.0;
};
// T_parent_child with the joint at 0.
math::Pose at_zero(const AdfGeometry& joint);
// Adds an axis after the chain's tip, which becomes the child's body frame; the chain's first base is the first
// parent's body frame.
void append(Chain& chain, const AdfGeometry& joint, bool prismatic, double lower, double upper,
            const std::string& name);
// The same for a joint that does not move.
void append_fixed(Chain& chain, const AdfGeometry& joint);

}  // namespace ambf::kinematics
