// The hub: binding as the world changes, settings of pairs, devices that cannot work, an end that leaves nothing held.
#include "devices/hub.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <set>
#include <thread>

#include "base/clock.h"

namespace ambf::devices {
namespace {

// A world of bodies called a, b ..., with abilities that only what the hub needs.
class FakeWorld final : public state::ObserveAbility,
                        public state::EditAbility,
                        public state::CommandAbility,
                        public state::EffectorAbility {
 public:
  FakeWorld() { set_bodies({}); }

  void set_bodies(const std::vector<std::string>& names) {
    auto structure = std::make_shared<state::Structure>();
    structure->version = ++version_;
    structure->models = {{1, "loaded", "g.yaml"}};
    for (const std::string& name : names) {
      state::ObjectInfo object;
      object.id = {static_cast<std::uint32_t>(structure->objects.size()), 1};
      object.model = 1;
      object.local_name = object.name = object.identifier = name;
      object.slot = object.id.index;
      state::BodyInfo body;
      body.object = object.id.index;
      body.mass = 1.0;
      structure->objects.push_back(object);
      structure->bodies.push_back(body);
    }
    const std::lock_guard lock(mutex_);
    structure_ = structure;
  }
  std::set<std::uint32_t> held() {
    const std::lock_guard lock(mutex_);
    return held_;
  }

  std::unique_ptr<state::FrameReader> make_reader() override;
  std::unique_ptr<state::StepReader> read_steps() override { return nullptr; }
  std::shared_ptr<const state::Structure> structure() override {
    const std::lock_guard lock(mutex_);
    return structure_;
  }
  void report_graphics(double, double) override {}
  void report_comm(double) override {}
  void load(state::LoadRequest request, state::Completion done) override {
    state::Outcome outcome;
    outcome.success = request.path == "g.yaml";
    outcome.model = "loaded";
    outcome.message = "'" + request.path + "' is absent";
    done(outcome);
  }
  void unload(const std::string&, state::Completion) override {}
  void remove(const std::string&, state::Completion) override {}
  void save(state::SaveModelRequest, state::Completion) override {}
  void set_parent(state::ObjectId, const std::string&, state::Completion) override {}
  std::unique_ptr<state::CommandPort> bind(state::ObjectId, state::Source) override { return nullptr; }
  void count_refused_command(state::ObjectId) override {}
  void push(state::ObjectId, const state::Push&, state::Completion) override {}
  std::unique_ptr<state::EffectorPort> hold(state::ObjectId body, state::Source source) override;

 private:
  struct Reader;
  struct Port;

  std::mutex mutex_;
  std::uint64_t version_ = 0;
  std::shared_ptr<const state::Structure> structure_;
  std::set<std::uint32_t> held_;  // 100 x body + source
};

struct FakeWorld::Reader final : state::FrameReader {
  explicit Reader(FakeWorld& all) : world(all) {}
  const state::Frame* latest() override {
    frame.structure = world.structure();
    frame.bodies.resize(frame.structure->bodies.size());
    ++frame.sequence;
    frame.steady_ns = base::steady_ns();
    return &frame;
  }
  const state::Frame* previous() override { return nullptr; }
  bool wait_newer(std::uint64_t, std::chrono::nanoseconds) override { return true; }
  FakeWorld& world;
  state::Frame frame;
};

struct FakeWorld::Port final : state::EffectorPort {
  Port(FakeWorld& all, std::uint32_t key) : world(all), number(key) {
    const std::lock_guard lock(world.mutex_);
    world.held_.insert(number);
  }
  ~Port() override {
    const std::lock_guard lock(world.mutex_);
    world.held_.erase(number);
  }
  void post(const state::SetPoint&) override {}
  void let_go() override {}
  FakeWorld& world;
  const std::uint32_t number;
};

std::unique_ptr<state::FrameReader> FakeWorld::make_reader() { return std::make_unique<Reader>(*this); }
std::unique_ptr<state::EffectorPort> FakeWorld::hold(state::ObjectId body, state::Source source) {
  return std::make_unique<Port>(*this, 100 * body.index + static_cast<std::uint32_t>(source));
}

constexpr auto kFirst = static_cast<std::uint32_t>(state::Source::device_0);

scene::InputDevice device(const std::string& name, const std::string& root_link, const std::string& multibody = {}) {
  scene::InputDevice out;
  out.name = name;
  out.hardware_name = "Scripted";
  out.root_link = root_link;
  out.multibody_file = multibody;
  return out;
}

bool soon(const std::function<bool()>& condition) {
  const std::int64_t end_ns = base::steady_ns() + 10 * base::kNanosecondsPerSecond;
  while (base::steady_ns() < end_ns) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

class HubTest : public ::testing::Test {
 protected:
  void start(std::vector<scene::InputDevice> devices) {
    HubOptions options;
    options.real_time = false;
    options.rate_hz = 200.0;
    hub_.emplace(std::move(devices), "file.yaml", options, HubAbilities{world_, world_, world_, world_}, log_);
  }
  state::DeviceStatus status(unsigned i) {
    state::DeviceStatus out;
    hub_->status(i, out);
    return out;
  }

  base::Log log_;
  FakeWorld world_;
  std::optional<Hub> hub_;
};

TEST_F(HubTest, ABodyLoadedLaterIsBoundThenAndLetGoWhenItIsRemoved) {
  start({device("A", "a"), device("B", "a")});
  ASSERT_TRUE(soon([&] { return status(0).fault == state::DeviceFault::no_effector; }));
  EXPECT_TRUE(world_.held().empty());
  world_.set_bodies({"a"});
  ASSERT_TRUE(soon([&] { return status(0).engaged && status(1).engaged; }));
  EXPECT_EQ(world_.held(), (std::set<std::uint32_t>{kFirst, kFirst + 1}));
  EXPECT_EQ(hub_->info(0)->effector_name, "a");
  world_.set_bodies({});
  ASSERT_TRUE(soon([&] { return world_.held().empty(); }));
  EXPECT_FALSE(status(0).engaged);
  EXPECT_FALSE(hub_->info(0)->effector.valid());
}

TEST_F(HubTest, TheOrderOfDevicesDoesNotMatter) {
  world_.set_bodies({"a"});
  start({device("Root", "a"), device("Gripper", "", "g.yaml")});
  ASSERT_TRUE(soon([&] { return status(0).engaged && status(1).engaged; }));
  EXPECT_EQ(hub_->info(0)->effector, hub_->info(1)->effector);
}

TEST_F(HubTest, OneThatCannotWorkSaysWhyAndTheRestRuns) {
  world_.set_bodies({"a"});
  scene::InputDevice unknown = device("Unknown", "a"), missing = device("Missing", "", "absent.yaml");
  unknown.hardware_name = "sigma.9";
  start({unknown, missing, device("Good", "a")});
  ASSERT_TRUE(soon([&] { return status(2).engaged; }));
  EXPECT_EQ(hub_->count(), 3u);
  EXPECT_NE(hub_->info(0)->message.find("no driver answers to the hardware name 'sigma.9'"), std::string::npos);
  EXPECT_TRUE(soon([&] { return hub_->info(1)->message.find("is absent") != std::string::npos; }));
  state::DeviceStatus none;
  EXPECT_FALSE(hub_->status(0, none));
  EXPECT_FALSE(hub_->status(9, none));
}

TEST_F(HubTest, DominanceOfAPairIsShared) {
  world_.set_bodies({"a"});
  start({device("A", "a"), device("B", "a")});
  ASSERT_TRUE(soon([&] { return status(0).engaged && status(1).engaged; }));
  EXPECT_EQ(hub_->set(0, state::DeviceParameter::dominance, {0.8, 0.0, 0.0}), "");
  EXPECT_TRUE(soon([&] { return status(0).dominance == 0.8 && std::abs(status(1).dominance - 0.2) < 1e-12; }));
  EXPECT_NE(hub_->set(0, state::DeviceParameter::dominance, {1.5, 0.0, 0.0}), "");
  EXPECT_NE(hub_->set(7, state::DeviceParameter::dominance, {0.5, 0.0, 0.0}), "");
}

// Fig. 3.22 of the dissertation, between two trials without a restart.
TEST_F(HubTest, ASchemeSharesTheToolBetweenTwoDevices) {
  using state::SharingScheme;
  world_.set_bodies({"a"});
  std::vector<scene::InputDevice> pair = {device("A", "a"), device("B", "a"), device("Alone", "b")};
  for (scene::InputDevice& each : pair) {
    each.driver.options["force"] = "5";
    each.controller_linear = {math::Vec3{100, 100, 100}, math::Vec3{7, 7, 7}};
    each.haptic_linear = {math::Vec3{200, 200, 200}, {}};
    each.haptic_angular = {math::Vec3{0.5, 0.5, 0.5}, {}};
  }
  pair[1].controller_linear = {math::Vec3{}, math::Vec3{}};  // its file has it turn only
  start(pair);
  ASSERT_TRUE(soon([&] { return status(0).engaged && status(1).engaged; }));
  const math::Vec3 none, turns = status(0).gains.angular_stiffness;
  const math::Vec3 own = own_gains(*world_.structure(), 0).linear_stiffness;
  struct Row {
    SharingScheme scheme;
    math::Vec3 moves[2], turns[2], feels[2], torques[2];
  };
  const math::Vec3 first{100, 100, 100}, hand{200, 200, 200}, torque{0.5, 0.5, 0.5};
  for (const Row& row :
       {Row{SharingScheme::siso, {first, own}, {turns, turns}, {hand, hand}, {torque, torque}},
        Row{SharingScheme::siao, {first, own}, {turns, turns}, {{200, 200, 0}, {0, 0, 200}}, {none, torque}},
        Row{SharingScheme::aiso, {first, none}, {none, turns}, {hand, hand}, {torque, torque}},
        Row{SharingScheme::aiao, {first, none}, {none, turns}, {hand, none}, {none, torque}},
        Row{SharingScheme::sino, {first, own}, {turns, turns}, {none, none}, {none, none}},
        Row{SharingScheme::aino, {first, none}, {none, turns}, {none, none}, {none, none}},
        Row{SharingScheme::as_in_files, {first, none}, {turns, turns}, {hand, hand}, {torque, torque}}}) {
    // Set at the second device: their order is that of the file all the same.
    ASSERT_EQ(hub_->set(1, state::DeviceParameter::scheme, {static_cast<double>(row.scheme), 0.0, 0.0}), "");
    ASSERT_TRUE(soon([&] { return status(0).scheme == row.scheme && status(1).scheme == row.scheme; }));
    for (unsigned i = 0; i < 2; ++i) {
      const state::DeviceStatus now = status(i);
      EXPECT_EQ(now.gains.linear_stiffness, row.moves[i]) << name_of(row.scheme) << i;
      EXPECT_EQ(now.gains.angular_stiffness, row.turns[i]) << name_of(row.scheme) << i;
      EXPECT_EQ(now.hand_gains.linear_stiffness, row.feels[i]) << name_of(row.scheme) << i;
      EXPECT_EQ(now.hand_gains.angular_stiffness, row.torques[i]) << name_of(row.scheme) << i;
    }
  }
  EXPECT_NE(hub_->set(2, state::DeviceParameter::scheme, {1.0, 0.0, 0.0}), "") << "it shares no tool";
}

TEST_F(HubTest, ItsEndLetsGoOfEverything) {
  world_.set_bodies({"a"});
  start({device("A", "a")});
  ASSERT_TRUE(soon([&] { return !world_.held().empty(); }));
  hub_.reset();
  EXPECT_TRUE(world_.held().empty());
}

}  // namespace
}  // namespace ambf::devices
