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

// Half the weight of a body, upwards.
class HalfWeight final : public model::Law {
 public:
  math::Wrench act(const physics::Body& body, double) override { return {body.gravity() * (-0.5 * body.mass()), {}}; }
};

TEST(LocalSimulation, HoldsAndPushesBodies) {
  Local local;
  const state::ObjectId box = local.id("BODY box");
  const auto share = [&](state::Source source) {
    for (const state::LawShare& each : local.simulation.frame().law_shares)
      if (each.source == source) return each.wrench_world.force.z;
    return 0.0;
  };
  HalfWeight lift;
  ASSERT_TRUE(local.simulation.hold(box, state::Source::device_0, lift));
  state::Push push;
  push.force_world = {0, 0, 2};
  push.seconds = 0.002;
  ASSERT_TRUE(local.simulation.push(box, push).success);
  ASSERT_TRUE(local.simulation.step(2));
  EXPECT_NEAR(share(state::Source::device_0), 0.5 * 9.81, 1e-9);
  EXPECT_EQ(share(state::Source::panel), 2.0);
  local.simulation.let_go(box, state::Source::device_0);
  ASSERT_TRUE(local.simulation.step());
  EXPECT_TRUE(local.simulation.frame().law_shares.empty());
  push.seconds = -1.0;
  EXPECT_FALSE(local.simulation.push(box, push).success);
  EXPECT_FALSE(local.simulation.push(local.id("BODY floor"), {{0, 0, 1}, {}, {}, 0.1}).success) << "it is static";
}

TEST(LocalSimulation, SetsParametersAndParents) {
  Local local;
  const state::ObjectId box = local.id("BODY box");
  ASSERT_TRUE(local.simulation.set_parameter(box, state::Parameter::friction, {0.7, 0.7, 0.7}).success);
  EXPECT_FALSE(local.simulation.set_parameter(box, state::Parameter::friction, {-1, -1, -1}).success);
  state::LoadRequest request;
  request.text =
      "cameras: [CAMERA eye]\nCAMERA eye: {name: eye, location: {x: 2, y: 0, z: 1}, look at: {x: 0, y: 0, z: 1}, "
      "up: {x: 0, y: 0, z: 1}, clipping plane: {near: 0.01, far: 10}, field view angle: 0.8}\n";
  ASSERT_TRUE(local.simulation.load(request).success);
  const auto structure = local.simulation.structure();
  const std::uint32_t eye = state::find(*structure, "CAMERA eye", state::ObjectKind::camera);
  ASSERT_NE(eye, state::kNone);
  ASSERT_TRUE(local.simulation.set_parent(structure->objects[eye].id, "BODY box").success);
  ASSERT_TRUE(local.simulation.step());
  const state::Frame& frame = local.simulation.frame();
  const auto& box_row =
      frame.structure->objects[state::find(*frame.structure, "BODY box", state::ObjectKind::rigid_body)];
  EXPECT_EQ(state::value_of(frame.body_parameters[box_row.slot], state::Parameter::friction).x, 0.7);
  EXPECT_EQ(frame.structure->cameras[frame.structure->objects[eye].slot].parent_name, "BODY box");
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
