// Joints under the joint block solver: loops close, motors and limits do what they say, nothing breaks in hard cases.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/physics/mechanisms.h"

namespace ambf::physics::testing {
namespace {

constexpr double kMillimetre = 1e-3;

// Largest pivot gap seen over `steps`, after `before` each step.
template <class F>
double largest_gap_over(BulletScene& scene, int steps, F&& before) {
  double largest = 0.0;
  for (int i = 0; i < steps; ++i) {
    before(i * kStep);
    scene.step();
    const double now = scene.largest_gap();
    if (!(now <= largest)) largest = now;
  }
  return largest;
}

double largest_gap_over(BulletScene& scene, int steps) {
  return largest_gap_over(scene, steps, [](double) {});
}

TEST(ClosedLoop, TenLoadedFourBarsStayClosedAndTurnAtTheirMotorsSpeed) {
  BulletScene scene;
  const auto motors = add_four_bars(scene, 10, 10.0);
  EXPECT_LT(largest_gap_over(scene, 2700), 0.05 * kMillimetre);
  for (auto* motor : motors) {
    const btRigidBody& crank = motor->getRigidBodyA();
    EXPECT_NEAR(std::fabs(crank.getAngularVelocity().y()), 2.0, 1e-4);
  }
}

TEST(ClosedLoop, TenCoupledLoadedFourBarsPassTheirSingularPoseClosed) {
  BulletScene scene;
  btHingeConstraint& motor = add_coupled_chain(scene, 10, 10.0);
  double lowest = 1.0;  // cosine of the crank's angle to the row of feet: 0 upright, +-1 in line
  double largest_in_line = 0.0;
  const double gap = largest_gap_over(scene, 2700, [&](double) {
    const btVector3 along = motor.getRigidBodyA().getWorldTransform().getBasis().getColumn(0);
    lowest = std::min(lowest, std::fabs(along.x()));
    largest_in_line = std::max(largest_in_line, std::fabs(along.x()));
  });
  EXPECT_LT(gap, 0.05 * kMillimetre);
  EXPECT_GT(largest_in_line, 0.999) << "never came to the singular pose";
}

TEST(ClosedLoop, PlainSequentialImpulseOpensTheSameChainFarMore) {
  SceneOptions plain;
  plain.solver.direct = false;
  BulletScene scene(plain);
  add_coupled_chain(scene, 10, 10.0);
  const double theirs = largest_gap_over(scene, 1500);
  BulletScene ours;
  add_coupled_chain(ours, 10, 10.0);
  EXPECT_GT(theirs, 20.0 * largest_gap_over(ours, 1500));
}

TEST(ClosedLoop, OverconstrainedManipulatorHoldsAndMoves) {
  BulletScene scene;
  const auto joints = add_manipulator(scene, btVector3(0, 0, 1));
  auto* yaw = static_cast<btHingeConstraint*>(joints[0]);
  auto* pitch = static_cast<btHingeConstraint*>(joints[1]);
  const double gap = largest_gap_over(scene, 4000, [&](double time) {
    drive(*yaw, 0.6 * std::cos(SIMD_PI * time), 500.0);
    drive(*pitch, 0.6 * std::cos(SIMD_PI * time), 500.0);
  });
  EXPECT_LT(gap, 0.05 * kMillimetre);
}

TEST(ClosedLoop, StewartPlatformStaysClosedUnderLoadWhileItsLegsMove) {
  BulletScene scene;
  const StewartPlatform stewart = add_stewart_platform(scene, 20.0);
  const double height = stewart.platform->getWorldTransform().getOrigin().z();
  EXPECT_LT(largest_gap_over(scene, 1000), 0.05 * kMillimetre);
  EXPECT_NEAR(stewart.platform->getWorldTransform().getOrigin().z(), height, 0.1 * kMillimetre);
  const double gap = largest_gap_over(scene, 2000, [&](double time) {
    for (auto* leg : stewart.legs) leg->setTargetLinMotorVelocity(0.05 * std::sin(SIMD_2_PI * time));
  });
  EXPECT_LT(gap, 0.05 * kMillimetre);
}

// Pivots rounded to a tenth of a millimetre, as files of robots have them: the loop cannot close, and the rows
// contradict each other. The error must be shared out, not pumped up.
TEST(ClosedLoop, LoopThatCannotCloseKeepsItsLeastSquaresErrorAndStaysQuiet) {
  BulletScene scene;
  const auto joints = add_manipulator(scene, btVector3(0, 0, 1));
  for (std::size_t i = 1; i < 9; ++i) {
    auto* hinge = static_cast<btHingeConstraint*>(joints[i]);
    const auto spread = [i](int n) { return static_cast<double>(static_cast<int>(i) % n) - 0.5 * (n - 1); };
    hinge->getAFrame().getOrigin() += btVector3(1e-4 * spread(3), 5e-5 * spread(2), -1e-4 * spread(4));
  }
  scene.step(500);
  EXPECT_LT(largest_gap_over(scene, 2000), 0.4 * kMillimetre);
  double fastest = 0.0;
  for (const auto& body : scene.bodies()) fastest = std::max(fastest, body->getLinearVelocity().length());
  EXPECT_LT(fastest, 1e-3);
}

// A controller outside the solver: torque = kp error + kd rate error at each joint, on both links.
void hold(const Arm& arm, double time, double amplitude) {
  const double kp[7] = {8000, 8000, 100, 3000, 100, 600, 50};
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    btHingeConstraint& joint = *arm.joints[i];
    btRigidBody& a = joint.getRigidBodyA();
    btRigidBody& b = joint.getRigidBodyB();
    const btVector3 axis = a.getWorldTransform().getBasis() * joint.getAFrame().getBasis().getColumn(2);
    const double angle = -joint.getHingeAngle();  // Bullet counts from b to a
    const double rate = axis.dot(b.getAngularVelocity() - a.getAngularVelocity());
    const double wanted = amplitude * std::sin(SIMD_PI * time);
    const double wanted_rate = amplitude * SIMD_PI * std::cos(SIMD_PI * time);
    const double torque = kp[i] * (wanted - angle) + 0.008 * kp[i] * (wanted_rate - rate);
    b.applyTorque(torque * axis);
    a.applyTorque(-torque * axis);
  }
}

TEST(SevenLinkArm, TwentyKilogramsOpenNoJointUnderAController) {
  BulletScene scene;
  const Arm arm = add_arm(scene, 20.0);
  EXPECT_LT(largest_gap_over(scene, 2000, [&](double time) { hold(arm, time, 0.0); }), 0.01 * kMillimetre);
  EXPECT_LT(largest_gap_over(scene, 4000, [&](double time) { hold(arm, time, 0.2); }), 0.01 * kMillimetre);
  for (auto* joint : arm.joints) EXPECT_LT(std::fabs(joint->getHingeAngle()), 0.3) << "the controller lost the arm";
}

TEST(SevenLinkArm, TwentyKilogramsOpenNoJointWhileMotorsHoldOrFollowSinusoids) {
  BulletScene scene;
  const Arm arm = add_arm(scene, 20.0);
  for (auto* joint : arm.joints) drive(*joint, 0.0, 1000.0);
  const double height = arm.payload->getWorldTransform().getOrigin().z();
  EXPECT_LT(largest_gap_over(scene, 2000), 0.01 * kMillimetre);
  EXPECT_NEAR(arm.payload->getWorldTransform().getOrigin().z(), height, 0.1 * kMillimetre);
  const double gap = largest_gap_over(scene, 4000, [&](double time) {
    for (std::size_t i = 0; i < arm.joints.size(); ++i) {
      drive(*arm.joints[i], 0.5 * std::sin(SIMD_PI * time + 0.3 * static_cast<double>(i)), 1000.0);
    }
  });
  EXPECT_LT(gap, 0.01 * kMillimetre);
}

TEST(Motor, TurnsExactlyAtItsSpeedThroughALoadedChain) {
  BulletScene scene;
  const Arm arm = add_arm(scene, 5.0);
  for (std::size_t i = 0; i < arm.joints.size(); ++i) drive(*arm.joints[i], i == 0 ? 0.5 : 0.0, 1e4);
  scene.step(500);
  const btVector3 spin = arm.joints[0]->getRigidBodyA().getAngularVelocity();
  EXPECT_NEAR(std::fabs(spin.z()), 0.5, 1e-5);
}

TEST(Motor, SaturatedMotorGivesExactlyItsLargestImpulse) {
  BulletScene scene;
  auto& bar = scene.add_box(btVector3(0.5, 0.05, 0.05), 2.0, btVector3(0.5, 0, 0), false);
  auto& hinge = scene.add_hinge(bar, btVector3(0, 0, 0), btVector3(0, 1, 0));
  btJointFeedback feedback{};
  hinge.setJointFeedback(&feedback);
  hinge.enableFeedback(true);
  drive(hinge, 0.0, 3.0);  // holding would need 9.81 N m
  scene.step(10);
  EXPECT_EQ(std::fabs(hinge.getAppliedImpulse()), 3.0 * kStep);
  const double alpha = (2.0 * 9.81 * 0.5 - 3.0) / (bar.getLocalInertia().y() + 2.0 * 0.25);
  EXPECT_NEAR(std::fabs(bar.getAngularVelocity().y()), alpha * 10 * kStep, 1e-3 * alpha * 10 * kStep);
  // Given enough, it holds with what is needed and no more.
  BulletScene strong;
  auto& same = strong.add_box(btVector3(0.5, 0.05, 0.05), 2.0, btVector3(0.5, 0, 0), false);
  auto& holder = strong.add_hinge(same, btVector3(0, 0, 0), btVector3(0, 1, 0));
  holder.enableFeedback(true);
  drive(holder, 0.0, 30.0);
  strong.step(10);
  EXPECT_NEAR(std::fabs(holder.getAppliedImpulse()), 9.81 * kStep, 1e-6 * kStep);
}

TEST(Motor, SeveralSaturatedMotorsOfOneChainEachGiveTheirLargestImpulse) {
  BulletScene scene;
  const Arm arm = add_arm(scene, 20.0);
  for (auto* joint : arm.joints) {
    drive(*joint, 0.0, 2.0);
    joint->enableFeedback(true);
  }
  scene.step(5);
  int saturated = 0;
  for (auto* joint : arm.joints) {
    const double impulse = std::fabs(joint->getAppliedImpulse());
    EXPECT_LE(impulse, 2.0 * kStep);
    saturated += impulse == 2.0 * kStep ? 1 : 0;
  }
  EXPECT_GE(saturated, 2);
  EXPECT_EQ(scene.solver().statistics().joints.fallbacks, 0U);
}

TEST(Limit, LimitsOfSeveralJointsHoldUnderLoad) {
  BulletScene scene;
  const Arm arm = add_arm(scene, 20.0);
  for (auto* joint : arm.joints) joint->setLimit(-0.2, 0.2, 0.9, 1.0, 0.0);
  double largest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    scene.step();
    for (auto* joint : arm.joints) largest = std::max(largest, std::fabs(joint->getHingeAngle()));
  }
  int at_limit = 0;
  for (auto* joint : arm.joints) at_limit += std::fabs(joint->getHingeAngle()) > 0.199 ? 1 : 0;
  EXPECT_GE(at_limit, 2);
  EXPECT_LT(largest, 0.2 + 0.02);  // the step in which a limit is met
  EXPECT_LT(scene.largest_gap(), 0.01 * kMillimetre);
  scene.step(1000);
  for (auto* joint : arm.joints) EXPECT_LT(std::fabs(joint->getHingeAngle()), 0.2 + 1e-3);
}

