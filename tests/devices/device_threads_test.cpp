// Devices' threads beside a simulation in real time, through real drivers: each keeps its rate while physics stands
// still, waits for a clock, models are loaded or another device's driver blocks; and their loops use neither the
// allocator nor locks. Rates are compared within a run.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <thread>

#include "base/clock.h"
#include "base/event_count.h"
#include "devices/hub.h"
#include "tests/devices/input_records.h"
#include "tests/devices/interposer.h"
#include "tests/runtime/simulation_rig.h"
#include "tests/support/judged_log.h"

namespace ambf::devices::testing {
namespace {

using namespace std::chrono_literals;

constexpr double kRate_hz = 1000.0;
constexpr auto kWindow = 300ms;

// Hardware that answers at once, or 50 ms late.
class Sluggish final : public Driver {
 public:
  static inline std::atomic<bool> blocks{false};

  Sluggish() { traits_.hold_at_start_s = 0.0; }
  const DriverTraits& traits() const override { return traits_; }
  std::string open() override { return {}; }
  Reading read(Sample& sample, double) override {
    if (blocks) std::this_thread::sleep_for(50ms);
    sample.stamp_ns = base::steady_ns();
    return Reading::sample;
  }
  void write(const math::Wrench&) override {}
  void close() override {}

 private:
  DriverTraits traits_;
};

// Where spacenavd would listen.
class Socket {
 public:
  explicit Socket(const std::string& path) : listener_(socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
  }
  ~Socket() { close(listener_); }

 private:
  int listener_;
};

// The physics thread, stopped wherever it is.
std::atomic<int> stalls{0};
void stall(int) {
  const std::int64_t end_ns = base::steady_ns() + 200'000'000;
  while (base::steady_ns() < end_ns) {
  }
  ++stalls;
}

pid_t thread_called(const std::string& name) {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string found;
    std::getline(std::ifstream(task.path() / "comm"), found);
    if (found == name) return static_cast<pid_t>(std::stoi(task.path().filename()));
  }
  return 0;
}

class DeviceThreads : public ::testing::Test {
 protected:
  DeviceThreads() {
    static const bool registered = [] {
      register_driver({"sluggish", {}, [](const DriverRequest&) { return std::make_unique<Sluggish>(); }});
      return true;
    }();
    EXPECT_TRUE(registered);
    simulation_.begin();
    state::LoadRequest request;
    request.text = runtime::test::kScene;
    request.path = "scene.yaml";
    EXPECT_TRUE(simulation_.load_and_wait(request).success);

    std::vector<scene::InputDevice> devices{
        device("Moving", "scripted", {{"motion", "ellipse"}, {"size", "0.01"}, {"force", "5"}}),
        device("Trembling", "scripted", {{"noise", "0.0001"}, {"delay", "0.002"}, {"jaw swing", "0.3"}}),
        device("Pad", "gamepad", {{"path", fifo_.path()}}), device("Puck", "spacenav", {{"path", socket_path_}}),
        device("Sluggish", "sluggish", {})};
    judged_ = static_cast<unsigned>(devices.size()) - 1;
    HubOptions options;
    options.rate_hz = kRate_hz;
    options.forces = true;
    hub_.emplace(std::move(devices), "file.yaml", options,
                 HubAbilities{simulation_, simulation_, simulation_, simulation_}, log_);
    const auto connected = [&] {
      for (unsigned i = 0; i <= judged_; ++i)
        if (!status(i).connected || status(i).cycle < 100) return false;
      return true;
    };
    for (int i = 0; i < 1000 && !connected(); ++i) std::this_thread::sleep_for(10ms);
    EXPECT_TRUE(connected());
    fifo_.plug();
  }

  static scene::InputDevice device(const std::string& name, const std::string& type,
                                   std::map<std::string, std::string> options) {
    scene::InputDevice out;
    out.name = out.hardware_name = name;
    out.driver.type = type;
    out.driver.options = std::move(options);
    out.root_link = "BODY box";
    out.ramp_s = 0.1;
    return out;
  }
  state::DeviceStatus status(unsigned i) const {
    state::DeviceStatus out;
    hub_->status(i, out);
    return out;
  }
  // Cycles a second of the slowest of the devices but the sluggish one.
  double slowest_while(const std::function<void()>& meanwhile) const {
    std::vector<std::uint64_t> before;
    for (unsigned i = 0; i < judged_; ++i) before.push_back(status(i).cycle);
    const std::int64_t start_ns = base::steady_ns();
    meanwhile();
    const std::int64_t rest_ns = start_ns + std::chrono::nanoseconds(kWindow).count() - base::steady_ns();
    std::this_thread::sleep_for(std::chrono::nanoseconds(rest_ns));
    std::uint64_t fewest = ~std::uint64_t{0};
    for (unsigned i = 0; i < judged_; ++i) fewest = std::min(fewest, status(i).cycle - before[i]);
    return static_cast<double>(fewest) / base::to_seconds(base::steady_ns() - start_ns);
  }
  // What else the machine does comes and goes; what is tested would show in each of the windows.
  void expect_rate_kept_while(const char* what, const std::function<void()>& meanwhile) {
    double best = 0.0;
    for (int window = 0; window < 6 && best < 0.99 * quiet_; ++window) {
      if (window > 0) quiet_ = std::min(quiet_, slowest_while([] {}));
      best = std::max(best, slowest_while(meanwhile));
    }
    std::printf("%s: %.1f cycles a second, %.1f when it is quiet\n", what, best, quiet_);
    EXPECT_GE(best, 0.99 * quiet_) << what;
  }

