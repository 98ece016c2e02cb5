#include "render/scene/motion.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace ambf::render {
namespace {

class MotionTest : public ::testing::Test {
 protected:
  MotionTest() { scene_.body(mesh::make_box(1, 1, 1), {}, nullptr); }
  void publish(std::uint64_t sequence, std::int64_t at_ms, double x) {
    auto frame = scene_.frame();
    frame->sequence = sequence;
    frame->epoch = epoch_;
    frame->steady_ns = at_ms * 1'000'000;
    frame->bodies[0].T_world_body.position.x = x;
    motion_.take(*frame);
  }
  double x_at(std::int64_t ms) { return motion_.at(ms * 1'000'000).bodies.at(0).position.x; }

  testing::SceneMaker scene_;
  Motion motion_;
  std::uint64_t epoch_ = 0;
};

TEST_F(MotionTest, FastPhysicsIsDrawnAsItComes) {
  publish(100, 1000, 1.0);
  publish(117, 1017, 2.0);  // 1 kHz, seen at 60 Hz
  EXPECT_DOUBLE_EQ(x_at(1017), 2.0);
}

TEST_F(MotionTest, SlowPhysicsMovesSmoothlyInBetween) {
  publish(1, 1000, 1.0);
  publish(2, 1100, 2.0);
  EXPECT_NEAR(x_at(1100), 1.0, 1e-12);
  EXPECT_NEAR(x_at(1125), 1.25, 1e-12);
  EXPECT_NEAR(x_at(1150), 1.5, 1e-12);
  EXPECT_NEAR(x_at(1300), 2.0, 1e-12);  // never ahead of what was computed
}

TEST_F(MotionTest, TheSameFrameTakenTwiceChangesNothing) {
  publish(1, 1000, 1.0);
  publish(2, 1100, 2.0);
  publish(2, 1100, 2.0);
  EXPECT_NEAR(x_at(1150), 1.5, 1e-12);
}

TEST_F(MotionTest, AResetIsAJumpAndNoFlight) {
  publish(1, 1000, 1.0);
  epoch_ = 1;
  publish(2, 1100, 9.0);
  EXPECT_DOUBLE_EQ(x_at(1100), 9.0);
}

TEST_F(MotionTest, AfterAPauseThingsDoNotCrawlToTheirPlace) {
  publish(1, 1000, 1.0);
  publish(2, 5000, 2.0);  // one step by hand, four seconds later
  EXPECT_DOUBLE_EQ(x_at(5000), 2.0);
}

TEST_F(MotionTest, AnotherStructureIsShownAtOnce) {
  publish(1, 1000, 1.0);
  testing::SceneMaker bigger;
  bigger.body(mesh::make_box(1, 1, 1), {{3, 0, 0}, {}}, nullptr);
  bigger.body(mesh::make_box(1, 1, 1), {{4, 0, 0}, {}}, nullptr);
  auto frame = bigger.frame();
  frame->sequence = 2;
  frame->steady_ns = 1'100'000'000;
  motion_.take(*frame);
  EXPECT_EQ(motion_.at(1'100'000'000).bodies.size(), 2U);
  EXPECT_DOUBLE_EQ(x_at(1100), 3.0);
}

}  // namespace
}  // namespace ambf::render
