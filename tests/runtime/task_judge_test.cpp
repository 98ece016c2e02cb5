// The judge of tasks: what counts, and what nearly does and never counts. Places, angles, order and times on bodies
// that the test puts where it wants; holds, hand-overs and drops on the peg board, with rings in real jaws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/rotation.h"
#include "state/actuators.h"
#include "tests/runtime/peg_board_rig.h"
#include "tests/runtime/simulation_rig.h"

namespace ambf::runtime {
namespace {

using test::PegBoard;

// ---- places: a piece and another one that no physics moves ----

const std::string kPieces = R"(
bodies: [BODY board, BODY piece, BODY other]
tasks: [TASK t]
namespace: /test/
BODY board: {name: board, mass: 0, location: {position: {x: 1, y: 0, z: 0}}}
BODY piece: {name: piece, mass: 0, location: {position: {x: 5, y: 0, z: 0}}}
BODY other: {name: other, mass: 0, location: {position: {x: 6, y: 0, z: 0}}}
TASK t:
  name: t
)";

const std::string kOneGoal = R"(
  goals: [{piece: BODY piece, place: BODY board, location: {position: {x: 0.1, y: 0, z: 0.02}},
           position tolerance: {x: 0.003, y: 0.003, z: 0.002}, angle tolerance: 0.1, hold: 0.5}]
)";

struct Pieces {
  explicit Pieces(const std::string& task) : simulation(test::free_running(), test::empty_world(), {}, log) {
    state::LoadRequest request;
    request.text = kPieces + task;
    const state::Outcome outcome = simulation.load(request);
    EXPECT_TRUE(outcome.success);
    for (const base::Diagnostic& found : outcome.diagnostics)
      if (found.severity == base::Severity::error) ADD_FAILURE() << base::to_string(found);
  }
  // In the world; the board's place is (1.1, 0, 0.02).
  void put(const std::string& body, const math::Pose& T_world_body) {
    const auto structure = simulation.structure();
    const std::uint32_t object = state::find(*structure, "/test/" + body, state::ObjectKind::rigid_body);
    auto port = simulation.bind(structure->objects.at(object).id, state::Source::plugin);
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::position;
    command.T_world_body = T_world_body;
    port->post(std::move(command));
    ASSERT_TRUE(simulation.step());
  }
  void run(unsigned steps) { ASSERT_TRUE(simulation.step(steps)); }
  const state::TaskState& task() const { return state::rows(simulation.frame(), state::task_kind().column).at(0); }
  const state::TaskGoalState& goal(std::size_t i) const { return state::goals_of(simulation.frame(), 0)[i]; }

  JudgedLog log;
  LocalSimulation simulation;
};

math::Pose at(double x, double y, double z, const math::Quat& turned = {}) { return {{x, y, z}, turned}; }
math::Quat about(const math::Vec3& axis, double angle) { return math::from_axis_angle(axis, angle); }

TEST(TaskPlaces, CountWhenThePieceHasStoodThereForSoLong) {
  Pieces world(kOneGoal);
  world.put("piece", at(1.1, 0, 0.02));
  world.run(498);
  EXPECT_FALSE(world.task().success) << "499 steps";
  EXPECT_TRUE(world.goal(0).met);
  world.run(1);
  EXPECT_TRUE(world.task().success);
  EXPECT_NEAR(world.task().success_since_s, 0.5, 1e-9);
  EXPECT_NEAR(world.task().time_s, 0.5, 1e-9);
  world.run(100);
  EXPECT_NEAR(world.task().success_since_s, 0.5, 1e-9);
  EXPECT_NEAR(world.task().time_s, 0.5, 1e-9) << "to the first success";
  world.put("piece", at(1.2, 0, 0.02));
  EXPECT_FALSE(world.task().success) << "it ends with what it is about";
  EXPECT_EQ(world.task().success_since_s, 0.0);
  EXPECT_NEAR(world.task().time_s, 0.5, 1e-9);
  EXPECT_NEAR(world.goal(0).distance_m, 0.1, 1e-9);
}

