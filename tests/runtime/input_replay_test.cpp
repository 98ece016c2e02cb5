// A session in real time, with devices, commands and all that a user may do meanwhile, is recorded and replayed: each
// frame has the recorded state_hash, each set-point its bits. And whatever differs is found.
#include "runtime/input_replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "adf/adf.h"
#include "base/clock.h"
#include "base/hash.h"
#include "base/realtime.h"
#include "devices/hub.h"
#include "tests/runtime/simulation_rig.h"

namespace ambf::runtime::test {
namespace {

// A hand on a circle that clutches, moves its camera, and sometimes falls silent or is unplugged.
class RestlessHand final : public devices::Driver {
 public:
  RestlessHand() {
    traits_.force = traits_.torque = traits_.gripper = true;
    traits_.max_force_N = 5.0;
    traits_.hold_at_start_s = 0.05;
  }
  const devices::DriverTraits& traits() const override { return traits_; }
  std::string open() override {
    if (start_ns_ == 0) start_ns_ = base::steady_ns();
    return {};
  }
  devices::Reading read(devices::Sample& sample, double) override {
    const double t = base::to_seconds(base::steady_ns() - start_ns_);
    const double phase = std::fmod(t, 0.8);
    if (t > 0.9 && !lost_) {
      lost_ = true;
      return devices::Reading::lost;
    }
    if (phase > 0.7) return devices::Reading::nothing_new;
    sample.stamp_ns = base::steady_ns();
    sample.T_u_tip.position = {0.03 * std::sin(9.0 * t), 0.03 * std::cos(9.0 * t), 0.01 * std::sin(20.0 * t)};
    sample.has_jaw = true;
    sample.jaw = 0.5 + 0.4 * std::sin(5.0 * t);
    sample.buttons = (phase > 0.2 && phase < 0.3 ? 1u : 0u) | (phase > 0.4 && phase < 0.55 ? 2u : 0u);
    return devices::Reading::sample;
  }
  void write(const math::Wrench&) override {}
  void close() override {}

 private:
  devices::DriverTraits traits_;
  std::int64_t start_ns_ = 0;
  bool lost_ = false;
};

constexpr const char* kDevices = R"(
input devices: [Restless, Other]
Restless: {hardware name: Restless, root link: box, pair cameras: [cam], button mapping: {a1: 0, a2: 1},
  haptic gain: {linear: 50, angular: 0}}
Other: {hardware name: Scripted, root link: box, workspace scaling: 2, haptic gain: {linear: 20, angular: 0},
  driver: {type: scripted, motion: ellipse, size: 0.02, rate: 4, noise: 0.0005, delay: 0.004, hertz: 300, force: 3}}
)";

constexpr const char* kWorld = R"(
cameras: [cam]
cam: {name: cam, location: {x: 2, y: 0, z: 1}, look at: {x: 0, y: 0, z: 0.5}, up: {x: 0, y: 0, z: 1}}
)";

class InputReplays : public testing::Test {
 protected:
  InputReplays() {
    [[maybe_unused]] static const bool once = [] {
      devices::register_driver(
          {"restless", {"Restless"}, [](const devices::DriverRequest&) { return std::make_unique<RestlessHand>(); }});
      return true;
    }();
    world_ = *adf::parse_world(kWorld, "world.yaml").world;
    devices_ = *adf::parse_input_devices(kDevices, "devices.yaml").devices;
    log_.allow("device '");
  }
  ~InputReplays() override { std::filesystem::remove(path_); }

  state::Outcome wait(const std::function<void(state::Completion)>& start) {
    std::promise<state::Outcome> promise;
    start([&](const state::Outcome& outcome) { promise.set_value(outcome); });
    return promise.get_future().get();
  }
  void pass(double seconds) { base::sleep_until(base::steady_ns() + base::to_ns(seconds)); }

