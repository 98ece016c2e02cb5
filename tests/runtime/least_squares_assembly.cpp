#include "tests/runtime/least_squares_assembly.h"

#include <cmath>
#include <limits>

namespace ambf::runtime::test {
namespace {

// Residuals and their derivative by small motions (translation of the body origin, then rotation, both in world axes).
struct Row {
  double value = 0.0;
  std::uint32_t body[2] = {state::kNone, state::kNone};  // variable numbers
  math::Vec3 linear[2], angular[2];
};

struct Problem {
  const std::vector<JointPlaces>& joints;
  std::vector<std::uint32_t> variable;  // of each body slot; kNone: it does not move
  double arm_m;
  std::vector<math::Quat> held;  // R_parent_child of each joint in the frame
  std::vector<double> shift;     // m, of the child's pivot along the parent's axis in the frame
};

std::vector<Row> residuals(const Problem& problem, const std::vector<math::Pose>& poses) {
  std::vector<Row> rows;
  const auto add = [&](const JointPlaces& joint, double value, const math::Vec3& linear, const math::Vec3& parent_turn,
                       const math::Vec3& child_turn) {
    Row row;
    row.value = value;
    row.body[0] = problem.variable[joint.parent];
    row.body[1] = problem.variable[joint.child];
    row.linear[0] = -linear;
    row.linear[1] = linear;
    row.angular[0] = parent_turn;
    row.angular[1] = child_turn;
    rows.push_back(row);
  };
  for (const JointPlaces& joint : problem.joints) {
    const math::Pose& parent = poses[joint.parent];
    const math::Pose& child = poses[joint.child];
    const math::Vec3 to_parent = math::rotate(parent.orientation, joint.parent_pivot);
    const math::Vec3 to_child = math::rotate(child.orientation, joint.child_pivot);
    const math::Vec3 gap = child.position + to_child - parent.position - to_parent;
    const math::Vec3 axis = math::normalized(math::rotate(parent.orientation, joint.parent_axis));
    const math::Vec3 child_axis = math::normalized(math::rotate(child.orientation, joint.child_axis));
    const math::Vec3 helper = std::abs(axis.x) < 0.7 ? math::Vec3{1, 0, 0} : math::Vec3{0, 1, 0};
    const math::Vec3 across[2] = {math::normalized(math::cross(axis, helper)),
                                  math::cross(axis, math::normalized(math::cross(axis, helper)))};
    if (joint.pivots_meet()) {
      if (joint.slides()) {
        // Across the axis, which turns with the parent: d(u . gap) = u . (dchild - dparent) + (turn x u) . gap.
        for (const math::Vec3& u : across)
          add(joint, math::dot(u, gap), u, -math::cross(to_parent + gap, u), math::cross(to_child, u));
      } else {
        for (const math::Vec3& u : {math::Vec3{1, 0, 0}, math::Vec3{0, 1, 0}, math::Vec3{0, 0, 1}})
          add(joint, math::dot(u, gap), u, -math::cross(to_parent, u), math::cross(to_child, u));
      }
    }
    if (joint.has_axis()) {
      // Both axes as one: u . child_axis = 0 for the two directions u across the parent's.
      for (const math::Vec3& u : across) {
        const math::Vec3 turn = math::cross(child_axis, u) * problem.arm_m;
        add(joint, math::dot(u, child_axis) * problem.arm_m, {}, -turn, turn);
      }
    }
    // The pose in question is kept: coordinates of active joints, and rotations that the file states no angle for, stay
    // what they were in the frame.
    const auto number = static_cast<std::size_t>(&joint - problem.joints.data());
    const math::Vec3 off = math::log(child.orientation * math::inverse(parent.orientation * problem.held[number]));
    const auto keep = [&](const math::Vec3& u) {
      const math::Vec3 turn = u * problem.arm_m;
      add(joint, math::dot(turn, off), {}, -turn, turn);
    };
    const bool fixed = joint.type == state::JointType::fixed;
    if (fixed || joint.slides() || (joint.active && joint.has_axis())) keep(axis);
    if (fixed)
      for (const math::Vec3& u : across) keep(u);
    if (joint.slides() && joint.active)
      add(joint, math::dot(axis, gap) - problem.shift[number], axis, -math::cross(to_parent + gap, axis),
          math::cross(to_child, axis));
  }
  return rows;
}

double cost(const std::vector<Row>& rows) {
  double sum = 0.0;
  for (const Row& row : rows) sum += row.value * row.value;
  return sum;
}

// Solves (A + mu I) x = b in place, A symmetric and full in its lower half; false when it is not positive definite.
bool solve_damped(std::vector<double> a, std::vector<double>& x, std::size_t n, double mu) {
  for (std::size_t i = 0; i < n; ++i) a[i * n + i] += mu;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) a[j * n + j] -= a[j * n + k] * a[j * n + k];
    if (!(a[j * n + j] > 0.0)) return false;
    const double pivot = a[j * n + j] = std::sqrt(a[j * n + j]);
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = sum / pivot;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= a[i * n + k] * x[k];
    x[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) x[i] -= a[k * n + i] * x[k];
    x[i] /= a[i * n + i];
  }
  return true;
}

}  // namespace