struct NearMiss {
  const char* name;
  math::Pose T_world_piece;
};

TEST(TaskPlaces, NearMissesNeverCount) {
  constexpr double kPi = std::numbers::pi;
  const NearMiss misses[] = {
      {"beside it", at(1.1031, 0, 0.02)},
      {"beside it, the other way", at(1.1, -0.0031, 0.02)},
      {"hovering", at(1.1, 0, 0.0221)},
      {"sunk", at(1.1, 0, 0.0179)},
      {"leaning", at(1.1, 0, 0.02, about({1, 0, 0}, 0.11))},
      {"turned", at(1.1, 0, 0.02, about({0, 0, 1}, 0.11))},
      {"upside down", at(1.1, 0, 0.02, about({1, 0, 0}, kPi))},
      {"at the same place of the world, not of the board", at(0.1, 0, 0.02)},
  };
  for (const NearMiss& miss : misses) {
    Pieces world(kOneGoal);
    world.put("piece", miss.T_world_piece);
    world.run(1000);
    EXPECT_FALSE(world.task().success || world.goal(0).met) << miss.name;
  }
  Pieces world(kOneGoal);
  world.put("other", at(1.1, 0, 0.02));
  world.run(1000);
  EXPECT_FALSE(world.task().success || world.goal(0).met) << "the wrong piece";
}

TEST(TaskPlaces, PassingThroughIsNotStaying) {
  Pieces world(kOneGoal);
  for (int again = 0; again < 3; ++again) {
    world.put("piece", at(1.1, 0, 0.02));
    world.run(450);
    world.put("piece", at(1.104, 0, 0.02));
    world.run(5);
  }
  EXPECT_FALSE(world.task().success) << "the time counts anew";
}

TEST(TaskPlaces, OnlyAnAxisMayCountAndEitherWayOfIt) {
  const std::string goal =
      "  goals: [{piece: BODY piece, place: BODY board, location: {position: {x: 0.1, y: 0, z: 0.02}}, position "
      "tolerance: 0.003, angle tolerance: 0.1, axis: {x: 0, y: 0, z: 1}";
  const math::Pose turned = at(1.1, 0, 0.02, about({0, 0, 1}, 2.0));
  const math::Pose upside_down = at(1.1, 0, 0.02, about({1, 0, 0}, std::numbers::pi - 0.05));
  const math::Pose leaning = at(1.1, 0, 0.02, about({1, 0, 0}, 0.11));
  Pieces one(goal + "}]\n"), either(goal + ", either way: true}]\n");
  one.put("piece", turned);
  EXPECT_TRUE(one.task().success);
  one.put("piece", upside_down);
  EXPECT_FALSE(one.task().success);
  either.put("piece", upside_down);
  EXPECT_TRUE(either.task().success);
  either.put("piece", leaning);
  EXPECT_FALSE(either.task().success);
}

TEST(TaskPlaces, APointOfThePieceAndAnyOfSeveralPieces) {
  Pieces world(
      "  goals: [{pieces: [BODY piece, BODY other], point: {x: 0, y: 0, z: -0.05}, place: BODY board, "
      "position tolerance: 0.001}]\n");
  world.put("other", at(1, 0, 0));
  EXPECT_FALSE(world.task().success);
  world.put("other", at(1, 0, 0.05));
  EXPECT_TRUE(world.task().success);
}

// A, B: pieces; the places are 0.1 and 0.2 along x.
const std::string kInOrder = R"(
  order: listed
  goals:
  - {name: a, piece: BODY piece, place: BODY board, location: {position: {x: 0.1, y: 0, z: 0}},
     position tolerance: 0.01, hold: 0.1}
  - {name: b, piece: BODY other, place: BODY board, location: {position: {x: 0.2, y: 0, z: 0}},
     position tolerance: 0.01, hold: 0.1}
  - {name: back, piece: BODY piece, place: BODY board, location: {position: {x: 0.3, y: 0, z: 0}},
     position tolerance: 0.01}
)";

