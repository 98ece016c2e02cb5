// The scenes of touch do what docs/models.md says of them: what hangs on rays stays where it is, a magnet carries up to
// its strength, a door knows when it is shut, ghosts feel, and a box on rays sticks and slips.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "state/ghosts.h"
#include "state/sensors.h"
#include "tests/runtime/model_rig.h"

namespace ambf::runtime {
namespace {

using namespace test;
using state::JointCommandType;
using Targets = std::vector<std::pair<std::string, double>>;

struct Touch : testing::Test {
  // Loaded without a warning.
  void open(const std::string& scene, const std::string& folder = "touch/") {
    const state::Outcome outcome = rig.load(own_model(folder + scene + ".yaml"));
    ASSERT_TRUE(outcome.success) << outcome.message;
    for (const base::Diagnostic& found : outcome.diagnostics)
      if (found.severity != base::Severity::information) ADD_FAILURE() << base::to_string(found);
  }
  void run(double seconds) { ASSERT_TRUE(rig.run(seconds).success); }
  // Joints keep their last target (`hold`).
  void joints_to(const std::string& base, const Targets& targets, double seconds) {
    ASSERT_TRUE(rig.step(1, {rig.joint_command(base, JointCommandType::position, targets)}).success);
    run(seconds);
  }
  void push(const std::string& body, const math::Vec3& force_world, double seconds) {
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::force;
    command.wrench_world.force = force_world;
    for (double t = 0.0; t < seconds - 1e-9; t += 0.1) ASSERT_TRUE(rig.step(100, {{rig.id(body), command}}).success);
    ASSERT_TRUE(rig.step(1, {{rig.id(body), state::RigidBodyCommand{}}}).success);
  }
  std::uint32_t sensor(const std::string& name) {
    const auto structure = rig.simulation.structure();
    const std::uint32_t index = state::find(*structure, name, state::sensor_kind().kind);
    EXPECT_NE(index, state::kNone) << name;
    return index == state::kNone ? 0 : structure->objects[index].slot;
  }
  bool success(const std::string& name) {
    const std::uint32_t slot = sensor(name);
    return state::rows(rig.frame(), state::sensor_kind().column).at(slot).success;
  }
  math::Vec3 at(const std::string& body) { return rig.body(body).T_world_body.position; }
  // Of `held` in the frame of `holder`.
  math::Pose held(const std::string& holder, const std::string& held) {
    return math::inverse(rig.body(holder).T_world_body) * rig.body(held).T_world_body;
  }
  ModelRig rig{own_world()};
};

// Benchmarks 6.9 and Table 6.2: held off-centre and by compound shapes, slip below the contact area (1 mm); let go, the
// rod falls.
TEST_F(Touch, RaysAloneHoldARodOffCentreAndACompoundHammer) {
  open("grasps");
  rig.log.expect_warning("rays_a': of its friction on '/ambf/env/grasps/rod' counts static 1000 as");
  rig.log.expect_warning("rays_b': of its friction on '/ambf/env/grasps/rod' counts static 1000 as");
  rig.log.expect_warning("rays_a': of its friction on '/ambf/env/grasps/hammer' counts static 1000 as");
  rig.log.expect_warning("rays_b': of its friction on '/ambf/env/grasps/hammer' counts static 1000 as");
  run(0.5);
  const char* holders[] = {"left_hand_finger_a", "right_hand_finger_a"};
  const char* things[] = {"rod", "hammer"};
  const math::Pose start[] = {held(holders[0], things[0]), held(holders[1], things[1])};
  run(8.0);
  joints_to("stand", {{"left_hand-lift", -0.05}, {"right_hand-lift", 0.05}}, 2.0);
  for (int i = 0; i < 2; ++i) {
    const math::Pose now = held(holders[i], things[i]);
    const double slip = math::norm(now.position - start[i].position);
    const double turn = math::norm(math::log(math::inverse(start[i].orientation) * now.orientation));
    std::printf("%s after 10 s and a lift of 50 mm: slip %.4f mm, turned %.4f rad\n", things[i], slip * 1e3, turn);
    EXPECT_LT(slip, 1e-3) << things[i];
    EXPECT_LT(turn, 0.02) << things[i];
  }
  joints_to("stand", {{"left_hand-a", 0.04}, {"left_hand-b", 0.04}}, 1.0);
  EXPECT_LT(at("rod").z, 0.04) << "it lies on the foot of the stand";
  EXPECT_LT(math::norm(held(holders[1], things[1]).position - start[1].position), 1e-3);
}

TEST_F(Touch, TheMagnetCarriesUpToItsStrength) {
  open("magnet");
  run(0.5);
  joints_to("stand", {{"travel", 0.05}, {"lift", 0.02}}, 3.0);
  const double weight = 9.81 * rig.simulation.structure()->bodies[rig.slot("disc")].mass, strength = 10.0;
  EXPECT_LT(math::norm(held("coil", "disc").position - math::Vec3{0, 0, -0.006}), 1e-3) << "it came along";
  push("disc", {0, 0, -(0.9 * strength - weight)}, 0.5);
  EXPECT_LT(math::norm(held("coil", "disc").position - math::Vec3{0, 0, -0.006}), 1e-3);
  push("disc", {0, 0, -(1.05 * strength - weight)}, 0.4);
  EXPECT_LT(at("disc").z, 0.05) << "pulled off";

  joints_to("stand", {{"travel", 0.11}}, 2.5);
  joints_to("stand", {{"lift", -0.0425}}, 2.5);  // down to the weight
  joints_to("stand", {{"lift", 0.05}}, 2.0);
  EXPECT_NEAR(at("weight").z, 0.0395, 1e-3) << "too heavy";
  joints_to("stand", {{"travel", -0.11}}, 3.0);
  joints_to("stand", {{"lift", -0.085}}, 3.0);
  joints_to("stand", {{"lift", 0.05}}, 2.0);
  EXPECT_GT(at("bar").z, 0.10) << "lifted";
}

TEST_F(Touch, TheDoorKnowsWhenItIsShutAndWhenItIsOpen) {
  open("door");
  run(1.0);
  EXPECT_FALSE(success("door_shut") || success("door_open")) << "ajar";
  EXPECT_NEAR(rig.frame().joints[rig.joint_slot("hinge")].position, 0.8, 1e-3) << "it stays where it was left";
  joints_to("cabinet", {{"hinge", 0.0}}, 2.0);
  EXPECT_TRUE(success("door_shut"));
  EXPECT_FALSE(success("door_open"));
  joints_to("cabinet", {{"hinge", 1.85}}, 2.5);
  EXPECT_FALSE(success("door_shut"));
  EXPECT_TRUE(success("door_open"));
  rig.simulation.reset_world();
  rig.step(1);
  EXPECT_FALSE(success("door_shut") || success("door_open")) << "a reset clears it";
  joints_to("cabinet", {{"hinge", 0.0}}, 2.0);
  EXPECT_TRUE(success("door_shut"));
  ASSERT_TRUE(rig.remove("/ambf/env/door/BODY door").success);
  rig.step(1);
  EXPECT_FALSE(success("door_shut")) << "no door";
}

TEST_F(Touch, GhostsFeelTheNeedleAndStopTheBalls) {
  open("ghost");
  run(0.5);
  for (const char* ball : {"ball_low", "ball_high"}) {
    EXPECT_LT(math::norm(rig.body(ball).twist_world.linear), 0.01) << ball;
    EXPECT_GT(at(ball).z, 0.08) << ball;  // far from the floor
  }
  const auto felt_by = [&](const std::string& ghost) {
    const auto structure = rig.simulation.structure();
    const std::uint32_t index = state::find(*structure, ghost, state::ghost_kind().kind);
    EXPECT_NE(index, state::kNone);
    std::vector<std::string> names;
    for (const state::GhostTouch& touch : state::touches_of(rig.frame(), structure->objects[index].slot))
      names.push_back(structure->objects[touch.object].identifier);
    return names;
  };
  const auto has = [](const std::vector<std::string>& names, const std::string& end) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return name.ends_with(end); });
  };
  EXPECT_TRUE(has(felt_by("filling"), "BODY ball_low"));
  EXPECT_FALSE(has(felt_by("gate"), "BODY needle"));
  state::RigidBodyCommand through;
  through.type = state::CartesianCommandType::position;
  through.T_world_body = rig.body("needle").T_world_body;
  through.T_world_body.position.x -= 0.12;
  for (int i = 0; i < 10; ++i) rig.step(100, {{rig.id("needle"), through}});
  EXPECT_TRUE(has(felt_by("gate"), "BODY needle"));
  EXPECT_FALSE(has(felt_by("tip"), "BODY gate_post")) << "through the middle";
}

