// Kinematics of the MTM and the null space of its wrist (EQUATIONS 18).
#include "dvrk_arm/mtm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "math/rotation.h"

namespace ambf::dvrk_arm {
namespace {

MtmJoints random_joints(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-1.0, 1.0);
  MtmJoints q{};
  for (double& value : q) value = angle(random);
  return q;
}

TEST(Mtm, TipIsWhereTheReferenceComputesIt) {
  struct Case {
    MtmJoints q;
    math::Pose T_base_tip;
  };
  const Case cases[] = {
      {{}, {{0.0, -0.3645, -0.1288}, {-0.5, -0.5, -0.5, 0.5}}},
      {{0.2, 0.3, -0.2, 0.4, 0.5, 0.1, 0.6},
       {{0.085470, -0.421637, -0.080684}, {-0.613038, -0.632230, -0.026832, 0.473023}}},
      {{-0.4, 0.6, 0.3, -0.8, 1.2, -0.3, -1.5},
       {{-0.103729, -0.245342, 0.148538}, {0.463307, 0.757313, -0.340375, 0.309789}}},
      {{-0.6, 1.0, -0.6, -1.2, 2.0, 0.0, -2.0},
       {{-0.289203, -0.422726, 0.129694}, {-0.626957, -0.704502, 0.285350, 0.170813}}},
  };
  for (const Case& one : cases) {
    const math::Pose tip = mtm_frames(one.q).T_base_tip;
    EXPECT_LT(math::norm(tip.position - one.T_base_tip.position), 2e-6);
    EXPECT_LT(math::norm(math::log(math::inverse(tip.orientation) * math::normalized(one.T_base_tip.orientation))),
              2e-5);
  }
}

TEST(Mtm, EffortsDoTheWorkOfTheWrench) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> component(-2.0, 2.0);
  constexpr double kStep = 1e-6;
  for (int round = 0; round < 50; ++round) {
    const MtmJoints q = random_joints(random);
    const math::Wrench wrench{{component(random), component(random), component(random)},
                              {component(random), component(random), component(random)}};
    const MtmJoints efforts = mtm_efforts(mtm_frames(q), wrench);
    for (std::size_t i = 0; i < kMtmJoints; ++i) {
      MtmJoints ahead = q, behind = q;
      ahead[i] += kStep;
      behind[i] -= kStep;
      const math::Pose a = mtm_frames(ahead).T_base_tip, b = mtm_frames(behind).T_base_tip;
      const double work = math::dot(wrench.force, a.position - b.position) +
                          math::dot(wrench.torque, math::log(a.orientation * math::inverse(b.orientation)));
      EXPECT_NEAR(efforts[i], work / (2.0 * kStep), 1e-6) << "joint " << i + 1;
    }
  }
}

TEST(Mtm, EffortsStayWithinTheMotors) {
  const MtmJoints bounded = mtm_bounded(mtm_efforts(mtm_frames({}), {{1e3, -1e3, 1e3}, {1e3, 1e3, -1e3}}));
  EXPECT_LE(std::abs(bounded[3]), 0.30901);
  EXPECT_LE(std::abs(bounded[6]), 0.022876);
  MtmJoints far{};
  far[5] = 1.5;
  EXPECT_LE(std::abs(mtm_platform_effort(far, {0, 0, 0, -100.0, 0, 0, 0})), 0.30901);
}

// Joints 5, 6, 7 that keep the tip's orientation while joint 4 moves, by Newton's method from where they were.
void hold_orientation(MtmJoints& q, const math::Quat& R_base_tip) {
  for (int i = 0; i < 20; ++i) {
    const MtmFrames at = mtm_frames(q);
    const math::Vec3 error = math::log(R_base_tip * math::inverse(at.T_base_tip.orientation));
    const math::Vec3 &a = at.axis[4], &b = at.axis[5], &c = at.axis[6];
    const double determinant = math::dot(a, math::cross(b, c));
    q[4] += math::dot(error, math::cross(b, c)) / determinant;
    q[5] += math::dot(a, math::cross(error, c)) / determinant;
    q[6] += math::dot(a, math::cross(b, error)) / determinant;
    if (math::norm(error) < 1e-12) return;
  }
}

using Law = std::function<double(const MtmJoints& position, const MtmJoints& velocity)>;

// |joint 6| in two seconds; up to nearly a quarter of a rotation, where joint 4 turns it no more.
struct Course {
  double largest = 0.0, last = 0.0;
};
Course course_of_joint_6(const Law& law, double t5, double t6) {
  constexpr double kInertia_kgm2 = 0.005, kStep_s = 1e-3;
  MtmJoints q{0.1, 0.2, -0.1, 0.3, t5, t6, 0.5}, velocity{};
  const math::Quat held = mtm_frames(q).T_base_tip.orientation;
  Course course;
  for (int step = 0; step < 2000 && course.largest < 1.5; ++step) {
    velocity[3] += kStep_s * law(q, velocity) / kInertia_kgm2;
    q[3] += kStep_s * velocity[3];
    hold_orientation(q, held);
    course.last = std::abs(q[5]);
    course.largest = std::max(course.largest, course.last);
  }
  return course;
}

TEST(Mtm, NullSpaceTurnsJoint6ToItsMiddleForEveryAngleOfJoint5) {
  const double degree = M_PI / 180.0;
  for (const double t5 : {-150.0, -120.0, -60.0, 0.0, 45.0, 120.0, 150.0}) {
    for (const double t6 : {-40.0, 40.0}) {
      const Course course = course_of_joint_6(mtm_platform_effort, t5 * degree, t6 * degree);
      EXPECT_LT(course.last, 10.0 * degree) << t5 << " " << t6;
      EXPECT_LT(course.largest, 40.1 * degree) << t5 << " " << t6;
    }
  }
  const Law opposite = [](const MtmJoints& q, const MtmJoints& v) { return -mtm_platform_effort(q, v); };
  EXPECT_GT(course_of_joint_6(opposite, 0.0, 40.0 * degree).largest, 45.0 * degree);
  const Law printed = [](const MtmJoints& q, const MtmJoints& v) { return 0.5 * q[5] - 0.05 * v[3]; };
  EXPECT_GT(course_of_joint_6(printed, 150.0 * degree, 40.0 * degree).largest, 45.0 * degree);
}

// Joint 6 is the angle of Eq. 7.1, whatever the other joints of the wrist are.
TEST(Mtm, AngleOfTheEquationIsJoint6) {
  std::mt19937 random(5);
  const math::Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const auto turn = [](const math::Vec3& axis, double angle) { return math::from_axis_angle(axis, angle); };
  for (int round = 0; round < 20; ++round) {
    const MtmJoints q = random_joints(random);
    const math::Quat R_7 = turn(z, q[3]) * turn(y, -M_PI / 2) * turn(z, q[4]) * turn(y, M_PI / 2) * turn(z, q[5]) *
                           turn(x, M_PI / 2) * turn(z, q[6]);
    const double e = M_PI / 2 - std::acos(math::dot(math::rotate(R_7, z), math::rotate(turn(z, q[3]), x)));
    EXPECT_NEAR(e, q[5], 1e-9);
    EXPECT_NEAR(mtm_platform_effort(q, {}), std::clamp(0.5 * std::cos(q[4]) * e, -0.30901, 0.30901), 1e-9);
  }
}

}  // namespace
}  // namespace ambf::dvrk_arm
