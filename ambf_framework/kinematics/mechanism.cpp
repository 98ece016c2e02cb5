#include "kinematics/mechanism.h"

#include <algorithm>
#include <cmath>

#include "kinematics/detail/decompositions.h"
#include "math/rotation.h"

namespace ambf::kinematics {

namespace {

constexpr double kStepAngle = 0.1, kStepDistance = 0.02;  // of a driven joint, between two closings of the loops
constexpr double kLever = 0.1;                            // m: a gap's angle counts as what it is at this distance
constexpr double kClosed = 1e-4;                          // m: the gap of a loop that counts as closed
constexpr double kSettled = 1e-9;                         // of the last correction, rad and m
constexpr double kDifference = 1e-6;                      // rad, m: of numeric derivatives
constexpr double kDecides = 1e-6;  // of the largest: directions in which gaps change less are left alone
constexpr int kMaxIterations = 30;

bool moves(const MechanismJoint& joint) {
  return joint.kind == MechanismJoint::Kind::revolute || joint.kind == MechanismJoint::Kind::prismatic;
}

}  // namespace

math::Pose at_position(const MechanismJoint& joint, double position) {
  const double moved = position - joint.position;
  if (joint.kind == MechanismJoint::Kind::prismatic) {
    return {joint.T_parent_child.position + joint.axis * moved, joint.T_parent_child.orientation};
  }
  if (joint.kind != MechanismJoint::Kind::revolute) return joint.T_parent_child;
  const math::Quat turn = math::from_axis_angle(joint.axis, moved);
  return math::Pose{joint.pivot - math::rotate(turn, joint.pivot), turn} * joint.T_parent_child;
}

Mechanism::Mechanism(const std::vector<MechanismJoint>& joints, std::size_t base, std::size_t tip,
                     const std::vector<std::size_t>& driven)
    : base_(base), tip_(tip) {
  std::size_t bodies = std::max(base, tip) + 1;
  for (const MechanismJoint& joint : joints) bodies = std::max({bodies, joint.parent + 1, joint.child + 1});
  hangs_on_.assign(bodies, -1);
  T_base_.resize(bodies);
  find_tree(joints, driven);
  reaches_ = tip == base || hangs_on_[tip] >= 0;
  if (reaches_) find_what_matters();
}

// Breadth first, so that ways are short; what is left over between bodies that were found closes loops.
void Mechanism::find_tree(const std::vector<MechanismJoint>& joints, const std::vector<std::size_t>& driven) {
  const auto add = [&](std::size_t i, bool closes) {
    const auto moved = std::find(driven.begin(), driven.end(), i);
    links_.push_back({joints[i], moved == driven.end() ? -1 : static_cast<int>(moved - driven.begin()), closes});
  };
  std::vector<std::size_t> found{base_};
  std::vector<bool> used(joints.size(), false);
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const MechanismJoint& joint = joints[i];
      if (joint.kind == MechanismJoint::Kind::point || joint.parent != found[next]) continue;
      if (joint.child == base_ || hangs_on_[joint.child] >= 0) continue;
      hangs_on_[joint.child] = static_cast<int>(links_.size());
      add(i, false);
      used[i] = true;
      found.push_back(joint.child);
    }
  }
  const auto is_found = [&](std::size_t body) { return body == base_ || hangs_on_[body] >= 0; };
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!used[i] && is_found(joints[i].parent) && is_found(joints[i].child)) add(i, true);
  }
}

std::vector<std::size_t> Mechanism::way_to(std::size_t body) const {
  std::vector<std::size_t> way;
  for (int link = hangs_on_[body]; link >= 0; link = hangs_on_[links_[way.back()].joint.parent]) {
    way.push_back(static_cast<std::size_t>(link));
  }
  return way;
}

// The joints of the tree that it closes to a loop.
std::vector<std::size_t> Mechanism::loop_of(const Link& closing) const {
  std::vector<std::size_t> loop = way_to(closing.joint.parent), other = way_to(closing.joint.child);
  while (!loop.empty() && !other.empty() && loop.back() == other.back()) loop.pop_back(), other.pop_back();
  loop.insert(loop.end(), other.begin(), other.end());
  return loop;
}

// The way to the tip, and loops that share a joint with what matters already.
void Mechanism::find_what_matters() {
  for (const std::size_t link : way_to(tip_)) links_[link].matters = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (Link& closing : links_) {
      if (!closing.closes || closing.matters) continue;
      const std::vector<std::size_t> loop = loop_of(closing);
      if (std::none_of(loop.begin(), loop.end(), [&](std::size_t link) { return links_[link].matters; })) continue;
      for (const std::size_t link : loop) links_[link].matters = true;
      closing.matters = grows = loops_ = true;
    }
  }
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].matters && links_[i].driven < 0 && moves(links_[i].joint)) unknown_.push_back(i);
  }
}

