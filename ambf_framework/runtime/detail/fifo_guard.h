// When a thread under SCHED_FIFO should step down: the kernel stops such threads once they have used 95 % of a second
// (sched_rt_runtime_us), for what is left of it, so that a simulation that cannot keep up would stand still for 50 ms
// and more each second and leave other programs only that. Under ordinary scheduling it uses the whole core without a
// pause. Pure: readings are handed in. Owned by the physics thread.
#pragma once

#include <cstdint>

namespace ambf::runtime {

class FifoGuard {
 public:
  enum class Advice { none, step_down, step_up };

  // CPU time is what counts, not time on the clock: others that share the core make nobody overloaded. Once per
  // iteration.
  bool due(std::int64_t now_ns) const { return now_ns - window_start_ns_ >= kWindowNs; }
  Advice update(std::int64_t now_ns, std::int64_t thread_cpu_ns);

  bool stepped_down() const { return down_; }

 private:
  // Half the kernel's second: the first window of an overload ends before the first stall.
  static constexpr std::int64_t kWindowNs = 500'000'000;
  static constexpr double kOverloaded = 0.94, kCaughtUp = 0.8;  // of a core
  static constexpr int kCalmWindows = 4;                        // before it steps up again

  std::int64_t window_start_ns_ = 0, window_start_cpu_ns_ = 0;
  bool begun_ = false, down_ = false;
  int calm_ = 0;
};

}  // namespace ambf::runtime
