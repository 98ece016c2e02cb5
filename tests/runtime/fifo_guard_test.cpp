// Stepping down from SCHED_FIFO: in lasting overload only, soon enough, and not for ever.
#include "runtime/detail/fifo_guard.h"

#include <gtest/gtest.h>

namespace ambf::runtime {
namespace {

// Turns of 1 ms that use a share of a core; remembers what was advised.
class FifoGuardTest : public ::testing::Test {
 protected:
  void run(double seconds, double share) {
    for (const std::int64_t end = now_ns + static_cast<std::int64_t>(seconds * 1e9); now_ns < end;) {
      now_ns += 1'000'000;
      cpu_ns += static_cast<std::int64_t>(share * 1e6);
      if (!guard.due(now_ns)) continue;
      ++readings;
      const FifoGuard::Advice advice = guard.update(now_ns, cpu_ns);
      down += advice == FifoGuard::Advice::step_down;
      up += advice == FifoGuard::Advice::step_up;
    }
  }
  FifoGuard guard;
  std::int64_t now_ns = 7'000'000'000'000, cpu_ns = 3'000'000;
  int readings = 0, down = 0, up = 0;
};

TEST_F(FifoGuardTest, WhoKeepsUpStays) {
  run(20.0, 0.9);
  EXPECT_EQ(down, 0);
  EXPECT_LT(readings, 50);  // each costs a system call
}

TEST_F(FifoGuardTest, ShortBurstsAreNoOverload) {
  for (int i = 0; i < 20; ++i) {
    run(0.2, 1.0);
    run(0.3, 0.5);
  }
  EXPECT_EQ(down, 0);
}

TEST_F(FifoGuardTest, LastingOverloadStepsDownOnceBeforeTheKernelsSecondIsOver) {
  run(1.0, 0.3);
  run(0.95, 0.999);
  EXPECT_EQ(down, 1);
  EXPECT_TRUE(guard.stepped_down());
  run(60.0, 0.999);
  EXPECT_EQ(down, 1);
  EXPECT_EQ(up, 0);
}

TEST_F(FifoGuardTest, StepsUpWhenItHasKeptUpForAWhile) {
  run(3.0, 0.999);
  run(1.0, 0.5);
  EXPECT_EQ(up, 0);  // not at the first breath
  run(2.0, 0.5);
  EXPECT_EQ(up, 1);
  EXPECT_FALSE(guard.stepped_down());
  run(3.0, 0.999);  // and again
  EXPECT_EQ(down, 2);
}

TEST_F(FifoGuardTest, OthersOnTheCoreDoNotKeepItDown) {
  run(3.0, 0.999);
  run(4.0, 0.5);  // half of a shared core is all it gets, however much it wants
  EXPECT_EQ(up, 1);
}

}  // namespace
}  // namespace ambf::runtime
