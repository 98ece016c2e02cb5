// Arms in the simulation: moves repeat bit for bit, saved states and recordings of inputs hold them, and joints are let
// go when nobody commands the arm any more.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "adf/crtk_arms.h"
#include "base/clock.h"
#include "base/realtime.h"
#include "crtk/arm_kind.h"
#include "crtk/arm_layout.h"
#include "inputs/recorder.h"
#include "inputs/recording.h"
#include "runtime/input_replay.h"
#include "runtime/local_simulation.h"
#include "state/columns.h"
#include "tests/runtime/simulation_rig.h"

namespace ambf::crtk {
namespace {

using runtime::test::empty_world;
using runtime::test::free_running;

// Before the first world.
[[maybe_unused]] const bool kRegistered = (register_arms(), true);

const std::string kBase = "/ambf/env/psm/BODY base link";
const Axes kAway{0.3, -0.2, 0.15, 0.8, 0.2, -0.3, 0.6};

std::string arm_text() {
  const auto read = adf::parse_crtk_arms("crtk arms: {PSM1: {kinematics: PSM, base: '" + kBase + "'}}", "arms.yaml");
  EXPECT_TRUE(read.diagnostics.empty());
  return model_text(read.arms.at(0), kBase);
}

state::LoadRequest psm() {
  state::LoadRequest request;
  request.path = AMBF_SOURCE_DIR "/ambf_models/descriptions/multi-bodies/robots/psm.yaml";
  request.T_world_model.position = {0.0, 0.0, 2.0};  // above the floor
  return request;
}

state::LoadRequest arm() {
  state::LoadRequest request;
  request.text = arm_text();
  return request;
}

std::uint32_t arm_slot(const state::Structure& structure) {
  const auto& arms = state::table<ArmInfo>(structure, arm_kind().kind);
  EXPECT_EQ(arms.size(), 1U);
  return 0;
}

state::ObjectId arm_id(const state::Structure& structure) {
  return structure.objects[state::table<ArmInfo>(structure, arm_kind().kind)[arm_slot(structure)].object].id;
}

class World {
 public:
  World() {
    EXPECT_TRUE(simulation.load(psm()).success);
    const state::Outcome loaded = simulation.load(arm());
    EXPECT_TRUE(loaded.success) << loaded.message;
    port = simulation.bind(arm_id(*simulation.structure()), state::Source::plugin);
  }

  void post(Mode mode, const Axes& values = {}) {
    command.arm = {++number, mode};
    command.jaw = {++number, mode};
    command.values = values;
    port->post(state::KindCommand{command});
  }
  const ArmInfo& info() const { return state::table<ArmInfo>(*simulation.structure(), arm_kind().kind)[0]; }
  const ArmState& row() const { return state::rows(simulation.frame(), arm_kind().column)[0]; }
  Axes measured() const {
    Axes position, velocity, effort;
    measure(info(), simulation.frame().joints, position, velocity, effort);
    return position;
  }
  std::uint64_t hash() const { return state::state_hash(simulation.frame()); }

