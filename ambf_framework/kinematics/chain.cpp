#include "kinematics/chain.h"

#include "kinematics/detail/frames.h"
#include "math/rotation.h"

namespace ambf::kinematics {

// As the Python client computes it, to the last bit: near singular poses solutions multiply differences of rounding.
Frame to_frame(const math::Pose& pose) {
  const auto [x, y, z, w] = pose.orientation;
  const double s = 2.0 / (x * x + y * y + z * z + w * w);
  Frame frame;
  frame.r << 1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w),  //
      s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w),         //
      s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y);
  frame.p = {pose.position.x, pose.position.y, pose.position.z};
  return frame;
}

math::Pose to_pose(const Frame& frame) {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = frame.r;
  return {{frame.p.x(), frame.p.y(), frame.p.z()}, math::normalized(math::from_matrix(rows.data()))};
}

std::vector<Frame> frames(const Chain& chain, const Joints& joints) {
  std::vector<Frame> made;
  made.reserve(chain.steps.size());
  Frame frame;
  for (const Step& step : chain.steps) {
    const auto index = static_cast<std::size_t>(step.joint);
    const double motion = index < joints.size() ? step.ratio * joints[index] : 0.0;
    Frame moved;
    if (step.prismatic) {
      moved.p.z() = motion;
    } else {
      moved.r = rot_z(motion);
    }
    frame = frame * (to_frame(step.before) * moved);
    made.push_back(frame);
  }
  return made;
}

Frame tip_frame(const Chain& chain, const Joints& joints) {
  const auto made = frames(chain, joints);
  return made.empty() ? to_frame(chain.tip) : made.back() * to_frame(chain.tip);
}

Eigen::MatrixXd spatial_jacobian(const Chain& chain, const Joints& joints) {
  const auto axes = frames(chain, joints);
  const Frame tip = axes.empty() ? to_frame(chain.tip) : axes.back() * to_frame(chain.tip);
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(chain.size()));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Vector axis = axes[i].r.col(2) * chain.steps[i].ratio;
    auto column = made.col(chain.steps[i].joint);
    if (chain.steps[i].prismatic) {
      column.head<3>() += axis;
    } else {
      column.head<3>() += axis.cross(tip.p - axes[i].p);
      column.tail<3>() += axis;
    }
  }
  return made;
}

Vector rotation_vector(const Rotation& a, const Rotation& b) {
  const Rotation r = b * a.transpose();
  const Vector twice_sin{r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
  const double norm = twice_sin.norm(), angle = std::atan2(norm, r.trace() - 1.0);
  if (norm >= 1e-9) return twice_sin * (angle / norm);
  if (angle < 1.0) return twice_sin * 0.5;
  const Rotation columns = r + Rotation::Identity();  // half a turn: they are along the axis
  Eigen::Index longest = 0;
  columns.colwise().norm().maxCoeff(&longest);
  return columns.col(longest).normalized() * kPi;
}

PoseDifference difference(const Frame& a, const Frame& b) {
  return {(a.p - b.p).norm(), rotation_vector(a.r, b.r).norm()};
}

PoseDifference difference(const math::Pose& a, const math::Pose& b) { return difference(to_frame(a), to_frame(b)); }

math::Pose forward(const Chain& chain, const Joints& joints) { return to_pose(tip_frame(chain, joints)); }

std::vector<double> jacobian(const Chain& chain, const Joints& joints, JacobianFrame frame) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> made = spatial_jacobian(chain, joints);
  if (frame == JacobianFrame::body) {
    const Rotation to_tip = tip_frame(chain, joints).r.transpose();
    made.topRows<3>() = (to_tip * made.topRows<3>()).eval();
    made.bottomRows<3>() = (to_tip * made.bottomRows<3>()).eval();
  }
  return {made.data(), made.data() + made.size()};
}

namespace {

struct AroundMotion {
  math::Pose before, after;  // the motion along or about z, from the parent's to the child's body frame
};

// At the zero of the joint, as simulated ones have it (physics/joint.h).
AroundMotion around_motion(const AdfGeometry& joint) {
  const math::Pose to_z{{}, math::rotation_between({0.0, 0.0, 1.0}, joint.parent_axis)};
  const math::Pose zero{{}, math::from_axis_angle({0.0, 0.0, 1.0}, joint.child_offset - joint.joint_offset)};
  const math::Pose before = math::Pose{joint.parent_pivot, {}} * to_z * zero;
  const math::Pose turned{{}, math::rotation_between(joint.child_axis, joint.parent_axis)};
  return {before, math::inverse(to_z) * turned * math::Pose{-joint.child_pivot, {}}};
}

}  // namespace

math::Pose at_zero(const AdfGeometry& joint) {
  const AroundMotion parts = around_motion(joint);
  return parts.before * parts.after;
}

void append(Chain& chain, const AdfGeometry& joint, bool prismatic, double lower, double upper,
            const std::string& name) {
  const AroundMotion parts = around_motion(joint);
  chain.steps.push_back({chain.tip * parts.before, static_cast<int>(chain.size()), prismatic, 1.0});
  chain.tip = parts.after;
  chain.lower.push_back(lower);
  chain.upper.push_back(upper);
  chain.home.push_back(std::fmax(lower, std::fmin(upper, 0.0)));
  chain.names.push_back(name);
}

void append_fixed(Chain& chain, const AdfGeometry& joint) {
  const AroundMotion parts = around_motion(joint);
  chain.tip = chain.tip * parts.before * parts.after;
}

}  // namespace ambf::kinematics