// Fig. 6.10: the box on rays settles and does not creep; the other one slides down.
TEST_F(Touch, TheBoxOnRaysStaysOnTheSlope) {
  open("slope");
  const math::Vec3 bare = at("bare");
  run(2.0);
  const math::Vec3 settled = at("sensorized");
  run(8.0);
  const double drift = math::norm(at("sensorized") - settled);
  std::printf("slope of 20 degrees, 8 s: %.6f mm\n", drift * 1e3);
  EXPECT_LT(drift, 0.1e-3);
  EXPECT_GT(math::norm(at("bare") - bare), 0.2);
}

// Benchmark 6.7: a push that grows slowly does not move it below mu_S sigma_a F_N = 4.9 N; above, it takes hold anew
// each contact area (1 mm).
TEST_F(Touch, TheBlockSticksAndSlips) {
  open("stick_slip");
  run(0.5);
  const std::uint32_t feet = sensor("feet");
  int slips = 0;
  double first_slip = 0.0;
  const auto push_and_watch = [&](double force) {
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::force;
    command.wrench_world.force = {0, force, 0};
    rig.step(1, {{rig.id("block"), command}});
    for (const state::SensedElement& element : state::elements_of(rig.frame(), feet)) slips += element.slipped ? 1 : 0;
    if (slips > 0 && first_slip == 0.0) first_slip = force;
  };
  for (int i = 1; i <= 2000; ++i) push_and_watch(6.0 * i / 2000.0);
  EXPECT_NEAR(first_slip, 4.9, 0.1 * 4.9);
  const double begin = at("block").y;
  slips = 0;
  for (int i = 0; i < 1000; ++i) push_and_watch(6.0);
  const double moved = at("block").y - begin, per_slip = moved / (slips / 16.0);
  std::printf("block: slips from %.2f N on, then %.1f mm in 1 s, %.3f mm a slip\n", first_slip, moved * 1e3,
              per_slip * 1e3);
  EXPECT_GT(moved, 10e-3);
  EXPECT_NEAR(per_slip, 1e-3, 0.1e-3);
}

