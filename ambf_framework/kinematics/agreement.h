// Whether the joints of a model move a tip as an arm's Denavit-Hartenberg rows say. Pure, any thread; takes
// milliseconds.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinematics/arm.h"
#include "kinematics/mechanism.h"

namespace ambf::kinematics {

struct Agreement {
  enum class Verdict {
    agrees,
    differs,      // by `distance` and `angle`
    not_the_way,  // `joint` is not below the base, or does not lead to the next ones
    not_closed,   // the joints' ranges take a loop of the model apart
    unknown       // `joint` moves the tip too, and nothing says how: it is none of the arm's, and in no loop
  };
  Verdict verdict = Verdict::unknown;
  double distance = 0.0, angle = 0.0;  // the largest of the tip, m and rad
  std::string joint;                   // of the model; differs: the one whose motion shows most of it
  // From the base body's frame to where the rows start. What the joints' motion leaves open of it is 0.
  double base_distance = 0.0, base_angle = 0.0;
};

// More than this is no agreement.
inline constexpr double kAgreedDistance = 1e-3, kAgreedAngle = 0.0175;  // m, rad (1 degree)

// Moves each of the arm's joints by itself, then all at once, in the middle of their ranges. Where the rows start and
// where their tip is on the last body is taken as it fits best: a model does not say it. `joints` and `base`: as
// Mechanism takes them; names count without blanks.
Agreement compare(const Arm& arm, const std::vector<MechanismJoint>& joints, std::size_t base);

}  // namespace ambf::kinematics
