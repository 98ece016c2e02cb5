#include "tests/runtime/peg_board_rig.h"

#include <cmath>

#include "adf/adf.h"
#include "tests/runtime/simulation_rig.h"

namespace ambf::runtime::test {
namespace {

const std::string kModels = std::string(AMBF_SOURCE_DIR) + "/ambf_models/descriptions/";
constexpr double kSpeed = 0.2;  // m/s
constexpr unsigned kSteps = 5;  // between commands

scene::World ground() {
  const adf::WorldResult result = adf::load_world(kModels + "world/peg_transfer_world.yaml");
  EXPECT_TRUE(result.world.has_value());
  return result.world.value_or(empty_world());
}

}  // namespace

PegBoard::PegBoard(const std::string& tasks) : simulation(free_running(), ground(), {}, log) {
  log.allow("colo");  // without a table of colours
  state::LoadRequest board;
  board.path = kModels + "multi-bodies/puzzles/peg_transfer.yaml";
  EXPECT_TRUE(simulation.load(board).success);
  state::LoadRequest text;
  text.text = tasks;
  const state::Outcome outcome = simulation.load(text);
  for (const base::Diagnostic& found : outcome.diagnostics) ADD_FAILURE() << base::to_string(found);
  for (const Hand hand : {left, right}) {
    const char* name = hand == left ? "left_gripper" : "right_gripper";
    const auto structure = simulation.structure();
    const state::ObjectInfo& object = structure->objects[structure->bodies[slot(name)].object];
    hands_[hand].port = simulation.bind(object.id, state::Source::plugin);
    hands_[hand].at = body(name).T_world_body.position;
  }
  go(left, 0.0, -0.1, 0.15);
  go(right, 0.0, 0.1, 0.15);
}

void PegBoard::step(unsigned steps) {
  for (Gripper& hand : hands_) {
    if (hand.port == nullptr) continue;
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::position;
    command.T_world_body.position = hand.at;
    command.joints.assign(2, {state::JointCommandType::position, hand.opening});
    hand.port->post(std::move(command));
  }
  for (unsigned i = 0; i < steps; ++i) {
    ASSERT_TRUE(simulation.step());
    after_step(frame());
  }
}

void PegBoard::wait(unsigned steps) {
  for (; steps > kSteps; steps -= kSteps) step(kSteps);
  step(steps);
}

void PegBoard::go(Hand hand, double x, double y, double z) {
  const math::Vec3 begin = hands_[hand].at, goal{x, y, z};
  const auto parts = static_cast<int>(std::ceil(1e3 * math::norm(goal - begin) / kSpeed / kSteps));
  for (int part = 1; part <= parts; ++part) {
    hands_[hand].at = begin + (goal - begin) * (static_cast<double>(part) / parts);
    step(kSteps);
  }
  hands_[hand].at = goal;
  wait(200);
}

void PegBoard::jaws(Hand hand, double angle_rad) {
  hands_[hand].opening = angle_rad;
  wait(300);
}

void PegBoard::pick(Hand hand, const std::string& ring) {
  const math::Vec3 at = body(ring).T_world_body.position;
  go(hand, at.x, at.y - kWall, kAbove);
  jaws(hand, kOpen);
  go(hand, at.x, at.y - kWall, at.z + kPin);
  jaws(hand, kClosed);
  go(hand, at.x, at.y - kWall, kAbove);
}

void PegBoard::bring(Hand hand, double x, double y) {
  go(hand, x, y - kWall, kAbove);
  go(hand, x, y - kWall, 0.029 + kPin);
}

void PegBoard::let_go(Hand hand) {
  jaws(hand, kOpen);
  go(hand, hands_[hand].at.x, hands_[hand].at.y, kAbove);
}

std::uint32_t PegBoard::slot(const std::string& body) const {
  const auto structure = simulation.structure();
  const std::uint32_t object = state::find(*structure, "/ambf/env/" + body, state::ObjectKind::rigid_body);
  EXPECT_NE(object, state::kNone) << body;
  return object == state::kNone ? 0 : structure->objects[object].slot;
}

const state::BodyState& PegBoard::body(const std::string& name) const { return frame().bodies[slot(name)]; }

}  // namespace ambf::runtime::test