  void record(const SimulationOptions& options) {
    std::string problem;
    inputs::SessionRecord session;
    session.start_ns = 1;
    const auto recorder = inputs::Recorder::create(path_, session, log_, problem);
    ASSERT_NE(recorder, nullptr) << problem;
    Simulation simulation(options, world_, {}, log_, recorder.get());
    devices::HubOptions hub_options;
    hub_options.forces = true;
    hub_options.recorder = recorder.get();
    const state::Abilities abilities = simulation.abilities();
    devices::Hub hub(devices_.devices, "devices.yaml", hub_options,
                     {abilities.observe, abilities.edit, abilities.command, abilities.effector}, log_);
    state::LoadRequest scene;
    scene.text = kScene;
    scene.path = "scene.yaml";
    ASSERT_TRUE(simulation.load_and_wait(scene).success);
    simulation.begin();
    live(simulation, hub);
  }

  virtual void live(Simulation& simulation, devices::Hub& hub) {
    const auto id = [&](const std::string& name, state::ObjectKind kind = state::ObjectKind::rigid_body) {
      const auto structure = simulation.structure();
      return structure->objects.at(state::find(*structure, name, kind)).id;
    };
    const state::ObjectId link = id("BODY base"), box = id("BODY box");
    const auto base_port = simulation.bind(link, state::Source::ros);
    state::RigidBodyCommand crank;
    crank.joints = {{state::JointCommandType::position, 0.4}};
    base_port->post(crank);
    pass(0.35);
    simulation.set_paused(true);
    pass(0.05);
    simulation.step_paused(7);
    pass(0.05);
    simulation.set_paused(false);
    hub.set(0, state::DeviceParameter::dominance, {0.9, 0.0, 0.0});
    hub.push(0, {{1.0, 0.0, 0.0}, {}});
    crank.joints = {{state::JointCommandType::velocity, 0.3}};
    base_port->post(crank);
    base_port->hold();
    const auto camera = simulation.bind(id("cam", state::ObjectKind::camera), state::Source::ros);
    camera->post(state::PoseCommand{true, {{1.5, 0.2, 1.0}, {}}});
    pass(0.2);
    camera->release();
    simulation.set_parameter(box, state::Parameter::friction, {0.2, 0.0, 0.0}, {});
    state::Push push;
    push.force_world = {0.0, 3.0, 0.0};
    push.seconds = 0.05;
    simulation.push(box, push, {});
    simulation.set_gravity({0.0, 0.5, -9.0});
    EXPECT_TRUE(wait([&](auto done) { simulation.snapshot("here", "", done); }).success);
    pass(0.15);
    EXPECT_TRUE(wait([&](auto done) { simulation.restore("here", "", done); }).success);
    const auto pointer = simulation.make_pick_port();
    pointer->pick({0.0, -1.0, 1.1}, {0.0, 1.0, 1.1}, {});
    for (int i = 0; i < 10; ++i) {
      pointer->drag({0.02 * i, 0.0, 1.1});
      pass(0.01);
    }
    pointer->release();
    base_port->release();
    state::LoadRequest more;
    more.text = kScene;
    more.path = "more.yaml";
    more.name_prefix = "/more";
    const state::Outcome loaded = simulation.load_and_wait(more);
    EXPECT_TRUE(loaded.success);
    const auto ticket = simulation.step(20, std::vector<state::AddressedCommand>{{link, crank}}, false);
    EXPECT_TRUE(ticket->wait(kPatience));
    state::WorldCommand on;
    simulation.post_world(on);  // ends the throttle of the Step request
    pass(0.1);
    EXPECT_TRUE(wait([&](auto done) { simulation.unload(loaded.model, done); }).success);
    simulation.reset_bodies();
    pass(0.2);
    simulation.reset_world();
    pass(0.3);
  }

  using Change = std::function<void(scene::InputDevice&)>;

