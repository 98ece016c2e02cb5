// Staying awake for the next Step request: only for those who ask again at once, and never for long.
#include "runtime/detail/stay_awake.h"

#include <gtest/gtest.h>

namespace ambf::runtime {
namespace {

class StayAwakeTest : public ::testing::Test {
 protected:
  // Requests that each come `gap_ns` after the answer to the one before, and take 2 ms.
  void step(std::uint32_t times, std::int64_t gap_ns) {
    for (std::uint32_t i = 0; i < times; ++i) {
      awake.asked(now_ns += gap_ns);
      awake.answered(now_ns += 2'000'000);
    }
  }
  bool stays() const { return awake.until_ns() > now_ns; }

  StayAwake awake;
  std::int64_t now_ns = 7'000'000'000'000;
};

TEST_F(StayAwakeTest, SleepsWhereNobodySteps) { EXPECT_EQ(awake.until_ns(), StayAwake::kNever); }

TEST_F(StayAwakeTest, StaysAwakeForWhoStepsInALoop) {
  step(StayAwake::kHabit, 200'000);
  EXPECT_FALSE(stays());  // the first came after nothing
  step(1, 200'000);
  EXPECT_TRUE(stays());
  EXPECT_EQ(awake.until_ns(), now_ns + StayAwake::kLimitNs);
}

TEST_F(StayAwakeTest, SleepsForWhoThinksBetweenSteps) {
  step(100, 2 * StayAwake::kLimitNs);
  EXPECT_FALSE(stays());
}

TEST_F(StayAwakeTest, OnceInVainItSleepsUntilTheHabitIsBack) {
  step(100, 200'000);
  ASSERT_TRUE(stays());
  step(1, StayAwake::kLimitNs + 1);
  EXPECT_FALSE(stays());
  step(StayAwake::kHabit - 1, 200'000);
  EXPECT_FALSE(stays());
  step(1, 200'000);
  EXPECT_TRUE(stays());
}

}  // namespace
}  // namespace ambf::runtime
