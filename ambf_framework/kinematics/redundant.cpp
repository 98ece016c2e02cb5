// Seven-joint arms with a spherical wrist: MTM (redundant gimbal) and KUKA (spherical shoulder and wrist). Their one
// free parameter comes from the seed: the platform angle (joint 4) of the MTM, the place of the elbow on its circle of
// the KUKA.
#include <algorithm>

#include "kinematics/detail/candidates.h"

namespace ambf::kinematics {
namespace {

// r = Rz(a) Ry(b) Rz(c), b of the given sign; a from the seed where b is 0 or pi.
struct EulerZyz {
  double a = 0.0, b = 0.0, c = 0.0;
  bool free = false;
};

EulerZyz euler_zyz(const Rotation& r, double sign, double seed) {
  EulerZyz made;
  made.free = std::hypot(r(0, 2), r(1, 2)) < kNothing;
  made.a = made.free ? seed : std::atan2(sign * r(1, 2), sign * r(0, 2));
  const Rotation rest = rot_z(-made.a) * r;
  made.b = std::atan2(rest(0, 2), rest(2, 2));
  made.c = std::atan2(rest(1, 0), rest(1, 1));
  return made;
}

// Places of elbow and wrist as seen from the shoulder.
struct Elbow {
  Vector elbow, wrist;
  bool missed = false;  // the wrist had to be moved into reach
};

Elbow place_elbow(const Arm& arm, const Vector& reach, const Joints& seed, double offset) {
  const double upper = arm.rows[2].d, fore = arm.rows[4].d;
  const double length = std::sqrt(reach.x() * reach.x() + reach.y() * reach.y() + reach.z() * reach.z());
  const Vector u = length < kNothing ? Vector(0.0, 0.0, 1.0) : Vector(reach / length);
  const double clamped = std::clamp(length, std::max(std::abs(upper - fore), kNothing), upper + fore);
  const double along = (upper * upper - fore * fore + clamped * clamped) / (2.0 * clamped);
  double beside = std::sqrt(std::max((upper - along) * (upper + along), 0.0));
  // A stretched arm: rounding of the reach moves the elbow by its square root. To the wrist this is 1e-14 m.
  if (beside < 1e-7) beside = 0.0;
  const Rotation seeded = frames(arm, seed)[2].r;
  Vector across = Vector::Zero();
  for (int column = 0; column < 3; ++column) {  // the last that is not along u counts: the seed's upper arm
    const Vector v = seeded.col(column) - u * u.dot(seeded.col(column));
    const double norm = v.norm();
    if (norm > (column == 2 ? 1e-6 : 0.1)) across = v / norm;
  }
  const Vector turned = across * std::cos(offset) + u.cross(across) * std::sin(offset);
  return {u * along + turned * beside, u * clamped,
          length > upper + fore + kNothing || length < std::abs(upper - fore) - kNothing};
}

Candidate on_elbow(const Arm& arm, const Rotation& last, const Elbow& placed, const Joints& seed, double sign2,
                   double sign4, double sign6) {
  const Vector up = placed.elbow / arm.rows[2].d, fore = (placed.wrist - placed.elbow) / arm.rows[4].d;
  const bool free1 = std::hypot(up.x(), up.y()) < kNothing;
  const double q1 = free1 ? seed[0] : std::atan2(sign2 * up.y(), sign2 * up.x());
  const double q2 = std::atan2(std::cos(q1) * up.x() + std::sin(q1) * up.y(), up.z());
  const Rotation shoulder = rot_z(q1) * rot_y(q2);
  const Vector m = shoulder.transpose() * fore;
  const bool free3 = std::hypot(m.x(), m.y()) < kNothing;
  const double q3 = free3 ? seed[2] : std::atan2(-sign4 * m.y(), -sign4 * m.x());
  const double q4 = std::atan2(-std::cos(q3) * m.x() - std::sin(q3) * m.y(), m.z());
  const Rotation turn = (shoulder * (rot_z(q3) * rot_y(-q4))).transpose() * last;
  const EulerZyz wrist = euler_zyz(turn, sign6, seed[4]);
  return {{q1, q2, q3, q4, wrist.a, wrist.b, wrist.c},
          {free1, false, free3, false, wrist.free, false, false},
          placed.missed};
}

}  // namespace

Candidates gimbal(const Arm& arm, const Frame& target, const Joints& seed, double offset) {
  const Frame last = target * inverse(to_frame(arm.tip));
  const auto& rows = arm.rows;
  const double l1 = rows[1].a, l2 = std::hypot(rows[2].a, rows[3].d), bend = std::atan2(rows[3].d, rows[2].a);
  const double out = std::hypot(last.p.x(), last.p.y()), down = -last.p.z(), reach = std::hypot(out, down);
  const bool missed = reach > l1 + l2 + kNothing || reach < std::abs(l1 - l2) - kNothing;
  const double clamped = std::clamp(reach, std::abs(l1 - l2), l1 + l2);
  const double cos_elbow = std::clamp((clamped * clamped - l1 * l1 - l2 * l2) / (2.0 * l1 * l2), -1.0, 1.0);
  const double platform = std::clamp(seed[3] + offset, arm.lower[3], arm.upper[3]);
  const bool free1 = out < kNothing;
  Candidates found;
  for (double side : {1.0, -1.0}) {
    for (double elbow : {1.0, -1.0}) {
      for (double sign : {-1.0, 1.0}) {
        const double turned = elbow * std::acos(cos_elbow);
        Joints q(7, 0.0);
        q[0] = free1 ? seed[0] : std::atan2(side * last.p.x(), -side * last.p.y());
        q[1] = std::atan2(side * out, down) - std::atan2(l2 * std::sin(turned), l1 + l2 * std::cos(turned));
        q[2] = turned - 0.5 * kPi - bend;
        q[3] = platform;
        const Rotation carried = frames(arm, q)[3].r * rot_x(rows[3].alpha);
        const EulerZyz wrist = euler_zyz(carried.transpose() * last.r, sign, seed[4] + rows[4].theta);
        q[4] = wrist.a - rows[4].theta;
        q[5] = wrist.b - rows[5].theta;
        q[6] = wrist.c - rows[6].theta;
        found.push_back({std::move(q), {free1, false, false, false, wrist.free, false, false}, missed});
      }
    }
  }
  return found;
}

Candidates spherical_shoulder_and_wrist(const Arm& arm, const Frame& target, const Joints& seed, double offset) {
  const Frame last = target * inverse(to_frame(arm.tip));
  const Vector reach = last.p - arm.rows[6].d * last.r.col(2) - Vector(0.0, 0.0, arm.rows[0].d);
  const Elbow placed = place_elbow(arm, reach, seed, offset);
  Candidates found;
  for (double sign2 : {1.0, -1.0}) {
    for (double sign4 : {1.0, -1.0}) {
      for (double sign6 : {1.0, -1.0}) found.push_back(on_elbow(arm, last.r, placed, seed, sign2, sign4, sign6));
    }
  }
  return found;
}

}  // namespace ambf::kinematics
