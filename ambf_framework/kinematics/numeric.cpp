// Inverse of any open chain: damped least squares (Levenberg-Marquardt) within limits, from several starts.
#include <Eigen/Cholesky>
#include <algorithm>

#include "kinematics/detail/candidates.h"
#include "kinematics/detail/decompositions.h"

namespace ambf::kinematics {
namespace {

constexpr int kIterations = 120;
constexpr double kReached = 1e-10;  // distance (m) and angle (rad) of a solution
constexpr int kSpreadStarts = 6;    // beside seed and home
constexpr double kFree = 1e-8;      // a singular value (per joint range) below this leaves joints free

Eigen::Matrix<double, 6, 1> error_of(const Chain& chain, const Joints& joints, const Frame& target) {
  const Frame tip = tip_frame(chain, joints);
  Eigen::Matrix<double, 6, 1> error;
  error << target.p - tip.p, rotation_vector(tip.r, target.r);
  return error;
}

// A joint vector of locally least error; clipped to limits in each iteration if `limited`.
Joints descend(const Chain& chain, const Frame& target, const Joints& start, bool limited) {
  const auto n = static_cast<Eigen::Index>(chain.size());
  Joints joints = clipped(chain, start);
  auto error = error_of(chain, joints, target);
  double damping = 1e-3;
  for (int i = 0; i < kIterations && damping <= 1e3 && error.norm() > 1e-15; ++i) {
    Eigen::MatrixXd j = spatial_jacobian(chain, joints);
    for (Eigen::Index k = 0; k < n; ++k) j.col(k) *= range(chain, static_cast<std::size_t>(k));
    Eigen::VectorXd gradient = j.transpose() * error;
    for (Eigen::Index k = 0; limited && k < n; ++k) {  // joints at a limit that would move beyond are held
      const auto at = static_cast<std::size_t>(k);
      if (gradient[k] > 0.0 ? joints[at] >= chain.upper[at] : joints[at] <= chain.lower[at]) {
        j.col(k).setZero();
        gradient[k] = 0.0;
      }
    }
    const Eigen::MatrixXd normal = j.transpose() * j + damping * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd move = normal.ldlt().solve(gradient);
    Joints moved = joints;
    for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += range(chain, k) * move[static_cast<Eigen::Index>(k)];
    if (limited) moved = clipped(chain, moved);
    const auto after = error_of(chain, moved, target);
    if (after.norm() < error.norm()) {
      joints = std::move(moved);
      error = after;
      damping = std::max(damping * 0.03, 1e-16);
    } else {
      damping *= 8.0;
    }
  }
  return joints;
}

// The k-th number of Halton's sequence of a base: spread evenly over 0..1.
double halton(int k, int base) {
  double value = 0.0, digit = 1.0 / base;
  for (; k > 0; k /= base, digit /= base) value += digit * (k % base);
  return value;
}

std::vector<Joints> starts(const Chain& chain, const Joints& seed) {
  constexpr int kPrimes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
  std::vector<Joints> made{seed, chain.home};
  for (int k = 1; k <= kSpreadStarts; ++k) {
    Joints spread(chain.size());
    for (std::size_t i = 0; i < spread.size(); ++i) {
      const double low = std::clamp(chain.lower[i], -kPi, kPi);
      const double high = std::clamp(chain.upper[i], -kPi, kPi);
      spread[i] = low + halton(k, kPrimes[i % 16]) * (high - low);
    }
    made.push_back(std::move(spread));
  }
  return made;
}

// Joints that can move while the tip rests, in chains without redundancy.
std::vector<bool> free_joints(const Chain& chain, const Joints& joints) {
  std::vector<bool> made(chain.size(), false);
  const auto n = static_cast<Eigen::Index>(chain.size());
  if (n == 0 || n > 6) return made;
  Eigen::MatrixXd j = spatial_jacobian(chain, joints);
  for (Eigen::Index k = 0; k < n; ++k) j.col(k) *= range(chain, static_cast<std::size_t>(k));
  const SingularParts parts = singular_parts(j);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index i = 0; i < parts.values.size(); ++i) {
      if (parts.values[i] < kFree && std::abs(parts.v(k, i)) > 1e-3) made[static_cast<std::size_t>(k)] = true;
    }
  }
  return made;
}

}  // namespace

Answer inverse(const Chain& chain, const math::Pose& pose, const Joints& seed) {
  if (!usable(chain, pose, seed)) return invalid(chain, seed);
  const Frame target = to_frame(pose);
  const Joints near = clipped(chain, seed);
  Answer answer = invalid(chain, seed);
  answer.status = Status::unreachable;
  PoseDifference missing = difference(tip_frame(chain, answer.joints), target);
  for (bool limited : {true, false}) {
    for (const Joints& start : starts(chain, near)) {
      Joints joints = descend(chain, target, start, limited);
      const PoseDifference open = difference(tip_frame(chain, joints), target);
      const bool reached = std::max(open.distance, open.angle) < kReached;
      double worst = 0.0, worst_excess = 0.0;
      int worst_joint = -1;
      for (std::size_t i = 0; i < joints.size(); ++i) {
        joints[i] = wrapped(chain, i, joints[i], near[i]);
        const double beyond = excess(chain, i, joints[i]);
        if (beyond / range(chain, i) > worst) {
          worst = beyond / range(chain, i);
          worst_excess = beyond;
          worst_joint = static_cast<int>(i);
        }
      }
      const bool solved = reached && worst_joint < 0;
      Joints legal = clipped(chain, joints);
      const PoseDifference left = difference(tip_frame(chain, legal), target);
      if (solved || left.distance + left.angle < missing.distance + missing.angle) {
        answer.joints = std::move(legal);
        missing = left;
      }
      if (!reached) continue;
      answer.distance = missing.distance;
      answer.angle = missing.angle;
      answer.status = solved ? Status::solved : Status::out_of_limits;
      answer.joint = worst_joint;
      answer.excess = worst_excess;
      if (!solved) return answer;
      answer.free = free_joints(chain, answer.joints);
      const bool any = std::find(answer.free.begin(), answer.free.end(), true) != answer.free.end();
      if (any) answer.status = Status::singular;
      return answer;
    }
  }
  answer.distance = missing.distance;
  answer.angle = missing.angle;
  return answer;
}

}  // namespace ambf::kinematics