  std::vector<devices::ReplayedDevice::Setup> setups(const Change& change = {}) {
    std::vector<devices::ReplayedDevice::Setup> setups;
    for (const inputs::DeviceRecord& record : devices_of()) {
      scene::InputDevice block = devices_.devices.at(record.number);
      if (change) change(block);
      devices::ReplayedDevice::Setup& setup = setups.emplace_back();
      setup.number = record.number;
      setup.name = record.name;
      setup.settings = devices::settings_of(block);
      setup.period_s = record.period_s;
      setup.traits.orientation = record.orientation;
      setup.traits.force = record.force;
      setup.traits.torque = record.torque;
      setup.traits.gripper = record.gripper;
      setup.traits.rate_hz = record.rate_hz;
      setup.traits.max_force_N = record.max_force_N;
      setup.traits.max_torque_Nm = record.max_torque_Nm;
      setup.traits.hold_at_start_s = record.hold_at_start_s;
    }
    return setups;
  }

  ReplayOutcome replay(const SimulationOptions& options, const Change& change = {}) {
    std::string problem;
    const auto recording = inputs::Recording::open(path_, problem);
    if (recording == nullptr) return {problem};
    InputReplay replay(options, world_, {}, setups_.empty() ? setups(change) : setups_, *recording, log_);
    return replay.run([] { return false; });
  }

  std::vector<inputs::DeviceRecord> devices_of() {
    std::string problem;
    const auto recording = inputs::Recording::open(path_, problem);
    std::vector<inputs::DeviceRecord> out;
    inputs::RawRecord raw;
    inputs::Stream stream = 0;
    while (recording->next_of_any(raw, stream))
      if (const auto record = raw.as<inputs::DeviceRecord>()) out.push_back(*record);
    return out;
  }

  std::string bytes() const {
    std::stringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }

  static constexpr std::size_t kFirstRecord = sizeof inputs::kMagic + sizeof inputs::kVersion;
  std::vector<devices::ReplayedDevice::Setup> setups_;  // instead of those of the file, where there are any
  const std::string path_ = testing::TempDir() + "ambf_replay_" + std::to_string(getpid());
  JudgedLog log_;
  scene::World world_;
  scene::InputDevices devices_;
};

TEST_F(InputReplays, ASessionInRealTimeRepeatsToTheBit) {
  const SimulationOptions real_time;
  ASSERT_NO_FATAL_FAILURE(record(real_time));
  for (int i = 0; i < 2; ++i) {
    const ReplayOutcome outcome = replay(real_time);
    EXPECT_EQ(outcome.problem, "");
    EXPECT_GT(outcome.steps, 100u);
    EXPECT_GT(outcome.frames, 50u);
    EXPECT_GT(outcome.set_points, 100u);
  }
  // Another mapping, another gain: the first set-point that shows it is named.
  const ReplayOutcome scaled = replay(real_time, [](scene::InputDevice& device) { device.workspace_scaling *= 1.001; });
  EXPECT_NE(scaled.problem.find("differs from the recording, at step"), std::string::npos) << scaled.problem;
  // A scene with another gravity.
  world_.gravity.z += 1e-9;
  EXPECT_NE(replay(real_time).problem, "");
}

TEST_F(InputReplays, SoDoFixedStepsAsFastAsTheyGo) {
  ASSERT_NO_FATAL_FAILURE(record(free_running()));
  const ReplayOutcome outcome = replay(free_running());
  EXPECT_EQ(outcome.problem, "");
  EXPECT_GT(outcome.steps, 200u);
}

// Devices do not extrapolate while no time passes: what they feel depends on it.
class ThrottledInputReplays : public InputReplays {
 protected:
  void live(Simulation& simulation, devices::Hub&) override {
    pass(0.1);
    state::WorldCommand command;
    command.enable_step_throttling = throttles_;
    simulation.post_world(command);
    pass(0.1);
  }
  bool throttles_ = false;
};

