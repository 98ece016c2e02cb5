// One device in a world of one body and two cameras that the test moves by hand: a driver's double, frames filled each
// millisecond, and an ideal physics that puts the body where the set-points want it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "devices/detail/device_cycle.h"
#include "tests/devices/random_motion.h"

namespace ambf::devices::testing {

class FakeDriver final : public Driver {
 public:
  FakeDriver() {
    traits_.force = traits_.torque = true;
    traits_.hold_at_start_s = 0.1;
    traits_.max_force_N = 20.0;
    traits_.max_torque_Nm = 1.0;
  }
  const DriverTraits& traits() const override { return traits_; }
  std::string open() override { return {}; }
  Reading read(Sample& sample, double) override {
    if (reading == Reading::sample) sample = next;
    return reading;
  }
  void write(const math::Wrench& wrench_u) override { written = wrench_u; }
  void close() override {}

  DriverTraits traits_;
  Sample next;
  Reading reading = Reading::sample;
  math::Wrench written;
};

class FakePort final : public state::EffectorPort {
 public:
  explicit FakePort(state::SetPoint& last) : last_(last) {}
  void post(const state::SetPoint& point) override { last_ = point; }
  void let_go() override { last_ = {}; }

 private:
  state::SetPoint& last_;
};

class FakeCameraPort final : public state::CommandPort {
 public:
  FakeCameraPort(std::vector<math::Pose>& posted, unsigned& releases) : posted_(posted), releases_(releases) {}
  void post(const state::Command& command) override { post(command, 0); }
  void post(const state::Command& command, std::int64_t) override {
    posted_.push_back(std::get<state::PoseCommand>(command).T_parent_object);
  }
  void keep_alive() override {}
  void hold() override {}
  void release() override { ++releases_; }

 private:
  std::vector<math::Pose>& posted_;
  unsigned& releases_;
};

class CycleRig {
 public:
  static constexpr double kStep_s = 1e-3;
  const state::ObjectId body_id{0, 1}, camera_ids[2] = {{1, 1}, {2, 1}};

  explicit CycleRig(unsigned seed = 1) : random(seed) {
    auto structure = std::make_shared<state::Structure>();
    structure->version = 1;
    for (std::uint32_t i = 0; i < 3; ++i) {
      state::ObjectInfo object;
      object.id = {i, 1};
      object.kind = i == 0 ? state::ObjectKind::rigid_body : state::ObjectKind::camera;
      object.slot = i == 0 ? 0 : i - 1;
      structure->objects.push_back(object);
    }
    structure->bodies.resize(1);
    structure->bodies[0].object = 0;
    structure->cameras.resize(2);
    for (std::uint32_t i = 0; i < 2; ++i) structure->cameras[i].object = i + 1;
    frame.structure = structure;
    frame.bodies.resize(1);
    frame.bodies[0].T_world_body = random.pose();
    frame.cameras.resize(2);
    for (state::CameraState& camera : frame.cameras) {
      camera.T_parent_camera = random.pose();
      camera.T_world_camera = random.pose() * camera.T_parent_camera;
    }
    driver.next.T_u_tip = random.pose(0.2);
    settings.controller.linear_stiffness = {500.0, 500.0, 500.0};
    settings.controller.angular_stiffness = {50.0, 50.0, 50.0};
    settings.linear_given = settings.angular_given = true;
    settings.haptic_angular = {};
    settings.workspace_scaling = 2.0;
    settings.ramp_s = 0.05;
    settings.buttons.clutch = 0;
    settings.buttons.camera_clutch = 1;
  }

  void start() {
    cycle.emplace(driver, inbox, settings, state::Source::device_0, kStep_s);
    bind();
    inbox.driver = DriverState::open;
    inbox.forces = true;
  }
  void bind() {
    auto binding = std::make_unique<EffectorBinding>();
    binding->body = body_id;
    binding->port = std::make_unique<FakePort>(posted);
    for (int i = 0; i < 2; ++i) {
      binding->cameras.push_back(
          {camera_ids[i], std::make_unique<FakeCameraPort>(camera_commands[i], camera_releases[i]), camera_locks[i]});
    }
    inbox.incoming = binding.release();
  }

  // One cycle, and what physics does meanwhile.
  void step() {
    now_ns += base::to_ns(kStep_s);
    if (stamps) driver.next.stamp_ns = now_ns;
    if (frames_come) {
      ++frame.sequence;
      if (steps) ++frame.sim_step;
      frame.steady_ns = now_ns;
    }
    if (norm(pushed.force) > 0.0) inbox.external.post({pushed, false, {}}, now_ns);
    cycle->step(now_ns, &frame);
    if (posted.period_s > 0.0 && frames_come) obey();
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kStep_s + 0.5); ++i) step();
  }
  // Until the device engages.
  void run_until_engaged() {
    for (int i = 0; i < 1000 && !status().engaged; ++i) step();
    ASSERT_TRUE(status().engaged);
  }
  void press(int button, bool down) {
    const std::uint64_t bit = std::uint64_t{1} << button;
    driver.next.buttons = down ? driver.next.buttons | bit : driver.next.buttons & ~bit;
  }
  const state::DeviceStatus& status() const { return cycle->status(); }
  const math::Pose& body() const { return frame.bodies[0].T_world_body; }
  double force() const { return norm(driver.written.force); }

  RandomMotion random;
  FakeDriver driver;
  DeviceSettings settings;
  DeviceInbox inbox;
  state::SetPoint posted;
  std::vector<math::Pose> camera_commands[2];
  unsigned camera_releases[2] = {};
  std::shared_ptr<CameraLock> camera_locks[2] = {std::make_shared<CameraLock>(), std::make_shared<CameraLock>()};
  state::Frame frame;
  std::optional<DeviceCycle> cycle;
  std::int64_t now_ns = 1000000000;
  bool stamps = true, frames_come = true;
  bool steps = true;     // frames show a new step each
  math::Wrench pushed;   // W; a client repeats it in each cycle
  bool blocked = false;  // a wall keeps the body where it is

 private:
  void obey() {
    if (frame.effectors.empty()) {
      frame.effectors.resize(1);
      frame.effectors[0].body = 0;
      frame.effectors[0].T_world_ref = posted.T_world_ref;
    }
    state::EffectorState& row = frame.effectors[0];
    row.pulls = posted.pulls;
    row.engaged = posted.engaged;
    if (row.sample != posted.sample) row.applied_ns = now_ns;
    row.sample = posted.sample;
    row.sampled_ns = posted.sampled_ns;
    if (posted.engaged) row.T_world_ref = posted.T_world_ref;
    if (posted.pulls && !blocked) frame.bodies[0].T_world_body = row.T_world_ref;
  }
};

}  // namespace ambf::devices::testing
