// A robot of others obeys commands of every kind without being thrown about, from any pose, as those who set joint
// positions by script expect; and all stays bounded when gravity turns.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "tests/runtime/model_rig.h"

namespace ambf::runtime {
namespace {

using namespace test;
using state::JointCommandType;

constexpr double kReach = 2.0;  // m: the arm is 1.3 m long

class LbrMed : public testing::Test {
 protected:
  LbrMed() : rig_(world_of(own_descriptions() + "world/empty_world.yaml")) {}
  void SetUp() override {
    AMBF_NEEDS_COMPAT();
    ASSERT_TRUE(rig_.load(compat::model("robots/blender-kuka-lbr-med.yaml")).success);
    const auto structure = rig_.simulation.structure();
    // The base is the body above all joints.
    for (const state::BodyInfo& body : structure->bodies) {
      if (body.joints.size() <= joints_.size()) continue;
      joints_.assign(body.joints.begin(), body.joints.end());
      base_ = structure->objects[body.object].id;
    }
    ASSERT_EQ(joints_.size(), 7u);
    // Its file leaves the base 1 m from the first link; the joint brings them together gently.
    ASSERT_GT(rig_.largest_gap(), 0.5);
    ASSERT_TRUE(rig_.run(1.0).success);
    ASSERT_LT(rig_.largest_gap(), 1e-6);
    for (const state::BodyState& body : rig_.frame().bodies) home_.push_back(body.T_world_body.position);
  }

  state::AddressedCommand all(JointCommandType type, const std::vector<double>& values) const {
    state::RigidBodyCommand command;
    for (const double value : values) command.joints.push_back({type, value});
    return {base_, command};
  }
  // Sends the command every 10 ms, as scripts do, and watches all the while.
  void send(const state::AddressedCommand& command, double seconds) {
    for (double t = 0.0; t < seconds; t += 0.01) {
      ASSERT_TRUE(rig_.step(10, {command}).success);
      ASSERT_FALSE(rig_.frame().run.diverged);
      for (std::size_t slot = 0; slot < home_.size(); ++slot) {
        const state::BodyState& body = rig_.frame().bodies[slot];
        ASSERT_LT(math::norm(body.T_world_body.position - home_[slot]), kReach);
        fastest_ = std::max(fastest_, math::norm(body.twist_world.angular));
      }
      gap_ = std::max(gap_, rig_.largest_gap());
    }
  }
  std::vector<double> positions() {
    std::vector<double> out;
    for (const std::uint32_t joint : joints_) out.push_back(rig_.frame().joints[joint].position);
    return out;
  }
  std::vector<double> random_pose(std::mt19937& random) {
    const auto structure = rig_.simulation.structure();
    std::vector<double> pose;
    for (const std::uint32_t slot : joints_) {
      const state::JointInfo& info = structure->joints[slot];
      std::uniform_real_distribution<double> anywhere(info.has_limits ? 0.9 * info.lower : -3.0,
                                                      info.has_limits ? 0.9 * info.upper : 3.0);
      pose.push_back(anywhere(random));
    }
    return pose;
  }
  ModelRig rig_;
  state::ObjectId base_;
  std::vector<std::uint32_t> joints_;
  std::vector<math::Vec3> home_;
  double fastest_ = 0.0, gap_ = 0.0;
};

TEST_F(LbrMed, GoesToZeroFromAnyPoseWithoutExploding) {
  std::mt19937 random(7);
  const std::vector<double> zero(7, 0.0);
  for (int pose = 0; pose < 5; ++pose) {
    const std::vector<double> start = random_pose(random);
    send(all(JointCommandType::position, start), 3.0);
    const std::vector<double> from = positions();
    send(all(JointCommandType::position, zero), 3.0);
    const std::vector<double> to = positions();
    // The file's gains are what they are (the last joint's moves it but slowly); but everybody goes towards zero.
    for (std::size_t i = 0; i < 7; ++i) EXPECT_LT(std::abs(to[i]), 0.75 * std::abs(from[i]) + 0.02) << i;
    for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(std::abs(to[i]), 0.05) << i;
  }
  std::printf("LBR Med: five times to zero; fastest body %.1f rad/s, largest gap %.5f mm\n", fastest_, gap_ * 1e3);
  EXPECT_LT(fastest_, 100.0);
  EXPECT_LT(gap_, 0.05e-3);
}

TEST_F(LbrMed, ObeysVelocityCommands) {
  const std::vector<double> zero(7, 0.0);
  send(all(JointCommandType::position, zero), 0.5);
  send(all(JointCommandType::velocity, std::vector<double>(7, 0.3)), 1.0);
  for (const std::uint32_t joint : joints_) EXPECT_NEAR(rig_.frame().joints[joint].velocity, 0.3, 0.03);
  EXPECT_NEAR(rig_.frame().joints[joints_[0]].position, 0.3, 0.05);
}

TEST_F(LbrMed, StaysBoundedUnderEffortAndChangingGravity) {
  send(all(JointCommandType::effort, std::vector<double>(7, 5.0)), 2.0);
  rig_.simulation.set_gravity({9.81, 0, 0});
  send(all(JointCommandType::effort, std::vector<double>(7, 0.0)), 2.0);
  rig_.simulation.set_gravity({0, 0, 9.81});
  send(all(JointCommandType::position, std::vector<double>(7, 0.0)), 3.0);
  const std::vector<double> to = positions();
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(std::abs(to[i]), 0.05) << i;
  EXPECT_LT(fastest_, 100.0);
  std::printf("LBR Med under effort and turning gravity: fastest body %.1f rad/s\n", fastest_);
}

}  // namespace
}  // namespace ambf::runtime
