// Which fault a device has: the first one found in a cycle, for as long as it is found, and at least until the force is
// 0. Device's thread.
#pragma once

#include <cstdint>

#include "base/clock.h"
#include "state/devices.h"

namespace ambf::devices {

class FaultTracker {
 public:
  // Within a cycle; the first one counts.
  void raise(state::DeviceFault fault) {
    if (raised_ == state::DeviceFault::none) raised_ = fault;
  }
  void end_cycle(std::int64_t now_ns) {
    if (raised_ != state::DeviceFault::none) {
      if (fault_ == state::DeviceFault::none) {
        since_ns_ = now_ns;
        ++count_;
      }
      fault_ = raised_;
      until_ns_ = now_ns + base::to_ns(state::kDeviceReleaseS);
    } else if (now_ns >= until_ns_) {
      fault_ = state::DeviceFault::none;
    }
    raised_ = state::DeviceFault::none;
  }

  state::DeviceFault fault() const { return fault_; }
  std::int64_t since_ns() const { return since_ns_; }
  std::uint64_t count() const { return count_; }

 private:
  state::DeviceFault raised_ = state::DeviceFault::none, fault_ = state::DeviceFault::none;
  std::int64_t since_ns_ = 0, until_ns_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace ambf::devices