TEST(TaskOrder, GoalsCountOneAfterTheOther) {
  Pieces world(kInOrder);
  world.run(1);
  world.put("piece", at(1.1, 0, 0));
  world.run(120);
  EXPECT_EQ(world.task().goals_done, 1U);
  world.put("other", at(1.2, 0, 0));
  world.run(120);
  EXPECT_EQ(world.task().goals_done, 2U);
  world.put("piece", at(1.3, 0, 0));
  EXPECT_TRUE(world.task().success) << "a goal that is done stays done though its piece goes on";
  EXPECT_EQ(world.task().wrong_order, 0U);
}

TEST(TaskOrder, WhatIsDoneTooEarlyIsCountedAndMustBeDoneAgain) {
  Pieces world(kInOrder);
  world.run(1);
  world.put("other", at(1.2, 0, 0));
  world.run(120);
  EXPECT_EQ(world.task().wrong_order, 1U);
  world.put("piece", at(1.1, 0, 0));
  world.run(400);
  EXPECT_EQ(world.task().goals_done, 1U) << "the second piece lies there since before its turn";
  EXPECT_EQ(world.task().wrong_order, 1U);
  world.put("other", at(6, 0, 0));
  world.put("other", at(1.2, 0, 0));
  world.run(120);
  EXPECT_EQ(world.task().goals_done, 2U);
}

TEST(TaskOrder, PiecesThatLieWhereTheyBelongLaterAreNoMistake) {
  Pieces world(kInOrder);
  world.put("other", at(1.2, 0, 0));
  world.run(150);
  EXPECT_EQ(world.task().wrong_order, 0U) << "it was never elsewhere";
  world.put("piece", at(1.1, 0, 0));
  world.run(150);
  EXPECT_EQ(world.task().goals_done, 1U);
  EXPECT_EQ(world.task().wrong_order, 0U);
}

TEST(TaskSensors, ASensorMustSenseThePiece) {
  const std::string scene = R"(
bodies: [BODY piece, BODY other]
sensors: [SENSOR eye]
tasks: [TASK t]
namespace: /test/
BODY piece: {name: piece, mass: 0, location: {position: {x: 5, y: 0, z: 0}}, collision shape: BOX,
  collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
BODY other: {name: other, mass: 0, location: {position: {x: 0, y: 0, z: 0.5}}, collision shape: BOX,
  collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
SENSOR eye: {name: eye, type: Proximity, range: 1, location: {position: {x: 0, y: 0, z: 0}},
  array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: 1}}]}
TASK t: {name: t, goals: [{piece: BODY piece, sensor: SENSOR eye}]}
)";
  JudgedLog log;
  LocalSimulation simulation(test::free_running(), test::empty_world(), {}, log);
  state::LoadRequest request;
  request.text = scene;
  ASSERT_TRUE(simulation.load(request).success);
  const auto success = [&] { return state::rows(simulation.frame(), state::task_kind().column).at(0).success; };
  ASSERT_TRUE(simulation.step(5));
  EXPECT_FALSE(success()) << "it senses the other one";
  ASSERT_TRUE(simulation.remove("BODY other").success);
  const auto structure = simulation.structure();
  const std::uint32_t piece = state::find(*structure, "BODY piece", state::ObjectKind::rigid_body);
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::position;
  command.T_world_body = at(0, 0, 0.4);
  simulation.bind(structure->objects[piece].id, state::Source::plugin)->post(std::move(command));
  ASSERT_TRUE(simulation.step(5));
  EXPECT_TRUE(success());
  ASSERT_TRUE(simulation.remove("SENSOR eye").success);
  ASSERT_TRUE(simulation.step(5));
  EXPECT_FALSE(success()) << "without its sensor a goal cannot be met";
}