TEST_F(ThrottledInputReplays, FramesShowWhetherTheWorldWasThrottled) {
  for (const bool throttles : {false, true}) {
    throttles_ = throttles;
    ASSERT_NO_FATAL_FAILURE(record({}));
    std::string problem;
    const auto recording = inputs::Recording::open(path_, problem);
    ASSERT_NE(recording, nullptr) << problem;
    InputReplay replay({}, world_, {}, setups(), *recording, log_);
    EXPECT_EQ(replay.run([] { return false; }).problem, "");
    EXPECT_EQ(replay.frame()->run.throttled, throttles);
  }
}

// A file with right checksums may still hold anything.
TEST_F(InputReplays, RecordsThatAreWrongWithRightChecksumsEndInAMessage) {
  ASSERT_NO_FATAL_FAILURE(record({}));
  setups_ = setups();
  log_.allow("");  // of scenes that are none, of bodies that diverge
  const std::string whole = bytes();
  std::mt19937 random(1);
  unsigned refused = 0;
  for (int i = 0; i < 60; ++i) {
    std::string damaged = whole;
    // Most of the bytes are those of cycles: places are chosen by record, early ones more often.
    for (std::size_t at = kFirstRecord, next = 0; at < damaged.size(); at = next) {
      inputs::RecordHead head;
      std::memcpy(&head, damaged.data() + at, sizeof head);
      next = at + sizeof head + head.size + 4;
      const bool often = head.type != inputs::Type::cycle && head.type != inputs::Type::take;
      if (head.size == 0 || random() % (often ? 100 : 2000) != 0) continue;
      const std::size_t place = at + sizeof head + random() % head.size;
      damaged[place] = static_cast<char>(random());
      base::Fnv1a hash;
      hash.add_bytes(damaged.data() + at, sizeof head + head.size);
      const auto checksum = static_cast<std::uint32_t>(hash.value());
      std::memcpy(damaged.data() + next - 4, &checksum, 4);
    }
    std::ofstream(path_, std::ios::binary) << damaged;
    refused += replay({}).problem.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 50u);
}

TEST_F(InputReplays, ARecordingThatWasCutOffIsReplayedUpToThere) {
  ASSERT_NO_FATAL_FAILURE(record({}));
  const auto size = std::filesystem::file_size(path_);
  const ReplayOutcome whole = replay({});
  for (const double share : {0.7, 0.4}) {
    std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    const ReplayOutcome outcome = replay({});
    EXPECT_EQ(outcome.problem, "");
    EXPECT_LT(outcome.steps, whole.steps);
    EXPECT_GT(outcome.steps, 0u);
  }
}

// Physics may have noted in the file that it obeyed a change before the change itself came into it.
TEST_F(InputReplays, SoIsOneThatLacksTheChangeThatPhysicsMadeLast) {
  ASSERT_NO_FATAL_FAILURE(record({}));
  const std::string whole = bytes();
  const ReplayOutcome all = replay({});
  constexpr std::size_t kAtStart = 3;  // changes before the simulation is set going
  std::string cut = whole.substr(0, kFirstRecord);
  for (std::size_t at = kFirstRecord, next = 0, changes = 0; at < whole.size(); at = next) {
    inputs::RecordHead head;
    std::memcpy(&head, whole.data() + at, sizeof head);
    next = at + sizeof head + head.size + 4;
    changes += head.type == inputs::Type::scene_change ? 1 : 0;
    const bool missing =
        head.type == inputs::Type::end || (head.type == inputs::Type::scene_change && changes > kAtStart);
    if (!missing) cut += whole.substr(at, next - at);
  }
  std::ofstream(path_, std::ios::binary) << cut;
  const ReplayOutcome outcome = replay({});
  EXPECT_EQ(outcome.problem, "");
  EXPECT_GT(outcome.steps, 0u);
  EXPECT_LT(outcome.steps, all.steps);
}

}  // namespace
}  // namespace ambf::runtime::test
