// The clocks, in integer nanoseconds. Reading them enters no kernel lock and is allowed on real-time threads. Any
// thread; C++17.
#pragma once

#include <cstdint>

namespace ambf::base {

inline constexpr std::int64_t kNanosecondsPerSecond = 1000000000;

std::int64_t steady_ns();       // CLOCK_MONOTONIC: the time base of everything
std::int64_t system_ns();       // since 1970; may jump: only for stamps of messages
std::int64_t thread_cpu_ns();   // CPU time of the calling thread
std::int64_t process_cpu_ns();  // CPU time of all threads

constexpr double to_seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }
constexpr std::int64_t to_ns(double seconds) {
  return static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0.0 ? -0.5 : 0.5));
}

}  // namespace ambf::base
