#include "doorbell.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <climits>
#include <ctime>

#include "base/clock.h"

namespace ambf::python {
namespace {

constexpr std::int64_t kSpinNs = 20000;  // about what waking a sleeper costs

std::uint32_t read(const std::uint32_t& bell) {
  return std::atomic_ref<const std::uint32_t>(bell).load(std::memory_order_acquire);
}

}  // namespace

void ring(std::uint32_t& bell) {
  std::atomic_ref<std::uint32_t>(bell).fetch_add(1, std::memory_order_acq_rel);
  // Not the private futex of base/futex.h: the sleeper is another process.
  syscall(SYS_futex, &bell, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

bool wait_for_ring(const std::uint32_t& bell, std::uint32_t seen, double timeout_s) {
  const std::int64_t start_ns = base::steady_ns();
  const std::int64_t end_ns = start_ns + base::to_ns(timeout_s);
  while (read(bell) == seen) {
    const std::int64_t now_ns = base::steady_ns();
    if (now_ns >= end_ns) return false;
    if (now_ns - start_ns < kSpinNs) continue;
    const std::int64_t left_ns = end_ns - now_ns;
    const timespec left{left_ns / 1000000000, left_ns % 1000000000};
    syscall(SYS_futex, &bell, FUTEX_WAIT, seen, &left, nullptr, 0);
  }
  return true;
}

}  // namespace ambf::python
