// Arms whose shaft passes through the base's origin: PSM and Raven II (six joints, 8 solutions), ECM (four joints).
//
// Axes 1 and 2 point the shaft, axis 3 slides along it, axis 4 rolls it; all of them meet in the remote centre. With a
// wrist, axis 5 meets the shaft at a right angle and axis 6 is at a right angle to axis 5, at distance a from it.
// Position and orientation separate as seen from the tip: the remote centre lies in the plane through the shaft at a
// right angle to axis 5, which gives joint 6, then the insertion, joint 5, the direction of the shaft, joints 1 and 2,
// and the roll. The idea is of Hwang et al., arXiv 2012.12844; theirs knows only the branch with the wrist in front of
// the remote centre.
#include "kinematics/detail/candidates.h"

namespace ambf::kinematics {
namespace {

constexpr double kTolerance = 1e-9;  // rad by which a pose may be off what four joints can reach

// Angles of rows 1 and 2 that point the shaft along the unit vector k; theta 2 of the given sign.
struct Direction {
  double theta1 = 0.0, theta2 = 0.0;
  bool free = false;    // theta 1 is as in the seed
  bool missed = false;  // k is outside of the cone that the arm can point to
};

Direction direction(const Arm& arm, const Vector& k, double sign, const Joints& seed) {
  const double c1 = std::cos(arm.rows[0].alpha), s1 = std::sin(arm.rows[0].alpha);
  const double c2 = std::cos(arm.rows[1].alpha), s2 = std::sin(arm.rows[1].alpha);
  const double c3 = std::cos(arm.rows[2].alpha), s3 = std::sin(arm.rows[2].alpha);
  const double ky = c1 * k.y() + s1 * k.z(), kz = -s1 * k.y() + c1 * k.z();
  double cos2 = (c2 * c3 - kz) / (s2 * s3);
  Direction made;
  made.missed = std::abs(cos2) > 1.0 + kNothing;
  cos2 = std::fmax(-1.0, std::fmin(1.0, cos2));
  const double sin2 = sign * std::sqrt((1.0 - cos2) * (1.0 + cos2));
  const double x = s3 * sin2, y = -c2 * s3 * cos2 - s2 * c3;
  made.free = std::hypot(x, y) < kNothing;
  made.theta1 = made.free ? seed[0] + arm.rows[0].theta : std::atan2(ky, k.x()) - std::atan2(y, x);
  made.theta2 = std::atan2(sin2, cos2);
  return made;
}

// Rotation of frame 3.
Rotation shaft_frame(const Arm& arm, const Direction& pointed) {
  return rot_x(arm.rows[0].alpha) * rot_z(pointed.theta1) * rot_x(arm.rows[1].alpha) * rot_z(pointed.theta2) *
         (rot_x(arm.rows[2].alpha) * rot_z(arm.rows[2].theta));
}

// `last` is the pose of frame 6, `center` the remote centre in it. `side`: +1 or -1, where the remote centre is as seen
// from axis 6; `sign` of the insertion.
// Both signs of theta 2 share what lies behind the shaft.
void add_with_wrist(const Arm& arm, const Frame& last, const Vector& center, const Joints& seed, double side,
                    double sign, Candidates& found) {
  const auto& rows = arm.rows;
  const double e5 = std::sin(rows[4].alpha), e6 = std::sin(rows[5].alpha);
  const double h = std::hypot(center.x(), center.y());
  const bool free6 = h < kNothing;
  const double theta6 = free6 ? seed[5] + rows[5].theta : (side < 0.0 ? kPi : 0.0) - std::atan2(center.y(), center.x());
  const double x = rows[5].a + side * h;
  const double length = sign * std::hypot(x, center.z());
  const bool free5 = std::abs(length) < kNothing;
  const double theta5 = free5 ? seed[4] + rows[4].theta : std::atan2(-x * sign * e5, e6 * center.z() * sign * e5);
  const Rotation wrist = rot_x(rows[4].alpha) * rot_z(theta5) * rot_x(rows[5].alpha) * rot_z(theta6);
  const Rotation shaft = last.r * wrist.transpose();  // frame 4
  for (double sign2 : {1.0, -1.0}) {
    const Direction pointed = direction(arm, shaft.col(2), sign2, seed);
    const Rotation rolled = shaft_frame(arm, pointed).transpose() * shaft;
    const double theta4 = std::atan2(rolled(1, 0), rolled(0, 0));
    found.push_back({{pointed.theta1 - rows[0].theta, pointed.theta2 - rows[1].theta, length - rows[2].d - rows[3].d,
                      theta4 - rows[3].theta, theta5 - rows[4].theta, theta6 - rows[5].theta},
                     {pointed.free, false, false, false, free5, free6},
                     pointed.missed});
  }
}

Candidate without_wrist(const Arm& arm, const Frame& last, const Joints& seed, double sign, double sign2) {
  const auto& rows = arm.rows;
  const double r = last.p.norm();
  const Vector k = sign * (r < kNothing ? Vector(last.r.col(2)) : Vector(last.p / r));
  const Direction pointed = direction(arm, k, sign2, seed);
  const Rotation rolled = shaft_frame(arm, pointed).transpose() * last.r;
  const double theta4 = std::atan2(rolled(1, 0) - rolled(0, 1), rolled(0, 0) + rolled(1, 1));
  const Vector z = last.r.col(2);
  const double off = std::atan2(z.cross(k).norm(), z.dot(k));
  return {{pointed.theta1 - rows[0].theta, pointed.theta2 - rows[1].theta, sign * r - rows[2].d - rows[3].d,
           theta4 - rows[3].theta},
          {pointed.free, false, false, false},
          pointed.missed || off > kTolerance};
}

}  // namespace

Candidates remote_center(const Arm& arm, const Frame& target, const Joints& seed) {
  const Frame last = target * inverse(to_frame(arm.tip));
  Candidates found;
  found.reserve(8);
  if (arm.size() == 4) {
    for (double sign : {1.0, -1.0}) {
      for (double sign2 : {1.0, -1.0}) found.push_back(without_wrist(arm, last, seed, sign, sign2));
    }
    return found;
  }
  const Vector center = inverse(last).p;
  for (double side : {-1.0, 1.0}) {
    for (double sign : {1.0, -1.0}) add_with_wrist(arm, last, center, seed, side, sign, found);
  }
  return found;
}

}  // namespace ambf::kinematics
