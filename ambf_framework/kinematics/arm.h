// Known arms: a chain of Denavit-Hartenberg rows with closed-form inverse kinematics. Their numbers are in
// ambf_client_py/ambf_client/kinematics/arms.yaml, which adf/arms.h reads and which explains the terms; the Python
// client computes the same with the same formulas. Sources: the robots' published tables (docs/kinematics.md). Pure
// functions, any thread.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/chain.h"

namespace ambf::kinematics {

// modified (Craig): T = Rx(alpha) Tx(a) Rz(theta) Tz(d); standard: T = Rz(theta) Tz(d) Tx(a) Rx(alpha).
enum class Convention { modified, standard };

// A row (m, rad): ratio x the joint's position is added to theta, or to d if it is prismatic.
struct Row {
  int joint = 0;
  double alpha = 0.0, a = 0.0, d = 0.0, theta = 0.0, ratio = 1.0;
};

enum class Solver {
  remote_center,                 // shaft through the base's origin: PSM, Raven (6 joints), ECM (4)
  gimbal,                        // MTM: 7 joints, the platform angle (joint 4) from the seed
  spherical_shoulder_and_wrist,  // KUKA: 7 joints, the elbow as near to the seed's as its circle allows
  numeric,
};

// Position in the table = sign x position in an ADF model + offset.
struct AdfJoint {
  std::string name;
  double sign = 1.0, offset = 0.0;
};
// Half of a jaw in an ADF model: ADF position = wrist x the arm's last joint + opening / 2.
struct JawHalf {
  std::string name;
  double wrist = 1.0;
};
struct Jaw {
  std::string name;
  double lower = 0.0, upper = 0.0;  // opening, rad
  double max_effort = 0.0;          // Nm
};

struct Arm : Chain {
  std::string name, tool;
  Solver solver = Solver::numeric;
  std::vector<Row> rows;
  std::vector<bool> prismatic;     // by joint
  std::vector<double> max_effort;  // Nm or N, by joint; 0: unknown
  std::optional<Jaw> jaw;
  std::vector<std::vector<double>> coupling;  // joints = coupling x disks (motors of an MTM); empty: unknown
  std::vector<AdfJoint> adf_joints;
  std::vector<JawHalf> adf_jaw;  // none or two
};

// Makes steps and tip of the rows; `foot`: where they start, in the arm's base; `tip`: the tip in the last row's frame.
void build_steps(Arm& arm, Convention convention, const math::Pose& foot, const math::Pose& tip);

// The nearest solution to the seed. Redundant arms keep what the seed gives (see Solver) where limits allow, else the
// nearest value that they allow, sought in steps of 5 degrees.
Answer inverse(const Arm& arm, const math::Pose& pose, const Joints& seed);

struct Solution {
  Joints joints;  // without limits; whole turns as near to the seed as limits allow
  bool legal = false;
};
// All closed-form solutions: 8, an ECM has 4; none for Solver::numeric, or if pose or seed is not finite.
std::vector<Solution> solutions(const Arm& arm, const math::Pose& pose, const Joints& seed);

// Joint vector with the jaw's opening (rad; 0 without jaw), and an ADF model's joint positions by name.
struct ArmPosition {
  Joints joints;
  double opening = 0.0;
};
std::map<std::string, double> to_adf(const Arm& arm, const ArmPosition& position);
// None where a name is missing.
std::optional<ArmPosition> from_adf(const Arm& arm, const std::map<std::string, double>& positions);

}  // namespace ambf::kinematics
