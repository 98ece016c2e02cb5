// Tells when a command's sender has been silent for too long. The physics thread alone judges, from the stamp in the command's slot and the
// time of TimeKeeper::watch_ns, which stands still while the simulation is paused or waits for a throttle clock. Pure.
#pragma once

#include <cstdint>

namespace ambf::runtime {

class Watchdog {
 public:
  explicit Watchdog(std::int64_t timeout_ns = 500000000) : timeout_ns_(timeout_ns) {}

  // Ask once a turn. `stamp` is the slot's time of the last sign of life: any change of it counts as one. True once the time is over,
  // until there is another sign of life.
  bool expired(std::int64_t stamp, std::int64_t watch_ns) {
    if (stamp != stamp_) {
      stamp_ = stamp;
      since_ns_ = watch_ns;
    }
    return watch_ns - since_ns_ > timeout_ns_;
  }

 private:
  std::int64_t timeout_ns_;
  std::int64_t stamp_ = -1;
  std::int64_t since_ns_ = 0;
};

}  // namespace ambf::runtime
