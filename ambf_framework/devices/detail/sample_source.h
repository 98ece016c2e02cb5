// Reads a device's driver: newest fit sample, how often they come, and what is wrong with them. Device's thread.
#pragma once

#include <cstdint>

#include "devices/detail/fault_tracker.h"
#include "devices/device_inbox.h"
#include "devices/driver.h"
#include "devices/sample_check.h"

namespace ambf::devices {

class SampleSource {
 public:
  static constexpr double kSilentPeriods = 3.0, kSilentAtLeast_s = 0.03;

  SampleSource(Driver& driver, DeviceInbox& inbox, double period_s)
      : driver_(driver), inbox_(inbox), period_s_(period_s), cycle_s_(period_s) {}

  // Once a cycle: reads the driver while it is open, raises what is wrong.
  void read(std::int64_t now_ns, FaultTracker& faults);

  bool connected() const { return connected_; }
  bool ever_connected() const { return ever_connected_; }
  // The hold at the start is over; it begins each time the hardware is opened.
  bool started(std::int64_t now_ns) const;
  // Since the hardware was opened.
  bool has_sample() const { return fresh_ != Fresh::none; }
  // And another cycle has anchored on it: before, the hand may be anywhere.
  bool settled() const { return fresh_ == Fresh::earlier; }
  bool is_new() const { return is_new_; }  // since the cycle before
  const Sample& sample() const { return sample_; }
  std::uint64_t number() const { return number_; }
  std::int64_t read_ns() const { return read_ns_; }  // when it was read, steady clock
  double period_s() const { return period_s_; }      // of samples, as measured
  std::uint64_t refused() const { return refused_; }

  // What the driver gave in this cycle, before it was checked.
  struct Given {
    bool open = false;  // the driver was read
    Reading reading = Reading::nothing_new;
    Sample sample;
  };
  const Given& given() const { return given_; }

 private:
  enum class Fresh { none, now, earlier };  // first sample since the hardware was opened

  void accept(const Sample& sample, std::int64_t now_ns);

  Driver& driver_;
  DeviceInbox& inbox_;
  SampleCheck check_;
  bool connected_ = false, ever_connected_ = false, is_new_ = false;
  Fresh fresh_ = Fresh::none;
  std::int64_t opened_ns_ = 0, read_ns_ = 0;
  Sample sample_;
  Given given_;
  std::uint64_t number_ = 0, refused_ = 0;
  double period_s_, cycle_s_;
};

}  // namespace ambf::devices
