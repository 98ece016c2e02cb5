// A driver in a shared library: a template for one's own, and a device for trying things without hardware. Its hand
// goes round a circle before the operator; the jaw opens and closes with it. What a driver must do, and on which
// thread: devices/driver.h. How it is built and found: docs/drivers.md.
#include <time.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "devices/driver_library.h"
#include "devices/drivers/options.h"

namespace {

using ambf::devices::Driver;
using ambf::devices::DriverKind;
using ambf::devices::DriverRequest;
using ambf::devices::DriverTraits;
using ambf::devices::Reading;
using ambf::devices::Sample;

class CircleDriver final : public Driver {
 public:
  // Only reads what the device file says: hardware is opened in open().
  explicit CircleDriver(const DriverRequest& request) : request_(request) {
    ambf::devices::Options options(request);
    radius_m_ = options.number("radius", 0.05, 0.0, 1.0);
    period_s_ = options.number("period", 4.0, 0.1, 1000.0);
    problem_ = options.problems();
    traits_.force = true;
    traits_.gripper = true;
    traits_.max_force_N = 5.0;
    traits_.max_stiffness_N_m = 1000.0;
    traits_.hold_at_start_s = 0.0;
  }

  const DriverTraits& traits() const override { return traits_; }

  // Here real hardware is searched. What people can do about it when it is absent belongs into the answer.
  std::string open() override {
    if (!problem_.empty()) return problem_;
    start_ns_ = now_ns();
    return {};
  }

  // On the device's thread: no lock, no allocation, no log.
  Reading read(Sample& sample, double /*max_wait_s*/) override {
    sample = {};
    sample.stamp_ns = now_ns();
    const double phase = 2.0 * M_PI * static_cast<double>(sample.stamp_ns - start_ns_) * 1e-9 / period_s_;
    // Of the tip in the device's base, as hardware reports it; the mounting is undone by one call.
    ambf::math::Pose T_base_tip;
    T_base_tip.position = {0.0, radius_m_ * std::cos(phase), radius_m_ * std::sin(phase)};
    sample.T_u_tip = ambf::devices::to_user_frame(request_, T_base_tip);
    sample.jaw = 0.5 + 0.5 * std::cos(phase);
    sample.has_jaw = true;
    return Reading::sample;
  }

  // On the device's thread, too.
  void write(const ambf::math::Wrench& wrench_u) override {
    wrench_base_ = ambf::devices::to_base_axes(request_, wrench_u);  // real hardware gets this
  }
  void close() override { wrench_base_ = {}; }

 private:
  static std::int64_t now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
  }

  const DriverRequest request_;
  DriverTraits traits_;
  std::string problem_;
  double radius_m_ = 0.0, period_s_ = 1.0;
  std::int64_t start_ns_ = 0;
  ambf::math::Wrench wrench_base_;
};

std::vector<DriverKind> kinds() {
  return {{"circle", {"Circle"}, [](const DriverRequest& request) { return std::make_unique<CircleDriver>(request); }}};
}

}  // namespace

AMBF_DRIVER_LIBRARY(kinds);
