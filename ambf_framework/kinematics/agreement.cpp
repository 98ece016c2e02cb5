#include "kinematics/agreement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kinematics/detail/decompositions.h"
#include "kinematics/detail/frames.h"

namespace ambf::kinematics {

namespace {

constexpr double kMaxAngle = 0.7, kMaxDistance = 0.06;  // to either side of the middle
constexpr double kShare = 0.45;                         // at most, of the joint's range
constexpr double kLever = 0.05;                         // m: an angle counts as what it is at this distance
constexpr int kTogether = 6;                            // samples in which all joints move
constexpr int kIterations = 20;
constexpr double kDifference = 1e-7, kDecides = 1e-6;

std::string without_blanks(std::string name) {
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name;
}

struct Sample {
  Joints joints;
  int alone = -1;  // the only joint that is not in the middle
};

std::vector<Sample> samples_of(const Arm& arm) {
  Joints middle = arm.home, half(arm.size(), 0.0);
  for (std::size_t i = 0; i < arm.size(); ++i) {
    const double reach = arm.prismatic[i] ? kMaxDistance : kMaxAngle;
    half[i] = std::min(reach, kShare * (arm.upper[i] - arm.lower[i]));
    middle[i] = std::clamp(middle[i], arm.lower[i] + half[i], arm.upper[i] - half[i]);
  }
  std::vector<Sample> made{{middle}};
  for (std::size_t i = 0; i < arm.size(); ++i) {
    for (const double side : {-1.0, 1.0}) {
      made.push_back({middle, static_cast<int>(i)});
      made.back().joints[i] += side * half[i];
    }
  }
  for (int k = 1; k <= kTogether; ++k) {
    made.push_back({middle});
    // Spread evenly: multiples of irrational numbers.
    for (std::size_t i = 0; i < arm.size(); ++i) {
      const double turn = k * std::sqrt(2.0 + 3.0 * static_cast<double>(i));
      made.back().joints[i] += half[i] * (2.0 * (turn - std::floor(turn)) - 1.0);
    }
  }
  return made;
}

// X rows_i = model_i Y for all i, as well as it can be.
struct Fit {
  Frame x, y;
  double cost = 0.0;
};

Vector position_error(const Fit& fit, const Frame& rows, const Frame& model) {
  return (fit.x * rows).p - (model * fit.y).p;
}
Vector turn_error(const Fit& fit, const Frame& rows, const Frame& model) {
  return rotation_vector((model * fit.y).r, (fit.x * rows).r);
}

Eigen::VectorXd errors(const Fit& fit, const std::vector<Frame>& rows, const std::vector<Frame>& model) {
  Eigen::VectorXd made(static_cast<Eigen::Index>(6 * rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    made.segment<3>(at) = position_error(fit, rows[i], model[i]);
    made.segment<3>(at + 3) = kLever * turn_error(fit, rows[i], model[i]);
  }
  return made;
}

Frame moved(const Frame& frame, const Eigen::Ref<const Eigen::Matrix<double, 6, 1>>& by) {
  const Vector turn = by.tail<3>();
  const double angle = turn.norm();
  Frame change;
  if (angle > 0.0) change.r = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  change.p = by.head<3>();
  return {change.r * frame.r, frame.p + change.p};
}

Fit improved(Fit fit, const std::vector<Frame>& rows, const std::vector<Frame>& model) {
  using Change = Eigen::Matrix<double, 12, 1>;
  const auto with = [&](const Change& by) { return Fit{moved(fit.x, by.head<6>()), moved(fit.y, by.tail<6>())}; };
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::VectorXd now = errors(fit, rows, model);
    Eigen::MatrixXd slopes(now.size(), 12);
    for (int column = 0; column < 12; ++column) {
      Change by = Change::Zero();
      by[column] = kDifference;
      slopes.col(column) = (errors(with(by), rows, model) - now) / kDifference;
    }
    const Change change = -solve_lsq(slopes, now, kDecides);
    fit = with(change);
    if (change.cwiseAbs().maxCoeff() < 1e-10) break;
  }
  fit.cost = errors(fit, rows, model).squaredNorm();
  return fit;
}

// The rotation that takes the axes about which the rows turn the tip to those about which the model does (Kabsch).
Rotation rotation_of_axes(const std::vector<Frame>& rows, const std::vector<Frame>& model) {
  Rotation sum = Rotation::Zero();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    sum += rotation_vector(model[0].r, model[i].r) * rotation_vector(rows[0].r, rows[i].r).transpose();
  }
  const SingularParts parts = singular_parts(sum);
  const Rotation u = parts.u, v = parts.v;
  Rotation mirror = Rotation::Identity();
  mirror(2, 2) = (u * v.transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return u * mirror * v.transpose();
}

// Where the rows start is where the base body is, if that fits.
Fit fit(const std::vector<Frame>& rows, const std::vector<Frame>& model) {
  const auto from = [&](const Rotation& r) {
    Fit start;
    start.x.r = r;
    start.y = inverse(model[0]) * start.x * rows[0];
    return improved(start, rows, model);
  };
  const Fit here = from(Rotation::Identity()), turned = from(rotation_of_axes(rows, model));
  return here.cost <= 1.01 * turned.cost + 1e-9 ? here : turned;
}

// Joints below the base, so that a name means one of them.
std::vector<MechanismJoint> below(const std::vector<MechanismJoint>& joints, std::size_t base) {
  std::vector<std::size_t> found{base};
  std::vector<MechanismJoint> made;
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (const MechanismJoint& joint : joints) {
      if (joint.parent != found[next]) continue;
      made.push_back(joint);
      if (std::find(found.begin(), found.end(), joint.child) == found.end()) found.push_back(joint.child);
    }
  }
  return made;
}

struct Moved {
  std::vector<std::string> names;
  std::vector<std::size_t> joints;

