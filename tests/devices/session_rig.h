// Users at devices in lockstep with the real physics: each millisecond one cycle of every device, then a step. A
// simulation without threads, doubles of drivers, and a clock of the test's own, so that a session repeats bit for bit.
// One thread.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "devices/binding.h"
#include "devices/detail/device_cycle.h"
#include "devices/hub.h"
#include "math/rotation.h"
#include "runtime/local_simulation.h"
#include "tests/devices/cycle_rig.h"
#include "tests/model/rig.h"
#include "tests/runtime/simulation_rig.h"
#include "tests/support/judged_log.h"

namespace ambf::devices::testing {

// A user, the device in the user's hand, and what it is bound to.
struct User {
  FakeDriver driver;
  DeviceInbox inbox;
  scene::InputDevice file;
  std::optional<DeviceCycle> cycle;
  state::ObjectId body, camera;
  double period_s = 0.0;                           // of the device's cycles
  std::int64_t due_ns = 0;                         // when the next one begins, at the earliest
  std::unique_ptr<state::CommandPort> ros_camera;  // by which somebody else moves the camera

  const state::DeviceStatus& status() const { return cycle->status(); }
  math::Pose& hand() { return driver.next.T_u_tip; }
  // What the hand feels, in the axes of the world.
  math::Wrench felt_world() const {
    const math::Quat& R_world_u = status().frames.T_world_cam.orientation;
    return {rotate(R_world_u, driver.written.force), rotate(R_world_u, driver.written.torque)};
  }
  void press(int button, bool down) {
    const std::uint64_t bit = std::uint64_t{1} << button;
    driver.next.buttons = down ? driver.next.buttons | bit : driver.next.buttons & ~bit;
  }
};

class Session {
 public:
  static constexpr double kStep_s = 1e-3;

  explicit Session(const scene::Model& model, const scene::World& world = runtime::test::empty_world())
      : simulation(runtime::test::free_running(), world, {}, log) {
    const state::Outcome loaded = simulation.load(model);
    EXPECT_TRUE(loaded.success) << loaded.message;
    show_frame();
  }

  // Binds a device to what its block of the device file names; its forces are on. It has this rate of its own, and the
  // model that was loaded for it, if any.
  User& join(const scene::InputDevice& file, double rate_hz = 1.0 / kStep_s, const std::string& multibody = {}) {
    const auto source = static_cast<state::Source>(static_cast<int>(state::Source::device_0) + users.size());
    User& user = *users.emplace_back(std::make_unique<User>());
    user.file = file;
    const Places places = find_places(*simulation.structure(), file, multibody);
    EXPECT_EQ(places.problem, "");
    auto binding = std::make_unique<EffectorBinding>();
    binding->body = user.body = places.body;
    binding->port = simulation.hold(places.body, source);
    binding->own_gains = places.own_gains;
    binding->jaw_joints = places.jaw_joints;
    for (const state::ObjectId camera : places.cameras)
      binding->cameras.push_back({camera, simulation.bind(camera, source), std::make_shared<CameraLock>()});
    EXPECT_FALSE(places.cameras.empty());
    if (!places.cameras.empty()) user.camera = places.cameras.front();
    user.ros_camera = simulation.bind(user.camera, state::Source::ros);
    user.inbox.incoming = binding.release();
    user.inbox.driver = DriverState::open;
    user.inbox.forces = true;
    user.period_s = 1.0 / rate_hz;
    user.cycle.emplace(user.driver, user.inbox, settings_of(file), source, user.period_s);
    return user;
  }

