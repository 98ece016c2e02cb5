#include "devices/detail/device.h"

#include <chrono>
#include <utility>

#include "base/clock.h"
#include "base/realtime.h"

namespace ambf::devices {

namespace {

constexpr std::chrono::milliseconds kSearchPeriod{500};
constexpr double kStart_s = 5.0;  // windows and a ROS master are there by then

}  // namespace

Device::Device(Setup setup, std::unique_ptr<state::FrameReader> reader, base::Log& log)
    : setup_(std::move(setup)),
      rate_hz_(traits().rate_hz > 0.0 ? traits().rate_hz : setup_.rate_hz),
      reader_(std::move(reader)),
      log_(log) {
  inbox_.forces = setup_.forces;
  searcher_ = std::thread([this] { search(); });
  thread_ = std::thread([this] { run(); });
}

Device::~Device() {
  stop_ = true;
  inbox_.driver_lost.notify_all();
  thread_.join();
  searcher_.join();
  setup_.driver->close();
}

std::string Device::problem() const {
  const std::lock_guard lock(problem_mutex_);
  return problem_;
}

void Device::set_problem(const std::string& problem) {
  {
    const std::lock_guard lock(problem_mutex_);
    if (problem_ == problem) return;
    problem_ = problem;
  }
  ++problem_changes_;
}

void Device::log_problems() { log_from_ns_ = base::steady_ns() + base::to_ns(kStart_s); }

void Device::log_problem(const std::string& problem) {
  if (problem == logged_problem_) return;
  logged_problem_ = problem;
  if (!problem.empty()) log_.warning("device '%s': %s", setup_.name.c_str(), problem.c_str());
}

void Device::run() {
  // Made here: what the loop needs is allocated before it begins.
  const double period_s = 1.0 / rate_hz_;
  DeviceCycle cycle(*setup_.driver, inbox_, setup_.settings, setup_.source, period_s, setup_.record);
  const base::RealTimeGrant grant =
      base::enter_real_time(setup_.thread_name.c_str(), setup_.real_time ? kRealTimePriority : 0);
  cycle.set_fifo(grant.fifo);
  const std::int64_t period_ns = base::to_ns(period_s);
  std::int64_t deadline_ns = base::steady_ns();
  while (!stop_.load(std::memory_order_relaxed)) {
    deadline_ns += period_ns;
    if (base::sleep_until(deadline_ns) > period_ns) {
      cycle.count_slip();
      deadline_ns = base::steady_ns();
    }
    cycle.step(base::steady_ns(), reader_->latest());
  }
  cycle.end();
}

void Device::search() {
  base::set_thread_name("device search");
  bool opened = false, opened_before = false;
  while (!stop_) {
    const std::uint32_t seen = inbox_.driver_lost.count();
    if (inbox_.driver.load(std::memory_order_acquire) != DriverState::open) {
      if (opened) {
        setup_.driver->close();
        const std::string gone = "the hardware is gone; it is searched";
        set_problem(gone);
        log_problem(gone);
      }
      const std::string problem = setup_.driver->open();
      opened = problem.empty();
      if (opened) {
        if (!traits().on_demand) log_.info("device '%s' is connected", setup_.name.c_str());
        inbox_.driver.store(DriverState::open, std::memory_order_release);
      }
      opened_before |= opened;
      set_problem(problem);
      if (opened_before || base::steady_ns() >= log_from_ns_) log_problem(problem);
    }
    inbox_.driver_lost.wait_beyond(seen, kSearchPeriod);
  }
}

}  // namespace ambf::devices
