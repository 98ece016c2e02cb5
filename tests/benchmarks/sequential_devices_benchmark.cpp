// The dissertation's Fig. 3.19: cycles a second of devices with threads of their own, and of the same devices read one
// after the other in the loop that also steps physics. Each driver waits 0.2 ms for its hardware, as those behind USB
// do; physics stands still for 200 ms every two seconds. Ends with 1 when a device with a thread is below 995.
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/clock.h"
#include "base/realtime.h"
#include "devices/hub.h"
#include "tests/devices/session_rig.h"

namespace {

using namespace ambf;
using namespace ambf::devices;
using namespace std::chrono_literals;

constexpr std::int64_t kHardwareNs = 200'000, kStallNs = 200'000'000, kStallEveryNs = 2'000'000'000;
constexpr double kTarget_hz = 995.0;

class Usb final : public Driver {
 public:
  Usb() { traits_.hold_at_start_s = 0.0; }
  const DriverTraits& traits() const override { return traits_; }
  std::string open() override { return {}; }
  Reading read(Sample& sample, double) override {
    base::sleep_until(base::steady_ns() + kHardwareNs);
    sample.stamp_ns = base::steady_ns();
    return Reading::sample;
  }
  void write(const math::Wrench&) override {}
  void close() override {}

 private:
  DriverTraits traits_;
};

scene::InputDevice device_of(int number) {
  scene::InputDevice device;
  device.name = device.hardware_name = "device" + std::to_string(number);
  device.driver.type = "usb";
  device.root_link = "right_gripper";
  device.cameras = {"main_camera"};
  return device;
}

void stall(int) { base::sleep_until(base::steady_ns() + kStallNs); }

pid_t physics_thread() {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string name;
    std::getline(std::ifstream(task.path() / "comm"), name);
    if (name == "physics") return static_cast<pid_t>(std::stoi(task.path().filename()));
  }
  return 0;
}

const char* const kScene =
    "bodies: [BODY right_gripper]\ncameras: [main_camera]\nnamespace: /test/\n"
    "BODY right_gripper: {name: right_gripper, mass: 1, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1},\n"
    "  gravity: {x: 0, y: 0, z: 0}, location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}\n"
    "main_camera: {name: main_camera, location: {x: 1, y: 0, z: 1}, look at: {x: 0, y: 0, z: 1}, up: {x: 0, y: 0, z: "
    "1}}\n";

struct Rates {
  double slowest_hz = 0.0, p50_ms = 0.0, p99_ms = 0.0, max_ms = 0.0;
};

// Whole-run figures of the slowest device.
Rates rates_of(const std::vector<state::DeviceStatus>& devices, const std::vector<std::uint64_t>& before,
               double seconds) {
  Rates out{1e9, 0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < devices.size(); ++i) {
    out.slowest_hz = std::min(out.slowest_hz, static_cast<double>(devices[i].cycle - before[i]) / seconds);
    out.p50_ms = std::max(out.p50_ms, 1e3 * devices[i].period.p50_s);
    out.p99_ms = std::max(out.p99_ms, 1e3 * devices[i].period.p99_s);
    out.max_ms = std::max(out.max_ms, 1e3 * devices[i].period.max_s);
  }
  return out;
}

Rates with_threads(int count, double seconds) {
  base::Log log;
  runtime::Simulation simulation(runtime::SimulationOptions{}, runtime::test::empty_world(), {}, log);
  simulation.begin();
  state::LoadRequest request;
  request.text = kScene;
  request.path = "scene.yaml";
  if (!simulation.load_and_wait(request).success) std::exit(1);
  std::vector<scene::InputDevice> devices;
  for (int i = 0; i < count; ++i) devices.push_back(device_of(i));
  Hub hub(std::move(devices), "devices.yaml", HubOptions{},
          HubAbilities{simulation, simulation, simulation, simulation}, log);
  std::this_thread::sleep_for(1s);
  const auto statuses = [&] {
    std::vector<state::DeviceStatus> all(static_cast<std::size_t>(count));
    for (unsigned i = 0; i < all.size(); ++i) hub.status(i, all[i]);
    return all;
  };
  std::vector<std::uint64_t> before;
  for (const state::DeviceStatus& each : statuses()) before.push_back(each.cycle);
  std::signal(SIGUSR1, stall);
  const pid_t physics = physics_thread();
  const std::int64_t start_ns = base::steady_ns();
  while (base::to_seconds(base::steady_ns() - start_ns) < seconds) {
    syscall(SYS_tgkill, getpid(), physics, SIGUSR1);
    base::sleep_until(base::steady_ns() + kStallEveryNs);
  }
  return rates_of(statuses(), before, base::to_seconds(base::steady_ns() - start_ns));
}

Rates one_after_the_other(int count, double seconds) {
  devices::testing::Session session(devices::testing::shared_tool_scene());
  std::vector<std::unique_ptr<Usb>> drivers;
  std::vector<std::unique_ptr<DeviceInbox>> inboxes;
  std::vector<std::unique_ptr<DeviceCycle>> cycles;
  for (int i = 0; i < count; ++i) {
    drivers.push_back(std::make_unique<Usb>());
    inboxes.push_back(std::make_unique<DeviceInbox>());
    inboxes.back()->driver = DriverState::open;
    const auto source = static_cast<state::Source>(static_cast<int>(state::Source::device_0) + i);
    cycles.push_back(
        std::make_unique<DeviceCycle>(*drivers.back(), *inboxes.back(), settings_of(device_of(i)), source, 1e-3));
  }
  // As favourable as a thread of its own.
  base::enter_real_time("sequential", 30);
  const std::int64_t start_ns = base::steady_ns();
  std::int64_t deadline_ns = start_ns, stall_ns = start_ns + kStallEveryNs;
  while (base::to_seconds(base::steady_ns() - start_ns) < seconds) {
    deadline_ns = std::max(deadline_ns + 1'000'000, base::steady_ns());
    base::sleep_until(deadline_ns);
    for (const auto& cycle : cycles) cycle->step(base::steady_ns(), &session.frame);
    session.simulation.step();
    if (base::steady_ns() < stall_ns) continue;
    stall(0);
    stall_ns += kStallEveryNs;
  }
  std::vector<state::DeviceStatus> all;
  for (const auto& cycle : cycles) all.push_back(cycle->status());
  base::leave_fifo();
  return rates_of(all, std::vector<std::uint64_t>(all.size(), 0), base::to_seconds(base::steady_ns() - start_ns));
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10.0;
  register_driver({"usb", {}, [](const DriverRequest&) { return std::make_unique<Usb>(); }});
  bool good = true;
  std::printf("| devices | variant | slowest, cycles/s | period, ms p50 / p99 / max |\n|---|---|---|---|\n");
  for (const int count : {1, 2, 5, 8}) {
    const auto row = [&](const char* variant, const Rates& rates) {
      std::printf("| %d | %s | %.1f | %.2f / %.2f / %.1f |\n", count, variant, rates.slowest_hz, rates.p50_ms,
                  rates.p99_ms, rates.max_ms);
      std::fflush(stdout);
    };
    const Rates threads = with_threads(count, seconds);
    row("a thread each", threads);
    row("one after the other", one_after_the_other(count, seconds));
    good = good && threads.slowest_hz >= kTarget_hz;
  }
  return good ? 0 : 1;
}