  // One iteration of physics, of so many steps: the cycles of all devices while it lasts, which see the frame before,
  // then its steps.
  void iterate(unsigned steps = 1) {
    for (unsigned i = 0; i < steps; ++i) {
      now_ns += base::to_ns(kStep_s);
      if (before_cycle) before_cycle();
      for (const auto& user : users) {
        if (now_ns < user->due_ns) continue;
        user->due_ns = std::max(user->due_ns, now_ns - base::to_ns(kStep_s)) + base::to_ns(user->period_s);
        user->driver.next.stamp_ns = now_ns;
        user->cycle->step(now_ns, &frame);
      }
    }
    EXPECT_TRUE(simulation.step(steps));
    show_frame();
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kStep_s + 0.5); ++i) iterate();
  }
  void run_until_all_engaged() {
    const auto engaged = [](const auto& user) { return user->status().engaged; };
    for (int i = 0; i < 1000 && !std::all_of(users.begin(), users.end(), engaged); ++i) iterate();
    ASSERT_TRUE(std::all_of(users.begin(), users.end(), engaged));
  }

  // Displaces the hand so that the reference moves by this in the world, as seen by the user's camera now.
  void displace(User& user, const math::Vec3& by_world, const math::Vec3& turn_world = {}) {
    const math::Quat R_u_world = inverse(camera(user).orientation);
    user.hand().position += rotate(R_u_world, by_world) / user.status().workspace_scaling;
    user.hand().orientation = math::normalized(math::exp(rotate(R_u_world, turn_world)) * user.hand().orientation);
  }

  const math::Pose& camera(const User& user) const { return frame.cameras[slot(user.camera)].T_world_camera; }
  const math::Pose& tool(const User& user) const { return frame.bodies[slot(user.body)].T_world_body; }
  double tool_speed(const User& user) const { return norm(frame.bodies[slot(user.body)].twist_world.linear); }
  // Null: nothing holds the body for this user.
  const state::EffectorState* effector(const User& user) const {
    for (const state::EffectorState& row : frame.effectors)
      if (row.body == slot(user.body) && row.source == source(user)) return &row;
    return nullptr;
  }
  state::Source source(const User& user) const {
    const auto at = std::find_if(users.begin(), users.end(), [&](const auto& each) { return each.get() == &user; });
    return static_cast<state::Source>(static_cast<int>(state::Source::device_0) + (at - users.begin()));
  }

  // Of a driver that is searched: the hardware answers again.
  static void plug_in(User& user) {
    user.driver.reading = Reading::sample;
    user.inbox.driver = DriverState::open;
  }

  JudgedLog log;
  runtime::LocalSimulation simulation;
  std::vector<std::unique_ptr<User>> users;  // their ports end before the simulation
  std::function<void()> before_cycle;        // each millisecond, before the devices' cycles
  state::Frame frame;                        // the newest one, by the session's clock
  std::int64_t now_ns = base::steady_ns();

 private:
  std::uint32_t slot(state::ObjectId id) const {
    return frame.structure->objects.at(state::find(*frame.structure, id)).slot;
  }
  void show_frame() {
    frame = simulation.frame();
    frame.steady_ns = now_ns;
    for (state::EffectorState& row : frame.effectors)
      if (row.applied_ns != 0) row.applied_ns = now_ns;
  }
};

// A tool of 0.1 kg that floats without gravity and damping, and two cameras that see it from different sides, none of
// them along an axis of the world: names as in the shipped device files.
inline constexpr math::Vec3 kToolPlace{0.0, 0.0, 1.0};
inline constexpr double kToolSide_m = 0.1;

inline scene::Camera watching_camera(const std::string& name, const math::Vec3& location, const math::Vec3& up) {
  scene::Camera camera;
  camera.identity.identifier = camera.identity.name = name;
  camera.identity.name_space = "/test/cameras/";
  camera.location = location;
  camera.look_at = kToolPlace;
  camera.up = up;
  return camera;
}

inline scene::Body floating_tool(const std::string& name, const math::Vec3& position = kToolPlace) {
  scene::Body body = model::test::box(name, 0.1, position, kToolSide_m);
  body.gravity = math::Vec3{};
  body.surface.linear_damping = body.surface.angular_damping = 0.0;
  return body;
}

// A static cube whose near face is `gap_m` from the tool's, on the side of `direction` (an axis of the world).
inline scene::Body wall_beside(const std::string& name, const math::Vec3& direction, double gap_m,
                               const math::Vec3& tool = kToolPlace) {
  constexpr double kWallSide_m = 0.2;
  return model::test::box(name, 0.0, tool + direction * (0.5 * (kToolSide_m + kWallSide_m) + gap_m), kWallSide_m);
}

inline scene::Model shared_tool_scene() {
  scene::Model model = model::test::model("scene", {floating_tool("right_gripper")});
  model.cameras.push_back(watching_camera("main_camera", {0.9, 0.4, 1.5}, {0.1, 0.0, 1.0}));
  model.cameras.push_back(watching_camera("close_camera", {-0.5, 0.8, 0.6}, {0.6, 0.2, 0.7}));
  return model;
}

}  // namespace ambf::devices::testing