TEST(Tasks, OutliveWhatTheyNameAndBeginAnewByAReset) {
  for (const char* leaving : {"BODY piece", "BODY board", "BODY other"}) {
    Pieces world(kInOrder);
    world.run(1);
    world.put("piece", at(1.1, 0, 0));
    world.run(150);
    ASSERT_EQ(world.task().goals_done, 1U);
    ASSERT_TRUE(world.simulation.remove(leaving).success);
    world.run(50);
    EXPECT_FALSE(world.task().success) << leaving;
    world.simulation.reset();
    world.run(10);
    EXPECT_EQ(world.task().goals_done, 0U) << leaving;
    EXPECT_NEAR(world.task().time_s, 0.01, 1e-9);
  }
}

TEST(Tasks, GoOnFromASnapshot) {
  Pieces world(kOneGoal);
  world.put("piece", at(1.1, 0, 0.02));
  world.run(300);
  ASSERT_TRUE(world.simulation.snapshot("here").success);
  world.run(199);
  ASSERT_TRUE(world.task().success);
  const std::uint64_t hash = state::state_hash(world.simulation.frame());
  ASSERT_TRUE(world.simulation.restore("here").success);
  EXPECT_FALSE(world.task().success);
  EXPECT_NEAR(world.goal(0).held_s, 0.301, 1e-9);
  world.run(198);
  EXPECT_FALSE(world.task().success);
  world.run(1);
  EXPECT_TRUE(world.task().success);
  EXPECT_EQ(state::state_hash(world.simulation.frame()), hash);
}

TEST(TaskTouches, EachIsCountedOnce) {
  const std::string scene = R"(
bodies: [BODY floor, BODY ball]
tasks: [TASK t]
namespace: /test/
BODY floor: {name: floor, mass: 0, collision shape: BOX, collision geometry: {x: 4, y: 4, z: 0.2}, restitution: 0.9}
BODY ball: {name: ball, mass: 0.1, collision shape: SPHERE, collision geometry: {radius: 0.05}, restitution: 0.9,
  location: {position: {x: 0, y: 0, z: 0.4}}}
TASK t: {name: t, avoid: [BODY floor], goals: [{piece: BODY ball, position tolerance: 0.001}]}
)";
  JudgedLog log;
  LocalSimulation simulation(test::free_running(), test::empty_world(), {}, log);
  state::LoadRequest request;
  request.text = scene;
  ASSERT_TRUE(simulation.load(request).success);
  unsigned bounces = 0, steps_apart = 100;
  for (int i = 0; i < 1500; ++i) {
    ASSERT_TRUE(simulation.step());
    const auto& contacts = simulation.frame().contacts;
    const bool touches = std::any_of(contacts.begin(), contacts.end(), [](const state::ContactState& contact) {
      return contact.distance <= 0.0 || contact.impulse > 0.0;
    });
    if (touches && steps_apart > 20) ++bounces;
    steps_apart = touches ? 0 : steps_apart + 1;
  }
  EXPECT_GE(bounces, 2U);
  EXPECT_EQ(state::rows(simulation.frame(), state::task_kind().column).at(0).touches, bounces);
}

