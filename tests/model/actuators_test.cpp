// Actuators hold the body that a command names and let it go: with the command, its watchdog, a reset, and the end of
// either body.
#include <gtest/gtest.h>

#include "adf/adf.h"
#include "math/rotation.h"
#include "rig.h"
#include "state/actuators.h"

namespace ambf::model::test {
namespace {

constexpr const char* kHands = R"(namespace: /test/
bodies: [BODY hand, BODY cube, BODY wall]
actuators: [ACTUATOR grip, ACTUATOR back, ACTUATOR lost]
BODY hand: {name: hand, mass: 2.0, gravity: {x: 0, y: 0, z: 0}, location: {position: {x: 0, y: 0, z: 1}},
            inertial offset: {position: {x: 0.1, y: 0, z: 0}}, inertia: {ix: 0.1, iy: 0.1, iz: 0.1}}
BODY cube: {name: cube, mass: 0.5, location: {position: {x: 0.4, y: 0, z: 1}}, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}}
BODY wall: {name: wall, mass: 0.0, location: {position: {x: 3, y: 0, z: 0}}}
ACTUATOR grip: {name: grip, type: Constraint, parent: BODY hand, location: {position: {x: 0.2, y: 0, z: 0}}}
ACTUATOR back: {name: back, type: Constraint, parent: BODY cube}
ACTUATOR lost: {name: lost, type: Constraint}
)";

struct World {
  World() { loaded = rig.load(*adf::parse_model(kHands, "hands.yaml").model).success; }

  state::ObjectKind kind() const { return state::actuator_kind().kind; }
  const state::ActuatorState& actuator(const std::string& name) const {
    return state::rows(*rig.frame, state::actuator_kind().column).at(rig.slot(name, kind()));
  }
  std::unique_ptr<state::CommandPort> port(const std::string& name, state::Source source = state::Source::ros) {
    return rig.port(name, source, kind());
  }
  state::ActuatorCommand hold(const std::string& body) const {
    state::ActuatorCommand command;
    command.actuate = true;
    command.body = rig.id(body);
    return command;
  }
  static state::Command posted(const state::ActuatorCommand& command) { return state::KindCommand{command}; }
  std::string refusal(const std::string& actuator, state::ActuatorCommand command) const {
    return state::check(command, *rig.live->structure(), rig.object(actuator, kind()));
  }

  Rig rig{{0, 0, -9.81}};
  bool loaded = false;
};

const state::ActuatorCommand kLetGo;

TEST(Actuators, AreReadFromTheirBlocksAndSitInTheFrameOfTheCentreOfMass) {
  const World world;
  ASSERT_TRUE(world.loaded);
  const auto& rows = state::actuators(*world.rig.live->structure());
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].parent_object, world.rig.object("hand"));
  EXPECT_EQ(rows[0].visible_size_m, 0.02);
  EXPECT_NEAR(world.actuator("grip").T_world_object.position.x, 0.1 + 0.2, 1e-12);
  EXPECT_EQ(world.actuator("grip").T_parent_object.position, (math::Vec3{0.2, 0, 0})) << "as its file says";
  EXPECT_FALSE(world.actuator("grip").actuated());
}

TEST(Actuators, ReportWhatHoldsNothing) {
  const adf::ModelResult read = adf::parse_model(
      "namespace: /test/\nactuators: [ACTUATOR a, ACTUATOR b, ACTUATOR c]\nACTUATOR a: {type: Constraint, max impulse: "
      "0}\n"
      "ACTUATOR b: {type: Constraint, max impulse: -1}\nACTUATOR c: {type: Spring}\n",
      "actuators.yaml");
  ASSERT_TRUE(read.model);
  EXPECT_EQ(read.model->blocks.size(), 1u) << "a negative bound and an unknown type cost the block";
  std::size_t errors = 0, warnings = 0;
  for (const base::Diagnostic& found : read.diagnostics) {
    errors += found.severity == base::Severity::error ? 1 : 0;
    warnings += found.severity == base::Severity::warning ? 1 : 0;
  }
  EXPECT_EQ(errors, 2u);
  EXPECT_EQ(warnings, 1u);
}

