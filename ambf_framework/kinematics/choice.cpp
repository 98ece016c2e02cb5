#include <algorithm>
#include <limits>

#include "kinematics/detail/candidates.h"

namespace ambf::kinematics {
namespace {

constexpr double kSlack = 1e-10;        // of limits (rad, m): a solution at a limit is often rounded to just outside
constexpr double kTie = 1e-9;           // candidates equally far from the seed: the first counts
constexpr double kMaxCoordinate = 1e6;  // m: coordinates beyond are no poses of an arm

bool is_finite(const Joints& joints) {
  return std::all_of(joints.begin(), joints.end(), [](double q) { return std::isfinite(q); });
}

// One candidate within whole turns, and what it costs to choose it.
struct Rated {
  Joints joints;  // clipped
  double cost = 0.0, worst = 0.0, excess = 0.0;
  int joint = -1;
};

Rated rate(const Arm& arm, const Frame& target, const Joints& seed, const Candidate& candidate) {
  Rated rated;
  rated.joints.reserve(arm.size());
  double squares = 0.0, squares_beyond = 0.0;
  for (std::size_t i = 0; i < arm.size(); ++i) {
    const double value = wrapped(arm, i, candidate.joints[i], seed[i]);
    const double over = excess(arm, i, value), width = range(arm, i);
    squares_beyond += (over / width) * (over / width);
    if (over / width > rated.worst) {
      rated.worst = over / width;
      rated.excess = over;
      rated.joint = static_cast<int>(i);
    }
    rated.joints.push_back(std::clamp(value, arm.lower[i], arm.upper[i]));
    const double away = (rated.joints[i] - seed[i]) / width;
    squares += away * away;
  }
  const double beyond = std::sqrt(squares_beyond);
  rated.cost = beyond > 0.0 ? 1e3 * (1.0 + beyond) : std::sqrt(squares);
  if (candidate.missed) {  // of missed ones the nearest, legal ones first: an ECM keeps the position
    const PoseDifference missing = difference(tip_frame(arm, rated.joints), target);
    rated.cost = 1e6 * (1.0 + 1e3 * beyond + missing.distance + missing.angle);
  }
  return rated;
}

}  // namespace

const char* to_string(Status status) {
  constexpr const char* kNames[] = {"solved", "singular", "out_of_limits", "unreachable", "invalid"};
  return kNames[static_cast<int>(status)];
}

double excess(const Chain& chain, std::size_t joint, double value) {
  const double beyond = std::max(chain.lower[joint] - value, value - chain.upper[joint]);
  return beyond <= kSlack ? 0.0 : beyond;
}

double range(const Chain& chain, std::size_t joint) {
  const double width = chain.upper[joint] - chain.lower[joint];
  return std::isfinite(width) && width > 0.0 ? width : 1.0;
}

Joints clipped(const Chain& chain, const Joints& joints) {
  Joints made(chain.size());
  for (std::size_t i = 0; i < made.size(); ++i) made[i] = std::clamp(joints[i], chain.lower[i], chain.upper[i]);
  return made;
}

double period(const Chain& chain, std::size_t joint) {
  constexpr int kMaxTurns = 12;  // a ratio of 1/12 is the smallest that repeats here
  const bool slides = std::any_of(chain.steps.begin(), chain.steps.end(), [&](const Step& step) {
    return step.prismatic && step.joint == static_cast<int>(joint);
  });
  if (slides) return 0.0;
  for (int turns = 1; turns <= kMaxTurns; ++turns) {
    const bool repeats = std::all_of(chain.steps.begin(), chain.steps.end(), [&](const Step& step) {
      const double axis_turns = step.ratio * turns;
      return step.joint != static_cast<int>(joint) || std::abs(axis_turns - std::nearbyint(axis_turns)) < 1e-12;
    });
    if (repeats) return 2.0 * kPi * turns;
  }
  return 0.0;
}

double wrapped(const Chain& chain, std::size_t joint, double value, double seed) {
  const double turn = period(chain, joint);
  if (turn == 0.0) return value;
  const double lower = chain.lower[joint], upper = chain.upper[joint];
  double made = value + turn * std::nearbyint((seed - value) / turn);
  if (made > upper + kSlack) {
    made -= turn * std::ceil((made - upper - kSlack) / turn);
  } else if (made < lower - kSlack) {
    made += turn * std::ceil((lower - made - kSlack) / turn);
  }
  // No whole period fits: the side that exceeds less.
  const double other = made < lower ? made + turn : made - turn;
  return excess(chain, joint, made) > excess(chain, joint, other) + kSlack ? other : made;
}

Answer choose(const Arm& arm, const Frame& target, const Joints& seed, const Candidates& found) {
  const Candidate* best = nullptr;
  Rated chosen;
  for (const Candidate& candidate : found) {
    Rated rated = rate(arm, target, seed, candidate);
    if (best != nullptr && rated.cost >= chosen.cost - kTie * (1.0 + chosen.cost)) continue;
    best = &candidate;
    chosen = std::move(rated);
  }
  Answer answer;
  answer.free.assign(arm.size(), false);
  answer.status = Status::solved;
  if (std::find(best->free.begin(), best->free.end(), true) != best->free.end()) answer.status = Status::singular;
  if (chosen.worst > 0.0) answer.status = Status::out_of_limits;
  if (best->missed) answer.status = Status::unreachable;
  if (answer.status == Status::singular) answer.free = best->free;
  if (answer.status == Status::out_of_limits) {
    answer.joint = chosen.joint;
    answer.excess = chosen.excess;
  }
  const PoseDifference missing = difference(tip_frame(arm, chosen.joints), target);
  answer.distance = missing.distance;
  answer.angle = missing.angle;
  answer.joints = std::move(chosen.joints);
  return answer;
}

bool usable(const Chain& chain, const math::Pose& pose, const Joints& seed) {
  const math::Vec3& p = pose.position;
  return seed.size() == chain.size() && is_finite(seed) && math::is_finite(pose) &&
         std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kMaxCoordinate &&
         std::abs(math::norm(pose.orientation) - 1.0) < 1e-6;
}

Answer invalid(const Chain& chain, const Joints& seed) {
  Answer answer;
  answer.joints = clipped(chain, seed.size() == chain.size() && is_finite(seed) ? seed : chain.home);
  answer.free.assign(chain.size(), false);
  return answer;
}

}  // namespace ambf::kinematics
