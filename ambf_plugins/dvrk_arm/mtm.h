// Kinematics of a master (MTM) of the da Vinci research kit, for forces by joint efforts: what a wrench at the tip
// means for each joint, and the effort that keeps the redundant wrist away from its singularity. Frames: standard DH,
// each joint about z of the frame before it; B is the arm's base (local/measured_cp). Pure functions, any thread;
// nothing allocates. SI units, radians. C++17.
#pragma once

#include <array>
#include <cstddef>

#include "math/types.h"

namespace ambf::dvrk_arm {

inline constexpr std::size_t kMtmJoints = 7;
using MtmJoints = std::array<double, kMtmJoints>;

struct MtmFrames {
  std::array<math::Vec3, kMtmJoints> axis, origin;  // of the joints, in B
  math::Pose T_base_tip;                            // frame 7: the wrist's centre
};
MtmFrames mtm_frames(const MtmJoints& position);

// J^T w: efforts of a wrench at the tip, in B.
MtmJoints mtm_efforts(const MtmFrames& frames, const math::Wrench& wrench_base);

// Effort of joint 4 (the platform) that turns joint 6 to its middle while the hand's orientation stays (Eq. 7.1,
// corrected: EQUATIONS 18). With the hand's orientation held, de/dq4 = -cos(q5): without that factor it runs away
// beyond 90 degrees of joint 5.
double mtm_platform_effort(const MtmJoints& position, const MtmJoints& velocity);

// Within what the motors bear.
MtmJoints mtm_bounded(const MtmJoints& efforts);

}  // namespace ambf::dvrk_arm
