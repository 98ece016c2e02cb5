#include "comm/publish_rate.h"

#include <gtest/gtest.h>

#include <random>

namespace ambf::comm {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart = 5'000 * kMs;

// Publications in `seconds` when asked every `wake_ns`, each wake up to `jitter_ns` late.
int count(PublishRate& rate, double seconds, std::int64_t wake_ns, bool active, std::int64_t jitter_ns = 0,
          std::int64_t from = kStart) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int64_t> late(0, jitter_ns);
  int published = 0;
  for (std::int64_t t = from; t < from + static_cast<std::int64_t>(seconds * 1e9); t += wake_ns) {
    published += rate.due(t + late(random), active);
  }
  return published;
}

TEST(PublishRate, IsLowWhileIdleAndHighWhileCommanded) {
  PublishRate rate(50.0, 1000.0);
  EXPECT_NEAR(count(rate, 4.0, kMs, false), 200, 1);
  EXPECT_NEAR(count(rate, 4.0, kMs, true, 0, kStart + 10'000 * kMs), 4000, 1);
}

TEST(PublishRate, MeanIsExactForRatesThatDoNotDivideTheWakes) {
  for (const double hz : {30.0, 120.0, 333.0, 700.0}) {
    PublishRate rate(hz, hz);
    EXPECT_NEAR(count(rate, 10.0, kMs, false), 10.0 * hz, 2) << hz;
  }
}

TEST(PublishRate, JitterOfWakesDoesNotLoseAny) {
  PublishRate rate(1000.0, 1000.0);
  EXPECT_NEAR(count(rate, 4.0, kMs, false, 300'000), 4000, 4);
}

TEST(PublishRate, NeverExceedsTheWakes) {
  PublishRate rate(5000.0, 5000.0);
  EXPECT_EQ(count(rate, 1.0, kMs, false), 1000);
}

TEST(PublishRate, AFirstCommandShowsAtOnce) {
  PublishRate rate(1.0, 1000.0);
  EXPECT_TRUE(rate.due(kStart, false));
  EXPECT_FALSE(rate.due(kStart + kMs, false));
  EXPECT_TRUE(rate.due(kStart + 2 * kMs, true));
}

TEST(PublishRate, WakesWithoutANewerFrameDoNotHurryTheNext) {
  PublishRate rate(100.0, 100.0);
  int published = 0;
  for (std::int64_t t = 0; t < 10'000 * kMs; t += kMs) {  // frames every 5 ms, of 200 Hz
    published += rate.due(kStart + t, true, t % (5 * kMs) == 0);
  }
  EXPECT_NEAR(published, 1000, 2);
}

TEST(PublishRate, WhatIsNotNewIsRepeatedAtTheLowRate) {
  PublishRate rate(50.0, 1000.0);
  EXPECT_TRUE(rate.due(kStart, true));
  int published = 0;
  for (std::int64_t t = kMs; t < 1000 * kMs; t += kMs) published += rate.due(kStart + t, true, false);
  EXPECT_NEAR(published, 50, 1);
}

TEST(PublishRate, NoBurstAfterALongStall) {
  PublishRate rate(1000.0, 1000.0);
  EXPECT_TRUE(rate.due(kStart, false));
  EXPECT_TRUE(rate.due(kStart + 500 * kMs, false));
  EXPECT_FALSE(rate.due(kStart + 500 * kMs + kMs / 4, false));
}

TEST(PublishRate, OverridesReplaceBothAndHighIsNeverBelowLow) {
  PublishRate both(50.0, 1000.0, {200.0, 400.0});
  EXPECT_DOUBLE_EQ(both.rate_hz(false), 200.0);
  EXPECT_DOUBLE_EQ(both.rate_hz(true), 400.0);
  PublishRate low(50.0, 100.0, {200.0, std::nullopt});
  EXPECT_DOUBLE_EQ(low.rate_hz(true), 200.0);
  PublishRate zero(0.0, 0.0);
  EXPECT_GT(zero.rate_hz(false), 0.0);
}

}  // namespace
}  // namespace ambf::comm