// Benchmark 6.11: the handle turns in the hand that holds loosely, not in the other one, and drives the screw.
TEST_F(Touch, TheHandleTurnsInTheLooseHandAlone) {
  open("screwdriver");
  // Table 6.2's gains are more than steps of 1 ms bear on so light a handle.
  rig.log.expect_warning("main_hand_rays_a': of its friction on '/ambf/env/screwdriver/tool' counts static 5000 as");
  rig.log.expect_warning("main_hand_rays_b': of its friction on '/ambf/env/screwdriver/tool' counts static 5000 as");
  rig.log.expect_warning("helping_hand_rays_a': of its friction on '/ambf/env/screwdriver/tool' counts static 5000 as");
  rig.log.expect_warning("helping_hand_rays_b': of its friction on '/ambf/env/screwdriver/tool' counts static 5000 as");
  constexpr double kFirm = 0.016, kLoose = 0.0238, kDegree = 3.14159265358979 / 180.0;
  const auto grip = [&](const std::string& hand, double opening) {
    joints_to("stand", {{hand + "-a", opening}, {hand + "-b", opening}}, 0.5);
  };
  const auto turn = [&](double from, double to) {
    for (int i = 1; i <= 100; ++i) joints_to("stand", {{"wrist", from + (to - from) * i / 100.0}}, 0.02);
    run(0.5);
  };
  const auto yaw = [&] { return math::to_rpy(rig.body("tool").T_world_body.orientation).z; };
  const auto joint = [&](const std::string& name) { return rig.frame().joints[rig.joint_slot(name)].position; };
  for (const bool drives : {true, false}) {
    grip(drives ? "main_hand" : "helping_hand", kFirm);
    grip(drives ? "helping_hand" : "main_hand", kLoose);
    const double in_helping = yaw(), in_main = yaw() - joint("wrist"), screw = joint("thread");
    turn(drives ? 0.0 : 2.0, drives ? 2.0 : 0.0);
    const double helping = std::abs(yaw() - in_helping), main = std::abs(yaw() - joint("wrist") - in_main);
    std::printf("screwdriver %s: %.2f degrees in the main hand, %.2f in the helping hand\n",
                drives ? "drives" : "goes back", main / kDegree, helping / kDegree);
    EXPECT_GT(drives ? helping : main, 90.0 * kDegree);
    EXPECT_LT(drives ? main : helping, 2.0 * kDegree);
    EXPECT_NEAR(joint("thread") - screw, drives ? 1.8 : 0.0, drives ? 0.25 : 0.05);
  }
}

