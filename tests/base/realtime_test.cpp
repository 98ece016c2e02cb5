// What can be promised of the operating system's favours without the permissions: they are asked for, and the answer is
// true.
#include "base/realtime.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>

#include "base/clock.h"

namespace ambf::base {
namespace {

TEST(SleepUntil, NeverReturnsEarly) {
  for (std::int64_t spin : {std::int64_t{0}, kMaxSpinNs, std::int64_t{1000000000}}) {
    for (int i = 0; i < 20; ++i) {
      const std::int64_t deadline = steady_ns() + 300000;
      const std::int64_t late = sleep_until(deadline, spin);
      EXPECT_GE(late, 0);
      EXPECT_GE(steady_ns(), deadline + late);
    }
  }
  EXPECT_GT(sleep_until(steady_ns() - 1000000), 999999)
      << "a deadline in the past returns at once and says how late it is";
}

TEST(SleepUntil, SpinsAMomentAtMost) {
  const std::int64_t cpu = thread_cpu_ns(), begin = steady_ns();
  sleep_until(begin + 50000000, 50000000);
  EXPECT_LT(thread_cpu_ns() - cpu, 25000000) << "most of it is slept";
}

bool running_fifo() { return (sched_getscheduler(0) & ~SCHED_RESET_ON_FORK) == SCHED_FIFO; }

TEST(RealTime, GrantTellsTheTruthAndIsNotInherited) {
  std::thread([] {
    const RealTimeGrant grant = enter_real_time("ambf-test-thread-long-name", 20);
    EXPECT_EQ(grant.fifo, running_fifo());
    const int slack = prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL);  // 0 for a FIFO thread on newer kernels
    EXPECT_EQ(grant.precise_timers, slack == 0 || slack == 1) << slack;
    char name[16] = {};
    pthread_getname_np(pthread_self(), name, sizeof name);
    EXPECT_EQ(std::string(name), "ambf-test-threa");
    EXPECT_NE(to_string(grant).find(grant.fifo ? "SCHED_FIFO 20" : "ordinary"), std::string::npos);
    std::thread([] { EXPECT_FALSE(running_fifo()); }).join();
    if (grant.fifo) {
      EXPECT_TRUE(leave_fifo());
      EXPECT_FALSE(running_fifo());
    }
  }).join();
}

TEST(RealTime, PriorityZeroAsksForNothing) {
  std::thread([] {
    EXPECT_FALSE(enter_real_time("x", 0).fifo);
    EXPECT_FALSE(running_fifo());
  }).join();
}

TEST(RealTime, LowersOneThreadOnly) {
  const auto nice_of_this_thread = [] { return getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid))); };
  const int before = nice_of_this_thread();
  std::thread([&] {
    ASSERT_TRUE(lower_priority(before + 3));
    EXPECT_EQ(nice_of_this_thread(), before + 3);
  }).join();
  EXPECT_EQ(nice_of_this_thread(), before);
}

// Root may; others only with RLIMIT_NICE, and then nothing changes.
TEST(RealTime, BringsLowerThreadsBackUpWhereTheSystemLetsIt) {
  const auto nice_of_this_thread = [] { return getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid))); };
  const int before = nice_of_this_thread();
  std::atomic<bool> lowered{false}, raised{false};
  int after = -1;
  bool may = false;
  std::thread thread([&] {
    lower_priority(before + 3);
    may = lower_priority(before);
    lower_priority(before + 3);
    lowered = true;
    while (!raised) std::this_thread::yield();
    after = nice_of_this_thread();
  });
  while (!lowered) std::this_thread::yield();
  end_lower_priorities();
  raised = true;
  thread.join();
  EXPECT_EQ(after, may ? before : before + 3);
}

TEST(Clock, ConvertsBothWays) {
  EXPECT_EQ(to_ns(1e-3), 1000000);
  EXPECT_EQ(to_ns(-1.5e-9), -2);
  EXPECT_DOUBLE_EQ(to_seconds(1500000000), 1.5);
}

}  // namespace
}  // namespace ambf::base
