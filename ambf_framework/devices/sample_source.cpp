#include "devices/detail/sample_source.h"

#include <algorithm>

#include "base/clock.h"

namespace ambf::devices {

using state::DeviceFault;

namespace {

constexpr double kSlowest_s = 0.1;  // of samples; what comes less often is not interpolated over longer
constexpr double kShareOfNew = 0.1;

}  // namespace

void SampleSource::read(std::int64_t now_ns, FaultTracker& faults) {
  is_new_ = false;
  const bool open = inbox_.driver.load(std::memory_order_acquire) == DriverState::open;
  if (open && !connected_) {
    opened_ns_ = read_ns_ = now_ns;
    check_.restart();
    fresh_ = Fresh::none;
  }
  if (fresh_ == Fresh::now) fresh_ = Fresh::earlier;
  connected_ = open;
  ever_connected_ |= open;
  given_.open = open;
  if (!open) return faults.raise(ever_connected_ ? DeviceFault::lost : DeviceFault::not_found);

  Sample sample;
  const Reading reading = driver_.read(sample, 0.0);
  given_.reading = reading;
  given_.sample = sample;
  if (reading == Reading::lost) {
    connected_ = false;
    inbox_.driver.store(DriverState::lost, std::memory_order_release);
    inbox_.driver_lost.notify_all();
    return faults.raise(DeviceFault::lost);
  }
  if (reading == Reading::sample && sample.stamp_ns != 0) {
    const DeviceFault fault = check_.check(sample);
    if (fault == DeviceFault::none || fault == DeviceFault::jump) accept(sample, now_ns);
    if (fault != DeviceFault::none) {
      ++refused_;
      faults.raise(fault);
    }
  }
  const double silent_s = std::max(kSilentPeriods * period_s_, kSilentAtLeast_s);
  if (!driver_.traits().event_driven && base::to_seconds(now_ns - read_ns_) > silent_s) {
    faults.raise(DeviceFault::silent);
  }
  if (has_sample() && !sample_.ready) faults.raise(DeviceFault::not_ready);
}

void SampleSource::accept(const Sample& sample, std::int64_t now_ns) {
  const double since_last_s = base::to_seconds(now_ns - read_ns_);
  if (driver_.traits().event_driven) {
    period_s_ = cycle_s_;
  } else if (number_ > 0 && since_last_s < kSlowest_s) {
    period_s_ += kShareOfNew * (since_last_s - period_s_);
  }
  sample_ = sample;
  read_ns_ = now_ns;
  is_new_ = true;
  if (fresh_ == Fresh::none) fresh_ = Fresh::now;
  ++number_;
}

bool SampleSource::started(std::int64_t now_ns) const {
  return connected_ && base::to_seconds(now_ns - opened_ns_) >= driver_.traits().hold_at_start_s;
}

}  // namespace ambf::devices