// Benchmark 6.12: taut round both pegs, drawn through the jaws of the other hand once these hold loosely; joints of 2 g
// links never open by a millimetre.
TEST_F(Touch, TheThreadIsDrawnRoundThePegsAndThroughTheJaws) {
  constexpr double kPegY = 0.024, kRound = 0.010;  // m: of the pegs, and of what lies round them
  constexpr int kLinks = 52;
  open("thread");
  const auto link = [](int k) { return "/ambf/env/thread/link" + std::to_string(k); };
  double gap = 0.0, nearest = 1.0, farthest = 0.0;
  const auto watch = [&](const Targets& targets, double seconds) {
    rig.step(1, {rig.joint_command("stand", JointCommandType::position, targets)});
    nearest = 1.0, farthest = 0.0;
    for (double t = 0.0; t < seconds - 1e-9; t += 0.02) {
      rig.step(20);
      gap = std::max(gap, rig.largest_gap());
      for (int k = 0; k < kLinks; ++k) {
        const math::Vec3 p = at(link(k));
        if (p.x > 0.0 || std::abs(p.y) < kPegY) continue;  // not behind a peg
        const double from_peg = std::hypot(p.x, std::abs(p.y) - kPegY);
        nearest = std::min(nearest, from_peg);
        farthest = std::max(farthest, from_peg);
      }
    }
  };
  const auto tension = [&](const std::string& hand) {  // what its rays hold against, N
    double sum = 0.0;
    for (const char* rays : {"_rays_a", "_rays_b"})
      for (const state::SensedElement& each : state::elements_of(rig.frame(), sensor(hand + rays)))
        sum += each.force_world.x;
    return sum;
  };
  // Whether it passes between the pads, in the frame of a finger.
  const auto in_hand = [&](const std::string& hand) {
    for (int k = 0; k < kLinks; ++k) {
      const math::Vec3 p = held(hand + "_finger_a", link(k)).position;
      if (std::abs(p.x) < 0.010 && p.y < 0.0 && p.y > -0.04 && std::abs(p.z + 0.71 * 0.075) < 0.019) return true;
    }
    return false;
  };
  run(0.3);
  watch({{"left_hand-pull", 0.01}, {"right_hand-pull", 0.01}}, 1.0);
  std::printf("thread, taut: %.2f N and %.2f N, %.3f to %.3f mm from the pegs' axes, gaps up to %.4f mm\n",
              tension("left_hand"), tension("right_hand"), nearest * 1e3, farthest * 1e3, gap * 1e3);
  EXPECT_GT(tension("left_hand"), 0.3);
  EXPECT_GT(tension("right_hand"), 0.3);
  EXPECT_GT(nearest, kRound - 0.2e-3) << "not in a peg";
  EXPECT_LT(farthest, kRound + 1.2e-3) << "it lies round the pegs, with the corners of its links";

  const math::Vec3 before = at(link(26));
  EXPECT_LT(std::abs(before.y), kPegY) << "between the pegs";
  watch({{"left_hand-a", 0.018}, {"left_hand-b", 0.018}}, 0.2);
  for (int i = 1; i <= 10; ++i) watch({{"right_hand-pull", 0.01 + 0.005 * i}}, 0.15);
  run(0.3);
  EXPECT_LT(at(link(26)).y, before.y - 0.02) << "drawn along";
  EXPECT_TRUE(in_hand("left_hand") && in_hand("right_hand"));
  EXPECT_GT(nearest, kRound - 0.2e-3);
  std::printf("thread, drawn: link26 from y = %.1f to %.1f mm, gaps up to %.4f mm\n", before.y * 1e3,
              at(link(26)).y * 1e3, gap * 1e3);
  EXPECT_LT(gap, 1e-3);
}