TEST(Limit, OneWayRowsOnlyPush) {
  BulletScene scene;
  auto& bar = scene.add_box(btVector3(0.5, 0.05, 0.05), 1.0, btVector3(0.5, 0, 0), false);
  auto& hinge = scene.add_hinge(bar, btVector3(0, 0, 0), btVector3(0, 1, 0));
  hinge.setLimit(-0.1, 0.1, 0.9, 1.0, 0.0);
  scene.step(500);  // rests on a limit
  const double rest = hinge.getHingeAngle();
  EXPECT_NEAR(std::fabs(rest), 0.1, 2e-3);
  const btVector3 spin(0, -5.0, 0);  // away from it
  bar.setAngularVelocity(spin);
  bar.setLinearVelocity(spin.cross(bar.getWorldTransform().getOrigin()));
  scene.step(5);
  EXPECT_GT(std::fabs(hinge.getHingeAngle() - rest), 0.02);
}

// (A slack chain of such links would be another matter: a taut string this light swings faster than the step can
// follow.)
TEST(HardCases, MassRatioOfTenThousandStaysClosedAndHeld) {
  BulletScene scene;
  btVector3 at(0, 0, 3);
  btRigidBody* previous = nullptr;
  for (int i = 0; i < 8; ++i) {
    const btVector3 next = at + btVector3(0.1, 0, 0);
    auto& link = scene.add_box(btVector3(0.05, 0.01, 0.01), i == 7 ? 10.0 : 1e-3, 0.5 * (at + next), false);
    auto& hinge = previous ? scene.add_hinge(*previous, link, at, btVector3(0, 1, 0))
                           : scene.add_hinge(link, at, btVector3(0, 1, 0));
    drive(hinge, i == 0 ? 0.5 : 0.0, 1e4);
    previous = &link;
    at = next;
  }
  EXPECT_LT(largest_gap_over(scene, 3000), 0.05 * kMillimetre);
  EXPECT_NEAR(std::fabs(previous->getAngularVelocity().y()), 0.5, 1e-3);
}

