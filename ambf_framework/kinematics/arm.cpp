#include "kinematics/arm.h"

#include "kinematics/detail/candidates.h"

namespace ambf::kinematics {
namespace {

constexpr double kSearchStep = 5.0 * kPi / 180.0;

Candidates candidates(const Arm& arm, const Frame& target, const Joints& seed, double offset) {
  switch (arm.solver) {
    case Solver::remote_center: return remote_center(arm, target, seed);
    case Solver::gimbal: return gimbal(arm, target, seed, offset);
    case Solver::spherical_shoulder_and_wrist: return spherical_shoulder_and_wrist(arm, target, seed, offset);
    case Solver::numeric: break;
  }
  return {};
}

// How far the search for a free parameter that limits allow goes to either side, in steps.
int search_steps(Solver solver) {
  return solver == Solver::gimbal ? 60 : solver == Solver::spherical_shoulder_and_wrist ? 36 : 0;
}

}  // namespace

void build_steps(Arm& arm, Convention convention, const math::Pose& foot, const math::Pose& tip) {
  const bool modified = convention == Convention::modified;
  Frame carried;  // what standard tables have behind an axis
  for (const Row& row : arm.rows) {
    Frame link, along;
    along.r = rot_z(row.theta);
    along.p.z() = row.d;
    if (modified) {
      link.r = rot_x(row.alpha);
      link.p = link.r * Vector(row.a, 0.0, 0.0);
      carried = link;
    }
    const bool prismatic = arm.prismatic[static_cast<std::size_t>(row.joint)];
    arm.steps.push_back({to_pose(carried * along), row.joint, prismatic, row.ratio});
    carried = Frame{};
    if (!modified) {
      carried.r = rot_x(row.alpha);
      carried.p = Vector(row.a, 0.0, 0.0);
    }
  }
  arm.tip = to_pose(carried * to_frame(tip));
  if (!arm.steps.empty()) arm.steps.front().before = to_pose(to_frame(foot) * to_frame(arm.steps.front().before));
}

Answer inverse(const Arm& arm, const math::Pose& pose, const Joints& seed) {
  if (arm.solver == Solver::numeric) return inverse(static_cast<const Chain&>(arm), pose, seed);
  if (!usable(arm, pose, seed)) return invalid(arm, seed);
  const Frame target = to_frame(pose);
  const Joints near = clipped(arm, seed);
  Answer answer = choose(arm, target, near, candidates(arm, target, near, 0.0));
  for (int k = 1; k <= search_steps(arm.solver); ++k) {
    for (double offset : {k * kSearchStep, -k * kSearchStep}) {
      if (answer.status != Status::out_of_limits) return answer;
      Answer other = choose(arm, target, near, candidates(arm, target, near, offset));
      if (other.reached()) answer = std::move(other);
    }
  }
  return answer;
}

std::vector<Solution> solutions(const Arm& arm, const math::Pose& pose, const Joints& seed) {
  std::vector<Solution> made;
  if (!usable(arm, pose, seed)) return made;
  const Joints near = clipped(arm, seed);
  for (const Candidate& candidate : candidates(arm, to_frame(pose), near, 0.0)) {
    Solution solution{candidate.joints, !candidate.missed};
    for (std::size_t i = 0; i < arm.size(); ++i) {
      solution.joints[i] = wrapped(arm, i, solution.joints[i], near[i]);
      if (excess(arm, i, solution.joints[i]) > 0.0) solution.legal = false;
    }
    made.push_back(std::move(solution));
  }
  return made;
}

std::map<std::string, double> to_adf(const Arm& arm, const ArmPosition& position) {
  std::map<std::string, double> made;
  for (std::size_t i = 0; i < arm.adf_joints.size() && i < position.joints.size(); ++i) {
    const AdfJoint& joint = arm.adf_joints[i];
    made[joint.name] = joint.sign * (position.joints[i] - joint.offset);
  }
  if (position.joints.empty()) return made;
  for (const JawHalf& half : arm.adf_jaw) {
    made[half.name] = half.wrist * position.joints.back() + 0.5 * position.opening;
  }
  return made;
}

std::optional<ArmPosition> from_adf(const Arm& arm, const std::map<std::string, double>& positions) {
  ArmPosition made;
  for (const AdfJoint& joint : arm.adf_joints) {
    const auto found = positions.find(joint.name);
    if (found == positions.end()) return std::nullopt;
    made.joints.push_back(joint.sign * found->second + joint.offset);
  }
  if (arm.adf_jaw.empty()) return made;
  double yaw = 0.0;
  for (const JawHalf& half : arm.adf_jaw) {
    const auto found = positions.find(half.name);
    if (found == positions.end()) return std::nullopt;
    yaw += half.wrist * found->second / static_cast<double>(arm.adf_jaw.size());
    made.opening += found->second;
  }
  made.joints.push_back(yaw);
  return made;
}

}  // namespace ambf::kinematics