// The peg board's goals: the right object true; of another kind, beside the peg, on its edge, lifted again false;
// cleared by a reset and when the object is removed.
TEST_F(Touch, GoalsOfThePegBoardKnowTheirObjects) {
  open("peg_transfer", "puzzles/");
  run(0.3);
  const auto hold = [&](const math::Pose& T_world_ring, double seconds) {
    state::RigidBodyCommand command;
    command.type = state::CartesianCommandType::position;
    command.T_world_body = T_world_ring;
    for (double t = 0.0; t < seconds - 1e-9; t += 0.1) rig.step(100, {{rig.id("ring2"), command}});
  };
  const auto let_go = [&] {
    rig.step(1, {{rig.id("ring2"), state::RigidBodyCommand{}}});
    run(1.2);
  };
  const auto done = [&] {
    std::string names;
    for (const char* goal : {"goal7", "goal8", "goal9", "goal10", "goal11", "goal12"})
      if (success(goal)) names += goal;
    return names;
  };
  const auto carry = [&](const math::Vec3& to) {
    const math::Vec3 from = at("ring2");
    hold({{from.x, from.y, 0.09}, {}}, 0.4);
    hold({{to.x, to.y, 0.09}, {}}, 0.4);
    hold({to, {}}, 0.4);
  };
  const math::Vec3 right{-0.030, 0.057, 0.045}, wrong{-0.030, 0.031, 0.045};
  EXPECT_EQ(done(), "");
  carry(wrong);
  let_go();
  EXPECT_LT(at("ring2").z, 0.030) << "it lies on the board";
  EXPECT_EQ(done(), "") << "a ring on a triangle's peg";
  carry({-0.015, 0.044, 0.030});
  let_go();
  EXPECT_EQ(done(), "") << "between pegs";
  carry(right);
  EXPECT_EQ(done(), "") << "not down yet";
  let_go();
  EXPECT_EQ(done(), "goal8");
  hold({{right.x, right.y, 0.036}, {}}, 0.3);
  EXPECT_EQ(done(), "") << "lifted by 7 mm";
  let_go();
  EXPECT_EQ(done(), "goal8");
  carry({right.x, right.y + 0.012, 0.06});
  hold({{right.x, right.y + 0.007, 0.038}, math::from_rpy(1.5708, 0.0, 0.0)}, 0.8);
  EXPECT_EQ(done(), "") << "on its edge";
  carry(right);
  let_go();
  EXPECT_EQ(done(), "goal8");
  rig.simulation.reset_world();
  rig.step(1);
  EXPECT_EQ(done(), "") << "after a reset";
  carry(right);
  let_go();
  EXPECT_EQ(done(), "goal8");
  ASSERT_TRUE(rig.remove("/ambf/env/BODY ring2").success);
  rig.step(1);
  EXPECT_EQ(done(), "") << "without its ring";
}

}  // namespace
}  // namespace ambf::runtime