TEST(HardCases, BodyThatCannotTurnIsCarriedByAFullJoint) {
  BulletScene scene;
  auto& carrier = scene.add_box(btVector3(0.1, 0.1, 0.1), 1.0, btVector3(0, 0, 1), false);
  auto& point = scene.add_box(btVector3(0.01, 0.01, 0.01), 0.5, btVector3(0.3, 0, 1), false);
  point.setMassProps(0.5, btVector3(0, 0, 0));  // zero inverse inertia: no turning
  point.updateInertiaTensor();
  scene.add_weld(carrier, point);
  auto& hinge = scene.add_hinge(carrier, btVector3(0, 0, 1), btVector3(0, 1, 0));
  drive(hinge, 0.0, 100.0);
  scene.step(1000);
  for (const double value : scene.state()) ASSERT_TRUE(std::isfinite(value));
  EXPECT_NEAR(point.getWorldTransform().getOrigin().z(), 1.0, 1e-4);
}

TEST(HardCases, NotANumberEndsTheStepAndSparesOtherIslands) {
  BulletScene scene;
  const auto motors = add_four_bars(scene, 2, 0.0);
  scene.step(10);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const_cast<btRigidBody&>(motors[0]->getRigidBodyA()).setAngularVelocity(btVector3(nan, 0, 0));
  scene.step(3);
  EXPECT_NEAR(std::fabs(motors[1]->getRigidBodyA().getAngularVelocity().y()), 2.0, 1e-4);
  EXPECT_LT(scene.gap(*motors[1]), 0.05 * kMillimetre);
}