TEST(Actuators, HoldTheNamedBodyWhereItIsUntilTheCommandEnds) {
  World world;
  const auto port = world.port("grip");
  port->post(World::posted(world.hold("cube")));
  world.rig.step(100);
  const state::ActuatorState& grip = world.actuator("grip");
  ASSERT_EQ(grip.held_count, 1u);
  EXPECT_EQ(grip.held[0], world.rig.slot("cube"));
  const math::Pose relative = math::inverse(world.rig.body("hand").T_world_body) * world.rig.body("cube").T_world_body;
  EXPECT_LT(math::norm(relative.position - math::Vec3{0.4, 0, 0}), 1e-6);
  EXPECT_GT(grip.force_world.z, 1.0) << "the hand carries the cube";
  port->post(World::posted(world.hold("wall")));
  world.rig.step(1);
  EXPECT_EQ(world.actuator("grip").held[0], world.rig.slot("cube")) << "it must let go first";
  port->post(World::posted(kLetGo));
  world.rig.step(1);
  EXPECT_FALSE(world.actuator("grip").actuated());
  port->post(World::posted(world.hold("cube")));
  world.rig.step(100);
  EXPECT_TRUE(world.actuator("grip").actuated());
  world.rig.step(500);
  EXPECT_FALSE(world.actuator("grip").actuated()) << "the watchdog lets go";
  EXPECT_FALSE(world.actuator("grip").active);
}

TEST(Actuators, BringTheOffsetFrameToTheirs) {
  World world;
  const auto port = world.port("grip");
  state::ActuatorCommand command = world.hold("cube");
  command.use_offset = true;
  command.T_held_grasp.position = {-0.05, 0, 0};
  port->post(World::posted(command));
  port->hold();
  world.rig.step(500);
  const math::Pose relative = world.rig.body("hand").T_world_body;
  const math::Pose held = math::inverse(relative) * world.rig.body("cube").T_world_body;
  EXPECT_LT(math::norm(held.position - math::Vec3{0.35, 0, 0}), 1e-4);
}

TEST(Actuators, FollowTheSourceThatWroteLast) {
  World world;
  const auto ros = world.port("grip"), panel = world.port("grip", state::Source::panel);
  ros->post(World::posted(world.hold("cube")));
  ros->hold();
  world.rig.step(1);
  panel->post(World::posted(kLetGo));
  world.rig.step(1);
  EXPECT_FALSE(world.actuator("grip").actuated());
  panel->release();
  world.rig.step(1);
  EXPECT_TRUE(world.actuator("grip").actuated());
}

TEST(Actuators, CommandsThatMeanNoGraspAreRefusedWithTheReason) {
  World world;
  EXPECT_EQ(world.refusal("grip", world.hold("cube")), "");
  EXPECT_EQ(world.refusal("grip", kLetGo), "");
  EXPECT_NE(world.refusal("grip", world.hold("hand")), "") << "itself";
  EXPECT_NE(world.refusal("lost", world.hold("cube")), "") << "hangs on no body";
  state::ActuatorCommand command = world.hold("cube");
  command.body = {12345, 1};
  EXPECT_NE(world.refusal("grip", command), "");
  command = world.hold("cube");
  command.use_offset = true;
  command.T_held_grasp.orientation = {0, 0, 0, 0};
  EXPECT_NE(world.refusal("grip", command), "");
  command.T_held_grasp.orientation = {0, 0, 0, 1.05};
  EXPECT_EQ(world.refusal("grip", command), "");

  // What holds its own holder is known in the simulation only.
  const auto grip = world.port("grip"), back = world.port("back");
  grip->post(World::posted(world.hold("cube")));
  world.rig.step(2);
  back->post(World::posted(world.hold("hand")));
  world.rig.step(2);
  EXPECT_FALSE(world.actuator("back").actuated());
  const auto refused = [&] {
    for (const state::CommandState& row : world.rig.frame->commands)
      if (row.object == world.rig.object("back", world.kind())) return row.refused;
    return std::uint64_t{0};
  };
  EXPECT_EQ(refused(), 1u);
  world.rig.step(10);
  EXPECT_EQ(refused(), 1u) << "once a command";
  back->post(force({1, 0, 0}));
  world.rig.step(1);
  EXPECT_EQ(refused(), 2u) << "of another kind";
}

