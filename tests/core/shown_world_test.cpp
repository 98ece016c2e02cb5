// What windows get of worlds in a Python program: copies, over which views, pause and speed are laid.
#include "native/shown_world.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "native/stepped_world.h"

namespace ambf::python {
namespace {

using std::chrono::milliseconds;

const char* const kScene = R"(
bodies: [BODY box]
cameras: [eye]
namespace: /test/
BODY box: {name: box, mass: 1, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}
eye: {namespace: /test/, name: eye, location: {x: 2, y: 0, z: 1}, look at: {x: 0, y: 0, z: 1}, up: {x: 0, y: 0, z: 1},
  clipping plane: {near: 0.01, far: 10}, field view angle: 0.8}
)";

struct Falling {
  Falling() : world(WorldSettings()) {
    state::LoadRequest request;
    request.text = kScene;
    EXPECT_TRUE(world.load(request).success);
    for (const Field& field : state_fields()) state.emplace_back(bytes_of(*world.structure(), field) + 1);
    for (const Field& field : command_fields()) commands.emplace_back(bytes_of(*world.structure(), field) + 1);
    world.attach(memory_of(state), memory_of(commands), false);
    world.run(1);
  }
  static Memory memory_of(std::vector<std::vector<char>>& of) {
    Memory out;
    for (std::vector<char>& each : of) out.push_back(each.data());
    return out;
  }
  state::ObjectId camera() const {
    const state::Structure& structure = *world.structure();
    return structure.objects[structure.cameras.at(0).object].id;
  }
  std::vector<std::vector<char>> state, commands;
  SteppedWorld world;
};

TEST(ShownWorld, ViewsAreTheWindowsOwn) {
  Falling falling;
  base::Log log;
  ShownWorld shown(falling.world.frame(), log);
  const auto reader = shown.make_reader();
  const state::Frame* first = reader->latest();
  const math::Pose loaded = first->cameras.at(0).T_parent_camera;
  EXPECT_EQ(reader->latest(), first) << "nothing is new";

  const auto port = shown.bind(falling.camera(), state::Source::pointer);
  ASSERT_NE(port, nullptr);
  const math::Pose moved{{0.5, 0.25, 2.0}, {}};
  port->post(state::PoseCommand{true, moved});
  state::Lens lens = first->cameras.at(0).lens;
  lens.far_m = 77.0;
  shown.set_lens(falling.camera(), lens);
  const state::Frame* second = reader->latest();
  EXPECT_GT(second->sequence, first->sequence) << "else no window draws it";
  EXPECT_TRUE(second->cameras.at(0).T_parent_camera == moved);
  EXPECT_NEAR(second->cameras.at(0).T_world_camera.position.z, 2.0, 1e-9);
  EXPECT_EQ(second->cameras.at(0).lens.far_m, 77.0);

  falling.world.run(100);
  shown.show(falling.world.frame(), 0.0);
  const state::Frame* third = reader->latest();
  EXPECT_TRUE(third->cameras.at(0).T_parent_camera == moved) << "it stays where it was put";
  EXPECT_LT(third->bodies.at(0).T_world_body.position.z, 0.99) << "the rest is the newest step";
  EXPECT_TRUE(falling.world.frame().cameras.at(0).T_parent_camera == loaded) << "the world's own is where it was";
}

TEST(ShownWorld, WorldsOfOneWindowHaveStructuresOfTheirOwn) {
  Falling first, second;
  ASSERT_EQ(first.world.structure()->version, second.world.structure()->version);
  base::Log log;
  ShownWorld shown(first.world.frame(), log);
  const auto reader = shown.make_reader();
  const std::uint64_t before = reader->latest()->structure->version;
  shown.show(first.world.frame(), 0.0);
  EXPECT_EQ(reader->latest()->structure->version, before);
  shown.show(second.world.frame(), 0.0);
  EXPECT_GT(reader->latest()->structure->version, before);
  EXPECT_EQ(shown.structure()->version, reader->latest()->structure->version);
}

TEST(ShownWorld, PauseStepsAndResetsAreForTheProgram) {
  Falling falling;
  base::Log log;
  ShownWorld shown(falling.world.frame(), log);
  EXPECT_TRUE(shown.wait_until_over(milliseconds(0)));
  shown.step_paused(3);  // while it runs: nothing
  shown.set_paused(true);
  EXPECT_TRUE(shown.paused());
  EXPECT_TRUE(shown.make_reader()->latest()->run.paused);
  EXPECT_FALSE(shown.wait_until_over(milliseconds(1)));
  shown.step_paused(2);
  EXPECT_TRUE(shown.wait_until_over(milliseconds(1)));
  EXPECT_TRUE(shown.wait_until_over(milliseconds(1)));
  EXPECT_FALSE(shown.wait_until_over(milliseconds(1)));
  shown.reset_world();
  EXPECT_TRUE(shown.wait_until_over(milliseconds(1))) << "a paused program sees it, too";
  EXPECT_TRUE(shown.take_reset());
  EXPECT_FALSE(shown.take_reset());
  EXPECT_FALSE(shown.wait_until_over(milliseconds(1)));
  shown.end();
  EXPECT_TRUE(shown.ended() && shown.wait_until_over(milliseconds(1)));
}

TEST(ShownWorld, WhatIsShownTakesItsTime) {
  Falling falling;
  base::Log log;
  ShownWorld shown(falling.world.frame(), log);
  const auto seconds_of = [&](int steps) {
    const std::int64_t begun_ns = base::steady_ns();
    for (int i = 0; i < steps; ++i) {
      shown.show(falling.world.frame(), 0.02);
      while (!shown.wait_until_over(milliseconds(5))) {
      }
    }
    return base::to_seconds(base::steady_ns() - begun_ns);
  };
  EXPECT_GT(seconds_of(5), 0.099);
  shown.set_speed(4.0);
  shown.set_speed(-1.0);  // which nothing has
  EXPECT_GT(seconds_of(20), 0.099);
}

TEST(ShownWorld, WhatWouldChangeTheWorldIsRefused) {
  Falling falling;
  base::Log log;
  ShownWorld shown(falling.world.frame(), log);
  int refusals = 0;
  const auto done = [&](const state::Outcome& outcome) {
    EXPECT_FALSE(outcome.success);
    EXPECT_NE(outcome.message.find("belongs to the program"), std::string::npos);
    ++refusals;
  };
  const state::Structure& structure = *falling.world.structure();
  const state::ObjectId box = structure.objects[structure.bodies.at(0).object].id;
  shown.remove("box", done);
  shown.load({}, done);
  shown.set_parameter(box, state::Parameter::friction, {1.0, 1.0, 1.0}, done);
  shown.push(box, {}, done);
  shown.restore("", "", done);
  EXPECT_EQ(refusals, 5);
  EXPECT_EQ(shown.bind(box, state::Source::panel), nullptr);
  EXPECT_EQ(shown.make_pick_port(), nullptr);
  base::LogRecord record;
  EXPECT_FALSE(log.take(record));
  shown.set_gravity({});
  EXPECT_TRUE(log.take(record)) << "it has no answer";
}

TEST(ShownWorld, AWindowReadsWhileTheProgramShows) {
  Falling falling;
  base::Log log;
  ShownWorld shown(falling.world.frame(), log);
  std::thread window([&] {
    const auto reader = shown.make_reader();
    const auto port = shown.bind(falling.camera(), state::Source::pointer);
    std::uint64_t before = 0;
    for (int i = 0; i < 300; ++i) {
      const state::Frame* frame = reader->latest();
      EXPECT_GE(frame->sequence, before);
      before = frame->sequence;
      port->post(state::PoseCommand{true, {{0.01 * i, 0.0, 0.0}, {}}});
      if (i % 50 == 0) shown.set_paused(i % 100 == 0);
    }
    shown.end();
  });
  while (!shown.ended()) {
    falling.world.run(1);
    shown.show(falling.world.frame(), 0.0);
    shown.wait_until_over(milliseconds(1));
  }
  window.join();
}

}  // namespace
}  // namespace ambf::python