TEST(HardCases, JointsThatBreakLetGo) {
  BulletScene scene;
  auto& box = scene.add_box(btVector3(0.1, 0.1, 0.1), 10.0, btVector3(0, 0, 1), false);
  auto& ball = scene.add_ball(box, btVector3(0, 0, 1));
  ball.setBreakingImpulseThreshold(0.5 * 10.0 * 9.81 * kStep);
  scene.step(2);
  EXPECT_FALSE(ball.isEnabled());
  scene.step(100);
  EXPECT_LT(box.getWorldTransform().getOrigin().z(), 0.99);
}

TEST(HardCases, JointsComeAndGoWhileTheWorldRuns) {
  BulletScene scene;
  const auto motors = add_four_bars(scene, 3, 1.0);
  scene.step(50);
  const auto before = scene.solver().statistics().symbolic_analyses;
  EXPECT_EQ(before, 3U);
  scene.world().removeConstraint(motors[1]);
  scene.step(50);
  EXPECT_EQ(scene.solver().statistics().symbolic_analyses, before + 1);
  scene.world().addConstraint(motors[1], true);
  scene.step(1);
  EXPECT_EQ(scene.solver().statistics().symbolic_analyses, before + 1) << "a structure met before is remembered";
}

TEST(Feedback, JointReportsTheForceItCarries) {
  BulletScene scene;
  auto& box = scene.add_box(btVector3(0.1, 0.1, 0.1), 3.0, btVector3(0, 0, 1), false);
  auto& ball = scene.add_ball(box, btVector3(0, 0, 1));
  btJointFeedback feedback{};
  ball.setJointFeedback(&feedback);
  scene.step(20);
  EXPECT_NEAR(feedback.m_appliedForceBodyA.z(), 3.0 * 9.81, 1e-4);
}

}  // namespace
}  // namespace ambf::physics::testing
