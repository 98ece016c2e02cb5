// Goals of tasks that are punctures: where a needle went into tissue and came out, judged in the tissue as loaded.
#include <gtest/gtest.h>

#include <algorithm>

#include "math/rotation.h"
#include "runtime/local_simulation.h"
#include "state/tasks.h"
#include "tests/runtime/simulation_rig.h"

namespace ambf::runtime {
namespace {

// Half a circle of 26 mm above a block of tissue, whose upper side is at z = 0.1; turned about y, its tip goes in at +x
// and comes out at -x, 6.2 mm from the middle.
constexpr double kAbove = 0.1055;

const std::string kScene = R"(
namespace: /test/
bodies: [BODY needle, BODY stand]
actuators: [ACTUATOR stitch]
soft bodies: [SOFT pad]
tasks: [TASK t]
BODY needle: {name: needle, mass: 0, location: {position: {x: 0, y: 0, z: 0.13}}}
BODY stand: {name: stand, mass: 0, location: {position: {x: 0, y: 0, z: 0}}}
ACTUATOR stitch: {name: stitch, parent: BODY needle, type: Needle, puncture force: 0.01, friction: 2,
  arc: [{x: 0.008276, y: 0, z: 0}, {x: 0, y: 0, z: 0.008276}, {x: -0.008276, y: 0, z: 0}]}
SOFT pad: {name: pad, shape: BOX, geometry: {x: 0.024, y: 0.016, z: 0.008}, collision shape: BOX,
  collision geometry: {x: 0.024, y: 0.016, z: 0.008}, collision margin: 0.0002,
  location: {position: {x: 0, y: 0, z: 0.096}},
  tissue: {kind: solid, young modulus: 60000, element size: 0.004, regions: [
    {box: {x: 0.03, y: 0.02, z: 0.002}, location: {position: {x: 0, y: 0, z: -0.004}}, fixed: true}]}}
TASK t: {name: t, goals: [
  {piece: BODY needle, puncture: in, place: SOFT pad, location: {position: {x: 0.0062, y: 0, z: 0.004}},
   position tolerance: 0.001},
  {piece: BODY needle, puncture: out, place: SOFT pad, location: {position: {x: -0.0062, y: 0, z: 0.004}},
   position tolerance: 0.001},
  {name: swapped, piece: BODY needle, puncture: out, place: SOFT pad,
   location: {position: {x: 0.0062, y: 0, z: 0.004}}, position tolerance: 0.001},
  {name: world, piece: BODY needle, puncture: in, place: BODY stand,
   location: {position: {x: 0.0062, y: 0, z: 0.1}}, position tolerance: 0.002},
  {name: beside, piece: BODY needle, puncture: in, place: SOFT pad,
   location: {position: {x: 0.0062, y: 0.004, z: 0.004}}, position tolerance: 0.001}]}
)";

class Stitch : public testing::Test {
 protected:
  Stitch() : simulation(test::free_running(), test::empty_world(), {}, log) {
    log.allow("");  // what tissue says on loading
    state::LoadRequest request;
    request.text = kScene;
    const state::Outcome outcome = simulation.load(request);
    for (const base::Diagnostic& found : outcome.diagnostics)
      if (found.severity == base::Severity::error) ADD_FAILURE() << base::to_string(found);
    const auto structure = simulation.structure();
    const std::uint32_t object = state::find(*structure, "/test/needle", state::ObjectKind::rigid_body);
    needle = simulation.bind(structure->objects.at(object).id, state::Source::plugin);
  }
  void go(double x, double from, double to, int steps) {
    for (int i = 1; i <= steps; ++i) {
      state::RigidBodyCommand command;
      command.type = state::CartesianCommandType::position;
      command.T_world_body = {{x, 0.0, kAbove}, math::from_axis_angle({0.0, 1.0, 0.0}, from + (to - from) * i / steps)};
      needle->post(std::move(command));
      ASSERT_TRUE(simulation.step());
    }
  }
  const state::TaskGoalState& goal(std::size_t i) const { return state::goals_of(simulation.frame(), 0)[i]; }
  const state::TaskState& task() const { return state::rows(simulation.frame(), state::task_kind().column).at(0); }

  JudgedLog log;
  LocalSimulation simulation;
  std::unique_ptr<state::CommandPort> needle;
};

TEST_F(Stitch, EntryAndExitAreWhereTheTipWentThrough) {
  go(0.0, -0.2, 0.2, 100);
  EXPECT_FALSE(goal(0).met);
  EXPECT_EQ(goal(0).distance_m, 0.0) << "there is no puncture";
  go(0.0, 0.2, 1.5, 200);
  EXPECT_TRUE(goal(0).done);
  EXPECT_LT(goal(0).distance_m, 0.001);
  EXPECT_FALSE(goal(1).met) << "it has not come out";
  go(0.0, 1.5, 2.8, 200);
  EXPECT_TRUE(goal(1).done);
  EXPECT_TRUE(goal(3).done) << "in the frame of a body: in the world";
  EXPECT_FALSE(goal(2).met) << "it came out elsewhere";
  EXPECT_FALSE(goal(4).met) << "it went in elsewhere";
  EXPECT_NEAR(goal(4).distance_m, 0.004, 0.001);
  EXPECT_EQ(task().goals_done, 3U);
  // Dragged along, the tissue keeps its punctures where they were made.
  go(0.006, 2.8, 2.8, 300);
  EXPECT_TRUE(goal(0).done);
  EXPECT_FALSE(goal(3).met);
  // Drawn back, they are undone.
  go(0.0, 2.8, -0.2, 400);
  EXPECT_EQ(task().goals_done, 0U);
}

TEST_F(Stitch, OfAnotherPlaceDoesNotCount) {
  go(0.003, -0.2, 2.8, 400);
  EXPECT_EQ(goal(0).met, false);
  EXPECT_NEAR(goal(0).distance_m, 0.003, 0.001);
}

TEST(TaskPunctures, KeysThatMakeNoSenseAreReported) {
  for (const std::string extra :
       {"point: {x: 0, y: 0, z: 0.1}", "angle tolerance: 0.1", "sensor: SENSOR s", "puncture: through"}) {
    JudgedLog log;
    log.allow("");
    LocalSimulation simulation(test::free_running(), test::empty_world(), {}, log);
    state::LoadRequest request;
    const std::string puncture = extra.starts_with("puncture") ? "" : "puncture: in, ";
    request.text = "namespace: /test/\nbodies: [BODY needle]\ntasks: [TASK t]\nBODY needle: {name: needle, mass: 0}\n" +
                   ("TASK t: {name: t, goals: [{piece: BODY needle, position tolerance: 0.01, " + puncture + extra) +
                   "}]}\n";
    const state::Outcome outcome = simulation.load(request);
    const bool said = std::any_of(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                                  [](const base::Diagnostic& each) { return each.line > 0; });
    EXPECT_TRUE(said) << extra;
  }
}

}  // namespace
}  // namespace ambf::runtime