  std::vector<double> positions(const Arm& arm, const Joints& sample) const {
    std::vector<double> made;
    const std::map<std::string, double> wanted = to_adf(arm, {sample, 0.0});
    for (const std::string& name : names) made.push_back(wanted.at(name));
    return made;
  }
};

Agreement judge(const Arm& arm, const std::vector<MechanismJoint>& joints, std::size_t base, std::size_t tip,
                const Moved& driven) {
  Mechanism mechanism(joints, base, tip, driven.joints);
  Agreement made;
  if (!mechanism.reaches()) {
    made.verdict = Agreement::Verdict::not_the_way;
    made.joint = driven.names.back();
    return made;
  }
  if (const MechanismJoint* loose = mechanism.loose()) {
    made.joint = loose->name;
    return made;
  }
  const std::vector<Sample> samples = samples_of(arm);
  std::vector<Frame> rows, model;
  for (const Sample& sample : samples) {
    const std::optional<math::Pose> pose = mechanism.move_to(driven.positions(arm, sample.joints));
    if (!pose) {
      made.verdict = Agreement::Verdict::not_closed;
      made.joint =
          driven
              .names[sample.alone < 0 ? 0 : std::min(static_cast<std::size_t>(sample.alone), driven.names.size() - 1)];
      return made;
    }
    rows.push_back(tip_frame(arm, sample.joints));
    model.push_back(to_frame(*pose));
  }
  const Fit best = fit(rows, model);
  double worst = -1.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double distance = position_error(best, rows[i], model[i]).norm();
    const double angle = turn_error(best, rows[i], model[i]).norm();
    made.distance = std::max(made.distance, distance);
    made.angle = std::max(made.angle, angle);
    if (samples[i].alone < 0 || distance + kLever * angle <= worst) continue;
    worst = distance + kLever * angle;
    made.joint = driven.names[std::min(static_cast<std::size_t>(samples[i].alone), driven.names.size() - 1)];
  }
  made.base_distance = best.x.p.norm();
  made.base_angle = rotation_vector(Rotation::Identity(), best.x.r).norm();
  const bool agrees = made.distance <= kAgreedDistance && made.angle <= kAgreedAngle;
  made.verdict = agrees ? Agreement::Verdict::agrees : Agreement::Verdict::differs;
  return made;
}

}  // namespace

Agreement compare(const Arm& arm, const std::vector<MechanismJoint>& all, std::size_t base) {
  const std::vector<MechanismJoint> joints = below(all, base);
  Moved driven;
  for (const AdfJoint& joint : arm.adf_joints) driven.names.push_back(joint.name);
  for (const JawHalf& half : arm.adf_jaw) driven.names.push_back(half.name);
  for (const std::string& name : driven.names) {
    const auto found = std::find_if(joints.begin(), joints.end(), [&](const MechanismJoint& joint) {
      return without_blanks(joint.name) == without_blanks(name);
    });
    if (found == joints.end()) {
      Agreement made;
      made.verdict = Agreement::Verdict::not_the_way;
      made.joint = name;
      return made;
    }
    driven.joints.push_back(static_cast<std::size_t>(found - joints.begin()));
  }
  if (driven.joints.empty()) return {};
  Agreement made = judge(arm, joints, base, joints[driven.joints.back()].child, driven);
  if (arm.adf_jaw.size() != 2 || made.verdict != Agreement::Verdict::agrees) return made;
  // Both halves of a jaw carry the tip.
  const std::size_t other = driven.joints[driven.joints.size() - 2];
  return judge(arm, joints, base, joints[other].child, driven);
}

}  // namespace ambf::kinematics