  JudgedLog log;
  runtime::LocalSimulation simulation{free_running(), empty_world(), {}, log};
  std::unique_ptr<state::CommandPort> port;
  ArmCommand command;
  std::uint64_t number = 0;
};

TEST(ArmModel, JointsFollowAMoveToItsGoal) {
  World world;
  ASSERT_TRUE(world.info().whole());
  world.post(Mode::rest);
  world.port->hold();
  world.simulation.step(10);
  world.post(Mode::move, kAway);
  world.simulation.step(4000);
  EXPECT_FALSE(world.row().motion.arm.moves);
  EXPECT_TRUE(world.row().motion.arm.reached);
  EXPECT_TRUE(world.row().motion.jaw.reached);
  const Axes at = world.measured();
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(at[i], kAway[i], i == 2 ? 1e-3 : 5e-3) << i;
}

TEST(ArmModel, MovesRepeatBitForBitHoweverManyStepsRunAtOnce) {
  std::vector<std::uint64_t> hashes;
  for (const unsigned at_once : {1u, 7u, 350u}) {
    World world;
    world.post(Mode::rest);
    world.port->hold();
    world.simulation.step(7);
    world.post(Mode::move, kAway);
    for (unsigned done = 0; done < 350; done += at_once) world.simulation.step(at_once);
    Axes back{};
    back[2] = 0.1;
    world.post(Mode::move, back);  // while the first one moves
    for (unsigned done = 0; done < 350; done += at_once) world.simulation.step(at_once);
    EXPECT_TRUE(world.row().motion.arm.moves);
    hashes.push_back(world.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(ArmModel, ASavedStateGoesOnWithTheMoveItHolds) {
  World world;
  world.command.note = 5;
  world.post(Mode::rest);
  world.port->hold();
  world.simulation.step(5);
  world.post(Mode::move, kAway);
  world.simulation.step(300);
  ASSERT_TRUE(world.simulation.snapshot("here").success);
  world.simulation.step(200);
  const std::uint64_t first = world.hash();
  world.command.note = 1;
  world.post(Mode::off);  // what came later is forgotten
  world.simulation.step(300);
  ASSERT_TRUE(world.simulation.restore("here").success);
  EXPECT_EQ(world.row().motion.note, 5U);
  EXPECT_TRUE(world.row().motion.arm.moves);
  world.simulation.step(200);
  EXPECT_EQ(world.hash(), first);
  world.simulation.step(4000);
  EXPECT_TRUE(world.row().motion.arm.reached);
}

TEST(ArmModel, AResetEndsTheMoveAndTheArmRestsWhereItIsThen) {
  World world;
  world.post(Mode::rest);
  world.port->hold();
  world.simulation.step(5);
  const Axes start = world.measured();
  world.post(Mode::move, kAway);
  world.simulation.step(500);
  world.simulation.reset();
  EXPECT_FALSE(world.row().motion.arm.moves);
  world.simulation.step(500);
  const Axes now = world.measured();
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(now[i], start[i], 2e-3) << i;
}

TEST(ArmModel, NobodyCommandsJointsOfAnArmThatIsLetGo) {
  World world;
  const auto commanded = [&] { return world.simulation.frame().joints[world.info().joints[0].slot].commanded_type; };
  world.post(Mode::rest);
  world.simulation.step(2);
  EXPECT_EQ(commanded(), state::JointCommandType::position);
  world.simulation.step(600);  // nothing is heard of its sender for longer than the watchdog waits
  EXPECT_FALSE(world.row().active);
  EXPECT_EQ(commanded(), state::JointCommandType::effort);
  world.post(Mode::rest);
  world.simulation.step(2);
  EXPECT_EQ(commanded(), state::JointCommandType::position);
  world.post(Mode::off);
  world.simulation.step(2);
  EXPECT_EQ(commanded(), state::JointCommandType::effort);
}

TEST(ArmModel, AnArmWithoutOneOfItsJointsExertsNothing) {
  World world;
  world.post(Mode::rest);
  world.port->hold();
  world.simulation.step(2);
  ASSERT_TRUE(world.simulation.remove("/ambf/env/psm/BODY tool pitch link").success);
  EXPECT_FALSE(world.info().whole());
  world.simulation.step(2);
  EXPECT_EQ(world.simulation.frame().joints[world.info().joints[0].slot].commanded_type,
            state::JointCommandType::effort);
}

TEST(ArmModel, AnArmThatGetsNewJointsKeepsTheOthersMeanwhile) {
  World world;
  world.command.note = kKeepsOthers;
  world.post(Mode::rest);
  world.port->hold();
  world.simulation.step(2);
  const Axes before = world.measured();
  const std::string base = "/ambf/env/psm/BODY ";
  ASSERT_TRUE(world.simulation.remove(base + "tool gripper1 link").success);
  ASSERT_TRUE(world.simulation.remove(base + "tool gripper2 link").success);
  EXPECT_FALSE(world.info().whole());
  world.simulation.step(50);
  EXPECT_EQ(world.simulation.frame().joints[world.info().joints[0].slot].commanded_type,
            state::JointCommandType::position);
  const Axes now = world.measured();
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(now[i], before[i], 1e-4) << i;
  // The rest of the model goes, too: nothing is left to keep.
  ASSERT_TRUE(world.simulation.remove(base + "tool pitch link").success);
  world.simulation.step(2);
}

TEST(ArmModel, ARecordingOfInputsReplaysItsMoves) {
  const std::string path = testing::TempDir() + "ambf_crtk_replay_" + std::to_string(getpid());
  JudgedLog log;
  std::string problem;
  {
    inputs::SessionRecord session;
    session.start_ns = 1;
    const auto recorder = inputs::Recorder::create(path, session, log, problem);
    ASSERT_NE(recorder, nullptr) << problem;
    runtime::Simulation simulation({}, empty_world(), {}, log, recorder.get());
    ASSERT_TRUE(simulation.load_and_wait(psm()).success);
    simulation.begin();
    ASSERT_TRUE(simulation.load_and_wait(arm()).success);
    const auto port = simulation.bind(arm_id(*simulation.structure()), state::Source::plugin);
    ArmCommand command;
    const auto post = [&](Mode mode, std::uint64_t number) {
      command.arm = command.jaw = {number, mode};
      command.values = kAway;
      port->post(state::KindCommand{command});
      base::sleep_until(base::steady_ns() + base::to_ns(0.15));
      port->keep_alive();
    };
    post(Mode::rest, 1);
    post(Mode::move, 2);
    post(Mode::hold, 3);
    post(Mode::off, 4);
  }
  const auto recording = inputs::Recording::open(path, problem);
  ASSERT_NE(recording, nullptr) << problem;
  const scene::World world = empty_world();  // the replay refers to it
  runtime::InputReplay replay({}, world, {}, {}, *recording, log);
  const runtime::ReplayOutcome outcome = replay.run([] { return false; });
  EXPECT_EQ(outcome.problem, "");
  EXPECT_GT(outcome.steps, 100U);
  EXPECT_NE(state::rows(*replay.frame(), arm_kind().column)[0].motion.position[0], 0.0);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace ambf::crtk
