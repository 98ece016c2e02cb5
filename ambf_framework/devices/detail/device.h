// One input device: its driver, its thread (real time, once a period), and the thread that opens the hardware and
// searches it again when it is lost. All functions: the hub's threads.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "base/event_count.h"
#include "base/log.h"
#include "devices/detail/device_cycle.h"
#include "devices/device_inbox.h"
#include "devices/driver.h"
#include "state/abilities/observe.h"

namespace ambf::devices {

class Device {
 public:
  static constexpr int kRealTimePriority = 30;  // above physics

  struct Setup {
    std::string name;
    std::string thread_name;
    std::unique_ptr<Driver> driver;
    DeviceSettings settings;
    state::Source source = state::Source::device_0;
    double rate_hz = 1000.0;  // where the driver has none of its own
    bool real_time = true;
    bool forces = false;
    inputs::Channel* record = nullptr;  // of its cycles; null: none
  };

  // Starts both threads. `reader` must end before the simulation.
  Device(Setup setup, std::unique_ptr<state::FrameReader> reader, base::Log& log);
  ~Device();  // zero force, the effector is let go, the hardware is closed
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  DeviceInbox& inbox() { return inbox_; }
  const DeviceInbox& inbox() const { return inbox_; }
  const DriverTraits& traits() const { return setup_.driver->traits(); }
  double rate_hz() const { return rate_hz_; }
  // The scene is loaded: from now on the log says why the hardware does not answer, where that lasts longer than ROS
  // and windows take to start. Of hardware that was there it always does.
  void log_problems();
  // Why the hardware does not answer; empty: it does, or was not asked yet. `changed` counts its changes.
  std::string problem() const;
  std::uint32_t problem_changes() const { return problem_changes_.load(); }

 private:
  void run();
  void search();
  void set_problem(const std::string& problem);
  void log_problem(const std::string& problem);

  Setup setup_;
  const double rate_hz_;
  std::unique_ptr<state::FrameReader> reader_;
  base::Log& log_;
  DeviceInbox inbox_;
  std::atomic<bool> stop_{false};
  mutable std::mutex problem_mutex_;
  std::string problem_;
  std::atomic<std::uint32_t> problem_changes_{0};
  std::atomic<std::int64_t> log_from_ns_{INT64_MAX};  // steady clock
  std::string logged_problem_;                        // searching thread's
  std::thread thread_, searcher_;                     // last: they use the rest
};

}  // namespace ambf::devices
