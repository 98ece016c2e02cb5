// Expiry of commands in the simulation's own watch time.
#include "runtime/watchdog.h"

#include <gtest/gtest.h>

namespace ambf::runtime {
namespace {

constexpr std::int64_t kMs = 1000000;

TEST(Watchdog, ExpiresAfterItsTimeWithoutASignOfLife) {
  Watchdog dog(500 * kMs);
  EXPECT_FALSE(dog.expired(7, 1000 * kMs));
  EXPECT_FALSE(dog.expired(7, 1500 * kMs));
  EXPECT_TRUE(dog.expired(7, 1501 * kMs));
  EXPECT_TRUE(dog.expired(7, 9000 * kMs));
  EXPECT_FALSE(dog.expired(8, 9000 * kMs)) << "a new stamp is a sign of life";
  EXPECT_FALSE(dog.expired(8, 9400 * kMs));
}

TEST(Watchdog, DoesNotAgeWhileWatchTimeStands) {
  Watchdog dog(500 * kMs);
  for (int i = 0; i < 10000; ++i) EXPECT_FALSE(dog.expired(7, 1000 * kMs));
}

TEST(Watchdog, LivesOnWithSignsOfLifeOnly) {
  Watchdog dog(500 * kMs);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(dog.expired(i, i * 400 * kMs));
}

}  // namespace
}  // namespace ambf::runtime