TEST(TaskHolds, WhatAnActuatorHoldsIsHeldAndLettingItFallIsADrop) {
  const std::string scene = R"(
bodies: [BODY hand, BODY piece]
actuators: [ACTUATOR grasp]
tasks: [TASK t]
namespace: /test/
BODY hand: {name: hand, mass: 0, location: {position: {x: 0, y: 0, z: 0.5}}}
BODY piece: {name: piece, mass: 0.1, collision shape: SPHERE, collision geometry: {radius: 0.01},
  location: {position: {x: 0, y: 0, z: 0.45}}}
ACTUATOR grasp: {name: grasp, type: Constraint, parent: BODY hand}
TASK t: {name: t, holders: [BODY hand], goals: [{piece: BODY piece, location: {position: {x: 0, y: 0, z: 0.45}},
  position tolerance: 0.005, held by: BODY hand, hold: 0.1}]}
)";
  JudgedLog log;
  LocalSimulation simulation(test::free_running(), test::empty_world(), {}, log);
  state::LoadRequest request;
  request.text = scene;
  ASSERT_TRUE(simulation.load(request).success);
  const auto structure = simulation.structure();
  state::ActuatorCommand command;
  command.actuate = true;
  command.body = structure->objects[state::find(*structure, "BODY piece", state::ObjectKind::rigid_body)].id;
  const std::uint32_t actuator = state::find(*structure, "ACTUATOR grasp", state::actuator_kind().kind);
  auto port = simulation.bind(structure->objects.at(actuator).id, state::Source::plugin);
  port->post(state::KindCommand{command});
  ASSERT_TRUE(simulation.step(105));
  const auto task = [&] { return state::rows(simulation.frame(), state::task_kind().column).at(0); };
  EXPECT_EQ(state::pieces_of(simulation.frame(), 0)[0].held_by, 1U);
  EXPECT_TRUE(task().success);
  EXPECT_EQ(task().drops, 0U);
  port->post(state::KindCommand{state::ActuatorCommand{}});
  ASSERT_TRUE(simulation.step(100));
  EXPECT_FALSE(task().success);
  EXPECT_EQ(task().drops, 1U);
}

// ---- holds, on the peg board ----

std::string ring_to_peg_8(const std::string& more) {
  return R"(
tasks: [TASK t]
namespace: /ambf/env/
TASK t:
  name: t
  holders: [BODY left_gripper, BODY right_gripper]
  goals:
  - {piece: BODY ring2, place: BODY pegs, location: {position: {x: -0.03, y: 0.057, z: 0.003}},
     position tolerance: {x: 0.005, y: 0.005, z: 0.004}, angle tolerance: 0.2, axis: {x: 0, y: 0, z: 1},
     either way: true, hold: 0.5, )" +
         more + "}\n";
}

// What a watcher sees who knows nothing of the judge: poses and contacts of every frame.
struct Watcher {
  explicit Watcher(PegBoard& board) : board_(board), ring_(board.slot("ring2")) {
    for (const char* name : {"left_gripper", "left_jaw_a", "left_jaw_b", "right_gripper", "right_jaw_a", "right_jaw_b"})
      hands_.push_back(board.slot(name));
    board.after_step = [this](const state::Frame& frame) { see(frame); };
  }

  std::uint32_t done_at_step = 0;  // 0: never
  unsigned falls = 0;
  bool ever_success = false;

 private:
  void see(const state::Frame& frame) {
    const state::BodyState& ring = frame.bodies[ring_];
    const math::Vec3 off = ring.T_world_body.position - math::Vec3{-0.03, 0.057, 0.029};
    const double upright = std::abs(math::rotate(ring.T_world_body.orientation, {0, 0, 1}).z);
    const bool there =
        std::abs(off.x) <= 0.005 && std::abs(off.y) <= 0.005 && std::abs(off.z) <= 0.004 && upright >= std::cos(0.2);
    since_touch_ = is_touched(frame) ? 0 : since_touch_ + 1;
    stays_ = there && since_touch_ > 20 ? stays_ + 1 : 0;
    if (stays_ == 500 && done_at_step == 0) done_at_step = frame.sim_step;
    // Nobody carries a ring down at 0.3 m/s: it falls, 5 mm deep or more.
    const bool falls_now = ring.twist_world.linear.z < -0.3;
    if (falls_now && !falling_) ++falls;
    if (ring.twist_world.linear.z > -0.05) falling_ = false;
    falling_ |= falls_now;
    ever_success |= board_.task().success;
  }
  bool is_touched(const state::Frame& frame) const {
    for (const state::ContactState& contact : frame.contacts) {
      if (contact.distance > 0.0 && contact.impulse <= 0.0) continue;
      for (const std::uint32_t hand : hands_)
        if ((contact.body_a == ring_ && contact.body_b == hand) || (contact.body_b == ring_ && contact.body_a == hand))
          return true;
    }
    return false;
  }

