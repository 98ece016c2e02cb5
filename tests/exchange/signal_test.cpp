// The event count: a notification between looking and sleeping is never missed, sleepers wake, timeouts end.
#include "exchange/signal.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace ambf::exchange {
namespace {

using namespace std::chrono_literals;

TEST(Signal, DoesNotSleepWhenSomethingHappenedSinceTheLook) {
  Signal signal;
  const auto seen = signal.count();
  signal.notify_all();
  EXPECT_TRUE(signal.wait_until(seen, base::kNoDeadline)) << "would sleep for ever otherwise";
  EXPECT_EQ(signal.count(), seen + 1);
}

TEST(Signal, GivesUpAtTheTimeoutAndNotBefore) {
  Signal signal;
  const std::int64_t begin = base::steady_ns();
  EXPECT_FALSE(signal.wait_beyond(signal.count(), 20ms));
  EXPECT_GE(base::steady_ns() - begin, 20000000);
  EXPECT_FALSE(signal.wait_beyond(signal.count(), 0ms));
  EXPECT_FALSE(signal.wait_beyond(signal.count(), -5ms));
}

TEST(SignalThreads, WakesEverySleeper) {
  Signal signal;
  std::atomic<int> ready{0}, woken{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      const auto seen = signal.count();
      ++ready;
      if (signal.wait_beyond(seen, 60s)) ++woken;
    });
  }
  while (ready != 4) std::this_thread::yield();
  signal.notify_all();
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(woken, 4);
}

// Two threads hand a number to and fro. A wake-up that is missed once makes a wait run into its timeout.
TEST(SignalThreads, LosesNoWakeUpInAPingPong) {
  Signal ping, pong;
  std::atomic<int> a{0}, b{0}, timeouts{0};
  constexpr int kRounds = 5000;
  auto wait_for = [&](Signal& signal, const std::atomic<int>& value, int target) {
    for (;;) {
      const auto seen = signal.count();
      if (value.load() >= target) return;
      if (!signal.wait_beyond(seen, 30s)) ++timeouts;
    }
  };
  std::thread other([&] {
    for (int i = 1; i <= kRounds; ++i) {
      wait_for(ping, a, i);
      b = i;
      pong.notify_all();
    }
  });
  for (int i = 1; i <= kRounds; ++i) {
    a = i;
    ping.notify_all();
    wait_for(pong, b, i);
  }
  other.join();
  EXPECT_EQ(timeouts, 0);
}

}  // namespace
}  // namespace ambf::exchange