const MechanismJoint* Mechanism::loose() const {
  std::vector<bool> in_loop(links_.size(), false);
  for (const Link& closing : links_) {
    if (!closing.closes || !closing.matters) continue;
    for (const std::size_t link : loop_of(closing)) in_loop[link] = true;
  }
  for (const std::size_t link : way_to(tip_)) {
    if (!in_loop[link] && links_[link].driven < 0 && moves(links_[link].joint)) return &links_[link].joint;
  }
  return nullptr;
}

void Mechanism::pose_bodies() {
  T_base_[base_] = {};
  for (const Link& link : links_) {
    if (link.closes) continue;
    T_base_[link.joint.child] = T_base_[link.joint.parent] * at_position(link.joint, link.now);
  }
}

// Of the loops that matter: m, angles at a lever.
std::vector<double> Mechanism::gaps() {
  pose_bodies();
  std::vector<double> made;
  for (const Link& link : links_) {
    if (!link.closes || !link.matters) continue;
    const math::Pose T_found = math::inverse(T_base_[link.joint.parent]) * T_base_[link.joint.child];
    if (link.joint.kind == MechanismJoint::Kind::point) {
      const math::Vec3 on_child = math::inverse(link.joint.T_parent_child) * link.joint.pivot;
      const math::Vec3 gap = T_found * on_child - link.joint.pivot;
      made.insert(made.end(), {gap.x, gap.y, gap.z});
      continue;
    }
    const math::Pose T_wanted = at_position(link.joint, link.now);
    const math::Vec3 gap = T_found.position - T_wanted.position;
    const math::Vec3 turn = math::log(math::inverse(T_wanted.orientation) * T_found.orientation) * kLever;
    made.insert(made.end(), {gap.x, gap.y, gap.z, turn.x, turn.y, turn.z});
  }
  return made;
}

// Least squares of all gaps: loops in a plane say some things twice.
bool Mechanism::close_loops() {
  const auto columns = static_cast<Eigen::Index>(unknown_.size());
  std::vector<double> now = gaps();
  for (int i = 0; i < kMaxIterations && columns > 0; ++i) {
    const auto rows = static_cast<Eigen::Index>(now.size());
    const Eigen::Map<const Eigen::VectorXd> gap(now.data(), rows);
    Eigen::MatrixXd slopes(rows, columns);
    for (Eigen::Index column = 0; column < columns; ++column) {
      double& position = links_[unknown_[static_cast<std::size_t>(column)]].now;
      const double before = position;
      position += kDifference;
      const std::vector<double> after = gaps();
      position = before;
      slopes.col(column) = (Eigen::Map<const Eigen::VectorXd>(after.data(), rows) - gap) / kDifference;
    }
    const Eigen::VectorXd change = solve_lsq(slopes, gap, kDecides);
    for (Eigen::Index column = 0; column < columns; ++column) {
      links_[unknown_[static_cast<std::size_t>(column)]].now -= change[column];
    }
    now = gaps();
    if (change.cwiseAbs().maxCoeff() < kSettled) break;
  }
  return std::all_of(now.begin(), now.end(), [](double gap) { return std::abs(gap) < kClosed; });
}

std::optional<math::Pose> Mechanism::move_to(const std::vector<double>& positions) {
  if (!reaches_) return std::nullopt;
  std::vector<double> from(positions.size(), 0.0);
  double steps = 1.0;
  for (const Link& link : links_) {
    if (link.driven < 0) continue;
    const auto i = static_cast<std::size_t>(link.driven);
    from[i] = link.now;
    const double step = link.joint.kind == MechanismJoint::Kind::prismatic ? kStepDistance : kStepAngle;
    if (loops_) steps = std::max(steps, std::ceil(std::abs(positions[i] - link.now) / step));
  }
  const std::vector<Link> before = links_;
  for (double step = 1.0; step <= steps; step += 1.0) {
    for (Link& link : links_) {
      if (link.driven < 0) continue;
      const auto i = static_cast<std::size_t>(link.driven);
      link.now = from[i] + (positions[i] - from[i]) * (step / steps);
    }
    if (!loops_ || close_loops()) continue;
    links_ = before;
    return std::nullopt;
  }
  pose_bodies();
  return T_base_[tip_];
}

}  // namespace ambf::kinematics
