#include "base/clock.h"

#include <ctime>

namespace ambf::base {

namespace {
std::int64_t read(clockid_t id) {
  timespec t{};
  clock_gettime(id, &t);
  return static_cast<std::int64_t>(t.tv_sec) * kNanosecondsPerSecond + t.tv_nsec;
}
}  // namespace

std::int64_t steady_ns() { return read(CLOCK_MONOTONIC); }
std::int64_t system_ns() { return read(CLOCK_REALTIME); }
std::int64_t thread_cpu_ns() { return read(CLOCK_THREAD_CPUTIME_ID); }
std::int64_t process_cpu_ns() { return read(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace ambf::base
