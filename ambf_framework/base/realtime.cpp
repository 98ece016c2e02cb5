#include "base/realtime.h"

#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <system_error>

#include "base/clock.h"

namespace ambf::base {

namespace {

std::atomic<bool> all_is_locked{false};  // what is mapped later, too

bool lock_all() { return mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0; }

}  // namespace

void set_thread_name(const char* name) {
  char shortened[16] = {};
  std::strncpy(shortened, name, sizeof shortened - 1);
  pthread_setname_np(pthread_self(), shortened);
}

bool request_precise_timers() { return prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL) == 0; }

bool request_fifo(int priority) {
  sched_param parameters{};
  parameters.sched_priority =
      std::clamp(priority, sched_get_priority_min(SCHED_FIFO), sched_get_priority_max(SCHED_FIFO));
  return sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0;
}

bool leave_fifo() {
  sched_param parameters{};
  return sched_setscheduler(0, SCHED_OTHER, &parameters) == 0 ||
         sched_setscheduler(0, SCHED_OTHER | SCHED_RESET_ON_FORK, &parameters) ==
             0;  // without privileges the flag stays
}

bool lower_priority(int nice) {
  const auto thread = static_cast<id_t>(syscall(SYS_gettid));  // Linux: "process" here means the thread
  return setpriority(PRIO_PROCESS, thread, nice) == 0;
}

void end_lower_priorities() {
  const auto own = static_cast<id_t>(syscall(SYS_gettid));
  const int nice = getpriority(PRIO_PROCESS, own);
  std::error_code problem;
  std::filesystem::directory_iterator entry("/proc/self/task", problem);
  for (; !problem && entry != std::filesystem::directory_iterator(); entry.increment(problem)) {
    const auto thread = static_cast<id_t>(std::strtoul(entry->path().filename().c_str(), nullptr, 10));
    if (getpriority(PRIO_PROCESS, thread) > nice) setpriority(PRIO_PROCESS, thread, nice);
  }
}

bool lock_memory() {
  if (mlockall(MCL_CURRENT | MCL_ONFAULT) != 0) return false;
  // With a limit, locking future memory too would make later allocations fail: then what is mapped now must do.
  rlimit limit{};
  const bool unlimited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
  if (unlimited || geteuid() == 0) all_is_locked = lock_all();
  return true;
}

void give_back_memory() {
  // The system takes back no locked page, so that all which a heap ever touched would stay.
  const bool locked = all_is_locked;
  if (locked) munlockall();
  malloc_trim(0);
  if (locked) lock_all();
}

RealTimeGrant enter_real_time(const char* thread_name, int fifo_priority) {
  set_thread_name(thread_name);
  RealTimeGrant grant;
  grant.precise_timers = request_precise_timers();
  grant.fifo = fifo_priority > 0 && request_fifo(fifo_priority);
  grant.priority = grant.fifo ? fifo_priority : 0;
  return grant;
}

std::string to_string(const RealTimeGrant& grant) {
  std::string text = grant.fifo ? "SCHED_FIFO " + std::to_string(grant.priority) : std::string("ordinary scheduling");
  text += grant.precise_timers ? ", timer slack 1 ns" : ", ordinary timer slack";
  return text;
}

std::int64_t sleep_until(std::int64_t deadline_ns, std::int64_t spin_ns) {
  const std::int64_t wake_ns = deadline_ns - std::clamp<std::int64_t>(spin_ns, 0, kMaxSpinNs);
  // Asking the kernel for a time that is over still arms a timer: tens of microseconds on virtual machines.
  if (wake_ns > steady_ns()) {
    timespec t{};
    t.tv_sec = static_cast<time_t>(wake_ns / kNanosecondsPerSecond);
    t.tv_nsec = static_cast<long>(wake_ns % kNanosecondsPerSecond);
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
    }
  }
  std::int64_t now = steady_ns();
  while (now < deadline_ns) now = steady_ns();
  return now - deadline_ns;
}

}  // namespace ambf::base