  TemporaryFolder folder_;
  Fifo fifo_{folder_.file("js0")};
  const std::string socket_path_ = folder_.file("spnav.sock");
  Socket socket_{socket_path_};
  JudgedLog log_;
  runtime::Simulation simulation_{runtime::SimulationOptions{}, runtime::test::empty_world(), {}, log_};
  std::optional<Hub> hub_;  // ends before the simulation
  unsigned judged_ = 0;
  double quiet_ = 0.0;
};

TEST_F(DeviceThreads, KeepTheirRatesWhateverHoldsUpTheOthers) {
  log_.allow("no sample arrives");  // of the sluggish device
  quiet_ = std::max(slowest_while([] {}), slowest_while([] {}));
  EXPECT_GT(quiet_, 0.5 * kRate_hz);

  const pid_t physics = thread_called("physics");
  ASSERT_NE(physics, 0);
  std::signal(SIGUSR1, stall);
  expect_rate_kept_while("physics stands still for 200 ms",
                         [&] { EXPECT_EQ(syscall(SYS_tgkill, getpid(), physics, SIGUSR1), 0); });
  EXPECT_GT(stalls, 0);

  bool high = false;
  expect_rate_kept_while("ten iterations a second by a clock", [&] {
    for (int i = 0; i < 3; ++i) {
      simulation_.post_world({true, high = !high, 1});
      std::this_thread::sleep_for(95ms);
    }
  });
  simulation_.post_world({false, false, 1});

  expect_rate_kept_while("models come and go", [&] {
    state::LoadRequest request;
    request.path = AMBF_SOURCE_DIR "/ambf_models/descriptions/multi-bodies/robots/arm7.yaml";
    const state::Outcome loaded = simulation_.load_and_wait(request);
    EXPECT_TRUE(loaded.success) << loaded.message;
    std::promise<state::Outcome> gone;
    simulation_.unload(loaded.model, [&](const state::Outcome& outcome) { gone.set_value(outcome); });
    EXPECT_TRUE(gone.get_future().get().success);
  });

  Sluggish::blocks = true;
  const std::uint64_t cycles = status(judged_).cycle;
  const std::int64_t since_ns = base::steady_ns();
  expect_rate_kept_while("one driver blocks for 50 ms a read", [] {});
  const double seconds = base::to_seconds(base::steady_ns() - since_ns);
  EXPECT_LT(static_cast<double>(status(judged_).cycle - cycles), 22.0 * seconds + 2.0) << "it harms itself";
  Sluggish::blocks = false;
}

TEST_F(DeviceThreads, UseNeitherTheAllocatorNorLocks) {
  const Calls before = calls_in_device_loops();
  EXPECT_GE(before.loops, static_cast<long>(judged_) + 1);
  for (int i = 0; i < 50; ++i) {
    fifo_.send_joydev(JS_EVENT_AXIS, 4, i % 2 == 0 ? -32767 : 0);
    for (unsigned device = 0; device < judged_; ++device)
      hub_->set(device, state::DeviceParameter::workspace_scaling, {1.0 + 0.01 * i, 0.0, 0.0});
    std::this_thread::sleep_for(10ms);
  }
  const Calls after = calls_in_device_loops();
  base::EventCount never;
  never.wait_beyond(never.count(), 1ms);
  EXPECT_GT(calls_of_this_thread().waits, 0);
  EXPECT_GT(calls_of_this_thread().memory, 0) << "the counters work";
  EXPECT_GT(calls_of_this_thread().locks, 0);
  EXPECT_EQ(after.memory - before.memory, 0);
  EXPECT_EQ(after.locks - before.locks, 0);
  EXPECT_EQ(after.waits - before.waits, 0);
  EXPECT_TRUE(status(0).engaged);
  EXPECT_TRUE(status(2).engaged) << state::name_of(status(2).fault);
}

}  // namespace
}  // namespace ambf::devices::testing
