#include "runtime/detail/fifo_guard.h"

namespace ambf::runtime {

FifoGuard::Advice FifoGuard::update(std::int64_t now_ns, std::int64_t thread_cpu_ns) {
  const auto elapsed = static_cast<double>(now_ns - window_start_ns_);
  const double share = static_cast<double>(thread_cpu_ns - window_start_cpu_ns_) / elapsed;
  const bool whole = begun_;
  begun_ = true;
  window_start_ns_ = now_ns;
  window_start_cpu_ns_ = thread_cpu_ns;
  if (!whole) return Advice::none;
  if (!down_) {
    if (share <= kOverloaded) return Advice::none;
    down_ = true;
    calm_ = 0;
    return Advice::step_down;
  }
  calm_ = share < kCaughtUp ? calm_ + 1 : 0;
  if (calm_ < kCalmWindows) return Advice::none;
  down_ = false;
  return Advice::step_up;
}

}  // namespace ambf::runtime
