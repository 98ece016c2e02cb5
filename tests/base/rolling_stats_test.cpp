// Percentiles against sorting, forgetting, and rates.
#include "base/rolling_stats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace ambf::base {
namespace {

constexpr std::int64_t kSecond = 1000000000;

std::int64_t exact(const std::vector<std::int64_t>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[rank - 1];
}

TEST(RollingStats, AgreesWithSortingWithinABucket) {
  std::mt19937_64 rng(3);
  std::lognormal_distribution<double> spread(10.0, 2.5);
  for (int round = 0; round < 5; ++round) {
    RollingStats stats;
    std::vector<std::int64_t> values;
    for (int i = 0; i < 3000; ++i) {
      values.push_back(static_cast<std::int64_t>(spread(rng)));
      stats.add(values.back(), kSecond + i * 100000);
    }
    std::sort(values.begin(), values.end());
    const Percentiles p = stats.percentiles(kSecond + 300000000);
    EXPECT_EQ(p.count, 3000u);
    const auto near = [](std::int64_t a, std::int64_t b) {
      return std::abs(static_cast<double>(a - b)) <= 1.0 + static_cast<double>(b) / 32.0;
    };
    EXPECT_PRED2(near, p.p50_ns, exact(values, 0.5));
    EXPECT_PRED2(near, p.p99_ns, exact(values, 0.99));
    EXPECT_PRED2(near, p.p999_ns, exact(values, 0.999));
    EXPECT_EQ(p.max_ns, values.back());
  }
}

TEST(RollingStats, ForgetsWhatIsOlderThanTheWindow) {
  RollingStats stats;
  stats.add(5000000, kSecond);
  for (int i = 0; i < 100; ++i) stats.add(1000, kSecond + 500000000);
  EXPECT_EQ(stats.percentiles(kSecond + 600000000).max_ns, 5000000);
  const Percentiles later = stats.percentiles(2 * kSecond + 50000000);
  EXPECT_EQ(later.count, 100u);
  EXPECT_EQ(later.max_ns, 1000);
  EXPECT_EQ(stats.percentiles(100 * kSecond).count, 0u);
  EXPECT_EQ(stats.percentiles(100 * kSecond).p999_ns, 0);
}

TEST(RollingStats, TakesSmallNegativeAndAbsurdValues) {
  RollingStats stats;
  for (std::int64_t v :
       {std::int64_t{-5}, std::int64_t{0}, std::int64_t{31}, std::int64_t{32}, std::int64_t{1} << 62}) {
    stats.add(v, kSecond);
  }
  const Percentiles p = stats.percentiles(kSecond);
  EXPECT_EQ(p.count, 5u);
  EXPECT_EQ(p.p50_ns, 31);
  EXPECT_EQ(p.max_ns, std::int64_t{1} << 62);
}

TEST(RollingRate, FollowsAChangeWithinASecondAndShowsAStallTruly) {
  RollingRate rate;
  std::int64_t now = 7 * kSecond;
  double counter = 0.0;
  rate.start(now);
  for (int i = 0; i < 3000; ++i) rate.update(now += 1000000, counter += 1.0);
  EXPECT_NEAR(rate.per_second(), 1000.0, 1.0);
  for (int i = 0; i < 1100; ++i) rate.update(now += 1000000, counter += 0.5);
  EXPECT_NEAR(rate.per_second(), 500.0, 1.0);
  rate.update(now += 10 * kSecond, counter);  // ten seconds of nothing
  EXPECT_LT(rate.per_second(), 60.0);
}

TEST(RollingRate, IsRightFromTheStart) {
  RollingRate rate;
  EXPECT_EQ(rate.per_second(), 0.0);
  rate.start(100, 5.0);
  EXPECT_EQ(rate.per_second(), 0.0);
  rate.update(100 + kSecond / 100, 15.0);
  EXPECT_NEAR(rate.per_second(), 1000.0, 1e-6);
}

}  // namespace
}  // namespace ambf::base
