// A simulation on the caller's thread: the bits of a Simulation, several side by side, in-place restore.
#include "runtime/local_simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "simulation_rig.h"

namespace ambf::runtime {
namespace {

constexpr unsigned kSteps = 600;  // the box has fallen and rests, the linkage moves

struct Local {
  explicit Local(double torque_y = 0.02) {
    state::LoadRequest request;
    request.text = test::kScene;
    EXPECT_TRUE(simulation.load(request).success);
    port = simulation.bind(id("BODY crank"), state::Source::plugin);
    command.type = state::CartesianCommandType::force;
    command.wrench_world.torque.y = torque_y;
  }
  state::ObjectId id(const std::string& name) {
    const auto structure = simulation.structure();
    return structure->objects.at(state::find(*structure, name, state::ObjectKind::rigid_body)).id;
  }
  void step(unsigned n) {
    for (unsigned i = 0; i < n; ++i) {
      port->post(command);
      ASSERT_TRUE(simulation.step());
    }
  }

  JudgedLog log;
  LocalSimulation simulation{test::free_running(), test::empty_world(), {}, log};
  std::unique_ptr<state::CommandPort> port;
  state::RigidBodyCommand command;
};

using Poses = std::vector<math::Pose>;

Poses poses(const state::Frame& frame) {
  Poses out;
  for (const state::BodyState& body : frame.bodies) out.push_back(body.T_world_body);
  return out;
}

bool same_bits(const Poses& a, const Poses& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const math::Pose& x, const math::Pose& y) {
    return x.position == y.position && x.orientation.w == y.orientation.w && x.orientation.x == y.orientation.x &&
           x.orientation.y == y.orientation.y && x.orientation.z == y.orientation.z;
  });
}

Poses alone(double torque_y) {
  Local local(torque_y);
  local.step(kSteps);
  return poses(local.simulation.frame());
}

TEST(LocalSimulation, GivesTheBitsOfStepRequests) {
  test::Rig rig;
  rig.simulation.begin();
  ASSERT_TRUE(rig.step(kSteps).success);  // it may have run a step or more by itself before the request arrived
  Local local;
  ASSERT_TRUE(local.simulation.step(rig.frame().sim_step));
  EXPECT_EQ(local.simulation.frame().sim_step, rig.frame().sim_step);
  EXPECT_TRUE(same_bits(poses(local.simulation.frame()), poses(rig.frame())));
}

TEST(LocalSimulation, TwoSteppedInterleavedGiveTheBitsOfEachAlone) {
  const Poses weak = alone(0.02), strong = alone(0.05);
  ASSERT_FALSE(same_bits(weak, strong));
  Local a(0.02), b(0.05);
  for (unsigned i = 0; i < kSteps; ++i) {
    a.step(1);
    b.step(1);
  }
  EXPECT_TRUE(same_bits(poses(a.simulation.frame()), weak));
  EXPECT_TRUE(same_bits(poses(b.simulation.frame()), strong));
}

TEST(LocalSimulation, TwoOnThreadsOfTheirOwnGiveTheBitsOfEachAlone) {
  const Poses weak = alone(0.02), strong = alone(0.05);
  Poses a, b;
  std::thread first([&] { a = alone(0.02); });
  std::thread second([&] { b = alone(0.05); });
  first.join();
  second.join();
  EXPECT_TRUE(same_bits(a, weak));
  EXPECT_TRUE(same_bits(b, strong));
}

TEST(LocalSimulation, RestoreContinuesAsAfterTheSnapshot) {
  Local local;
  local.step(200);
  ASSERT_TRUE(local.simulation.snapshot("here").success);
  local.step(200);
  const Poses first = poses(local.simulation.frame());
  const state::Outcome restored = local.simulation.restore("here");
  ASSERT_TRUE(restored.success) << restored.message;
  EXPECT_EQ(local.simulation.frame().sim_step, 200u);
  local.step(200);
  EXPECT_TRUE(same_bits(poses(local.simulation.frame()), first));
}

TEST(LocalSimulation, ARestoredCommandExpiresInTheSameStep) {
  Local local;
  ASSERT_TRUE(local.simulation.step(20));
  local.port->post(local.command);
  ASSERT_TRUE(local.simulation.step(0)) << "taken between two steps";
  ASSERT_TRUE(local.simulation.snapshot("here").success);
  ASSERT_TRUE(local.simulation.step(600));  // the watchdog ends the command after 500
  const Poses first = poses(local.simulation.frame());
  ASSERT_TRUE(local.simulation.restore("here").success);  // directly after a step
  ASSERT_TRUE(local.simulation.step(600));
  EXPECT_TRUE(same_bits(poses(local.simulation.frame()), first));
}

TEST(LocalSimulation, ResetRepeatsTheRun) {
  Local local;
  local.step(100);
  const Poses first = poses(local.simulation.frame());
  local.simulation.reset();
  EXPECT_EQ(local.simulation.frame().sim_step, 0u);
  local.step(100);
  EXPECT_TRUE(same_bits(poses(local.simulation.frame()), first));
}

TEST(LocalSimulation, ChangesOfTheStructureShowInTheNextFrame) {
  Local local;
  ASSERT_TRUE(local.simulation.remove("BODY box").success);
  EXPECT_EQ(state::find(*local.simulation.frame().structure, "BODY box", state::ObjectKind::rigid_body), state::kNone);
  EXPECT_TRUE(local.simulation.step());
  local.log.expect_warning("there is no model \"no such model\"");
  EXPECT_FALSE(local.simulation.unload("no such model").success);
}

}  // namespace
}  // namespace ambf::runtime