  PegBoard& board_;
  const std::uint32_t ring_;
  std::vector<std::uint32_t> hands_;
  unsigned since_touch_ = 1000, stays_ = 0;
  bool falling_ = false;
};

TEST(TaskHolds, ARingThatIsHeldAtItsPlaceHoversUntilItIsLetGo) {
  PegBoard board(ring_to_peg_8("hand over: false"));
  Watcher watcher(board);
  board.pick(PegBoard::right, "ring2");
  EXPECT_EQ(state::pieces_of(board.frame(), 0)[0].held_by, 2U) << "the right hand";
  board.bring(PegBoard::right, -0.03, 0.057);
  board.wait(1000);
  EXPECT_LT(state::goals_of(board.frame(), 0)[0].distance_m, 0.004);
  EXPECT_FALSE(watcher.ever_success) << "it is held there";
  board.let_go(PegBoard::right);
  board.wait(600);
  EXPECT_TRUE(board.task().success);
  EXPECT_EQ(state::pieces_of(board.frame(), 0)[0].held_by, 0U);
  EXPECT_EQ(std::lround(board.task().success_since_s * 1e3), watcher.done_at_step);
  EXPECT_EQ(std::lround(board.task().time_s * 1e3), watcher.done_at_step);
  EXPECT_EQ(board.task().drops, 0U);
  EXPECT_EQ(watcher.falls, 0U);
}

TEST(TaskHolds, WithoutAHandOverItNeverCountsAndPuttingDownIsNone) {
  PegBoard board(ring_to_peg_8("hand over: true"));
  Watcher watcher(board);
  board.pick(PegBoard::left, "ring2");
  board.bring(PegBoard::left, -0.03, 0.031);  // puts it on another peg
  board.let_go(PegBoard::left);
  board.go(PegBoard::left, 0.0, -0.1, 0.15);
  board.wait(800);
  EXPECT_FALSE(watcher.ever_success) << "the wrong peg";
  board.pick(PegBoard::right, "ring2");
  board.bring(PegBoard::right, -0.03, 0.057);
  board.let_go(PegBoard::right);
  board.wait(800);
  EXPECT_TRUE(watcher.done_at_step > 0) << "it is there";
  EXPECT_FALSE(watcher.ever_success);
  EXPECT_EQ(board.task().hand_overs, 0U);
}

TEST(TaskHolds, ARingThatIsLetGoEarlyIsDropped) {
  PegBoard board(ring_to_peg_8("hand over: false"));
  Watcher watcher(board);
  board.pick(PegBoard::right, "ring2");
  board.go(PegBoard::right, 0.07, 0.0, 0.1);  // beside all pegs
  board.let_go(PegBoard::right);
  board.wait(800);
  EXPECT_EQ(board.task().drops, 1U);
  EXPECT_EQ(watcher.falls, 1U);
  EXPECT_EQ(state::pieces_of(board.frame(), 0)[0].drops, 1U);
  EXPECT_FALSE(watcher.ever_success);
}

TEST(TaskHolds, SlidingDownItsPegIsNoDrop) {
  PegBoard board(ring_to_peg_8("hand over: false"));
  Watcher watcher(board);
  board.pick(PegBoard::right, "ring2");
  board.go(PegBoard::right, -0.03, 0.057 - PegBoard::kWall, 0.1);
  board.go(PegBoard::right, -0.03, 0.057 - PegBoard::kWall, 0.029 + PegBoard::kPin + 0.015);  // round the peg's top
  board.let_go(PegBoard::right);
  board.wait(800);
  EXPECT_TRUE(board.task().success);
  EXPECT_EQ(board.task().drops, 0U);
  EXPECT_EQ(std::lround(board.task().success_since_s * 1e3), watcher.done_at_step);
}

}  // namespace
}  // namespace ambf::runtime