Assembly assemble(const std::vector<JointPlaces>& joints, const state::Structure& structure, const state::Frame& frame,
                  double arm_m) {
  std::vector<math::Pose> poses;
  for (const state::BodyState& body : frame.bodies) poses.push_back(body.T_world_body);
  Problem problem{joints, std::vector<std::uint32_t>(poses.size(), state::kNone), arm_m, {}, {}};
  for (const JointPlaces& joint : joints) {
    const math::Pose& parent = poses[joint.parent];
    const math::Pose& child = poses[joint.child];
    problem.held.push_back(math::inverse(parent.orientation) * child.orientation);
    problem.shift.push_back(math::dot(math::normalized(math::rotate(parent.orientation, joint.parent_axis)),
                                      child * joint.child_pivot - parent * joint.parent_pivot));
  }
  std::uint32_t moving = 0;
  for (const JointPlaces& joint : joints)
    for (const std::uint32_t slot : {joint.parent, joint.child})
      if (structure.bodies[slot].mass > 0.0 && problem.variable[slot] == state::kNone)
        problem.variable[slot] = moving++;
  const std::size_t n = 6u * moving;

  // Levenberg and Marquardt: damping only as strong as needed, so that free directions stay where they are.
  Assembly result;
  double mu = 1e-6;
  std::vector<Row> rows = residuals(problem, poses);
  while (result.iterations < 60 && !result.converged) {
    ++result.iterations;
    std::vector<double> normal(n * n, 0.0), right(n, 0.0);
    for (const Row& row : rows) {
      double j[12];
      std::size_t at[12], used = 0;
      for (int side = 0; side < 2; ++side) {
        if (row.body[side] == state::kNone) continue;
        const double parts[6] = {row.linear[side].x,  row.linear[side].y,  row.linear[side].z,
                                 row.angular[side].x, row.angular[side].y, row.angular[side].z};
        for (std::size_t k = 0; k < 6; ++k, ++used) j[used] = parts[k], at[used] = 6u * row.body[side] + k;
      }
      for (std::size_t p = 0; p < used; ++p) {
        right[at[p]] -= j[p] * row.value;
        for (std::size_t q = 0; q < used; ++q)
          if (at[q] <= at[p]) normal[at[p] * n + at[q]] += j[p] * j[q];
      }
    }
    const double before = cost(rows);
    for (;;) {
      std::vector<double> step = right;
      if (!solve_damped(normal, step, n, mu)) {
        mu *= 10.0;
        continue;
      }
      std::vector<math::Pose> moved = poses;
      for (std::size_t slot = 0; slot < poses.size(); ++slot) {
        if (problem.variable[slot] == state::kNone) continue;
        const double* d = &step[6u * problem.variable[slot]];
        moved[slot].position += {d[0], d[1], d[2]};
        moved[slot].orientation = math::normalized(math::exp({d[3], d[4], d[5]}) * poses[slot].orientation);
      }
      std::vector<Row> there = residuals(problem, moved);
      const double after = cost(there);
      // At the bottom nothing gets better any more.
      if (!(after < before)) {
        mu *= 10.0;
        if (mu > 1e3) {
          result.converged = true;
          break;
        }
        continue;
      }
      poses = std::move(moved);
      rows = std::move(there);
      mu = std::max(1e-8, mu * 0.1);
      // What still falls by less than this comes from sliding along the mechanism's own freedom to a pose that closes
      // better.
      result.converged = before - after < 0.02 * before || after < 1e-20;
      break;
    }
  }
  for (const JointPlaces& joint : joints) {
    if (joint.pivots_meet())
      result.largest_gap =
          std::max(result.largest_gap, math::norm(pivot_gap(joint, poses[joint.parent], poses[joint.child])));
    if (joint.has_axis())
      result.largest_angle = std::max(
          result.largest_angle,
          math::norm(math::cross(math::normalized(math::rotate(poses[joint.parent].orientation, joint.parent_axis)),
                                 math::normalized(math::rotate(poses[joint.child].orientation, joint.child_axis)))));
  }
  return result;
}

}  // namespace ambf::runtime::test