TEST(Actuators, LetGoWhenEitherBodyOrTheirFileLeaves) {
  for (const char* leaving : {"/test/BODY cube", "/test/BODY hand", "/test/ACTUATOR grip", ""}) {
    World world;
    const auto port = world.port("grip");
    port->post(World::posted(world.hold("cube")));
    port->hold();
    world.rig.step(10);
    ASSERT_TRUE(world.actuator("grip").actuated());
    Prepared change =
        *leaving == 0 ? world.rig.catalogue.prepare_unload("hands.yaml") : world.rig.catalogue.prepare_remove(leaving);
    ASSERT_TRUE(world.rig.apply(std::move(change)).success) << leaving;
    world.rig.step(10);
    if (std::string(leaving) == "/test/BODY cube" || std::string(leaving) == "/test/BODY hand") {
      EXPECT_FALSE(world.actuator("grip").actuated()) << leaving;
    }
    if (std::string(leaving) == "/test/ACTUATOR grip") {
      EXPECT_LT(world.rig.body("cube").twist_world.linear.z, -0.05) << "the cube falls";
    }
  }
}

TEST(Actuators, WhatACommandHoldsStaysHeldThroughResets) {
  World world;
  const auto port = world.port("grip");
  state::ActuatorCommand aside = world.hold("cube");
  aside.use_offset = true;
  aside.T_held_grasp.position = {0, 0.2, 0};  // not where the file has the cube
  port->post(World::posted(aside));
  world.rig.step(400);
  const auto relative = [&] {
    return math::inverse(world.rig.body("hand").T_world_body) * world.rig.body("cube").T_world_body;
  };
  const math::Pose held = relative();
  ASSERT_GT(std::abs(held.position.y), 0.1);
  for (const auto reset : {&LiveWorld::reset, static_cast<void (LiveWorld::*)()>(&LiveWorld::reset_bodies)}) {
    ((*world.rig.live).*reset)();
    world.rig.live->fill(*world.rig.frame);
    EXPECT_TRUE(world.actuator("grip").actuated());
    EXPECT_NEAR(world.rig.body("hand").T_world_body.position.z, 1.0, 1e-9) << "the hand is where it was loaded";
    EXPECT_LT(math::norm(relative().position - held.position), 1e-9);
    world.rig.step(10);
    EXPECT_TRUE(world.actuator("grip").actuated());
    EXPECT_LT(math::norm(relative().position - held.position), 1e-6);
    EXPECT_LT(math::norm(world.rig.body("cube").twist_world.linear), 0.2) << "nothing was thrown";
  }
  port->post(World::posted(kLetGo));
  world.rig.step(2);
  world.rig.live->reset_bodies();
  world.rig.step(1);
  EXPECT_FALSE(world.actuator("grip").actuated());
  EXPECT_NEAR(world.rig.body("cube").T_world_body.position.x, 0.4, 1e-5) << "where it was loaded";
}

TEST(Actuators, ContinueFromASnapshotInMidGrasp) {
  World one, two;
  const auto port = one.port("grip");
  port->post(World::posted(one.hold("cube")));
  one.rig.step(50);
  const std::vector<std::uint8_t> saved = one.rig.live->save();
  ASSERT_EQ(two.rig.live->restore(saved), "");
  two.rig.live->fill(*two.rig.frame);
  EXPECT_TRUE(two.actuator("grip").actuated());
  for (int i = 0; i < 600; ++i) {  // beyond the watchdog
    one.rig.step(1);
    two.rig.step(1);
    ASSERT_EQ(state::state_hash(*one.rig.frame), state::state_hash(*two.rig.frame)) << i;
  }
  EXPECT_FALSE(two.actuator("grip").actuated());
}

TEST(Actuators, MoveToTheParentThatTheyAreGiven) {
  World world;
  const auto port = world.port("grip");
  port->post(World::posted(world.hold("cube")));
  port->hold();
  world.rig.step(10);
  const math::Pose before = world.actuator("grip").T_world_object;
  ASSERT_TRUE(
      world.rig.apply(world.rig.catalogue.prepare_set_parent(world.rig.id("grip", world.kind()), "BODY wall")).success);
  EXPECT_LT(math::norm(world.actuator("grip").T_world_object.position - before.position), 1e-12);
  world.rig.step(10);
  ASSERT_TRUE(world.actuator("grip").actuated());
  EXPECT_LT(math::norm(world.rig.body("cube").twist_world.linear), 1e-3) << "the wall holds it now";
}

}  // namespace
}  // namespace ambf::model::test
