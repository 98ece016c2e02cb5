// Who holds a body, and how long: shared axes (EQUATIONS 7), ends of holds, resets, snapshots, threads.
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

#include "effector_rig.h"
#include "state/columns.h"

namespace ambf::runtime {
namespace {

using namespace test;

void post_all(std::initializer_list<Hand*> hands) {
  for (Hand* hand : hands) hand->post();
}

TEST(EffectorSharing, OfTwoEqualDevicesTheBodyIsInTheMiddle) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand left = rig.hand("tool", 0), right = rig.hand("tool", 1);
  left.set_point.T_world_ref.position += {0, -0.05, 0};
  right.set_point.T_world_ref.position += {0, 0.05, 0.02};
  for (int i = 0; i < 2000; ++i) {
    post_all({&left, &right});
    ASSERT_TRUE(rig.simulation.step());
  }
  expect_near(rig.position("tool"), {0, 0, 0.01}, 1e-5);
  // What one feels of the other has the sign of the difference between their references.
  EXPECT_GT(rig.share(1, "tool")->force.y, 1.0);
  EXPECT_LT(rig.share(0, "tool")->force.y, -1.0);
}

// So that nothing swings for long.
void damp(std::initializer_list<Hand*> hands) {
  for (Hand* hand : hands) hand->set_point.gains.linear_damping = {40, 40, 40};
}

// A partner that moves by 10 cm in 0.5 s.
void move_10_cm(EffectorRig& rig, Hand& mover, Hand& other) {
  for (int i = 1; i <= 1000; ++i) {
    mover.set_point.T_world_ref.position.x = 0.1 * std::min(1.0, i / 500.0);
    post_all({&mover, &other});
    ASSERT_TRUE(rig.simulation.step());
  }
}

TEST(EffectorSharing, AClutchedDeviceGivesWayAndEngagesWithoutAJump) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand clutched = rig.hand("tool", 0), mover = rig.hand("tool", 1);
  damp({&clutched, &mover});
  for (int i = 0; i < 100; ++i) {
    post_all({&clutched, &mover});
    ASSERT_TRUE(rig.simulation.step());
  }
  clutched.set_point.engaged = false;
  move_10_cm(rig, mover, clutched);
  EXPECT_NEAR(rig.position("tool").x, 0.1, 1e-3) << "all of its partner's motion, not half";
  EXPECT_EQ(math::norm(rig.share(0, "tool")->force), 0.0);
  expect_near(rig.row(0, "tool")->T_world_ref.position, rig.pose("tool").position, 1e-4, "its reference follows");

  const math::Vec3 before = rig.position("tool");
  clutched.set_point.engaged = true;
  clutched.set_point.T_world_ref = rig.row(0, "tool")->T_world_ref;
  double moved = 0.0;
  for (int i = 0; i < 300; ++i) {
    post_all({&clutched, &mover});
    ASSERT_TRUE(rig.simulation.step());
    moved = std::max(moved, math::norm(rig.position("tool") - before));
  }
  EXPECT_LT(moved, 1e-4);
  EXPECT_GT(rig.row(0, "tool")->gains.linear_stiffness.x, 0.0);
}

TEST(EffectorSharing, TheLastClutchedDeviceKeepsTheBodyWhereItIs) {
  scene::Body body = floating_box("tool", 1.0);
  body.gravity = math::Vec3{0, 0, -9.81};
  EffectorRig rig({body});
  Hand first = rig.hand("tool", 0), second = rig.hand("tool", 1);
  for (int i = 0; i < 1000; ++i) {
    post_all({&first, &second});
    ASSERT_TRUE(rig.simulation.step());
  }
  first.set_point.engaged = false;
  move_10_cm(rig, second, first);
  second.set_point.engaged = false;  // both are clutched now
  const math::Vec3 before = rig.position("tool");
  double moved = 0.0;
  for (int i = 0; i < 1000; ++i) {
    post_all({&first, &second});
    ASSERT_TRUE(rig.simulation.step());
    moved = std::max(moved, std::abs(rig.position("tool").x - before.x));
  }
  EXPECT_LT(moved, 1e-3) << "the first one's reference was where the body was";
  EXPECT_GT(rig.share(1, "tool")->force.z, 3.0) << "it still carries the body";
}

// Gains go from one device to the other and back: 2 a K and 2 (1 - a) K, whose sum is constant.
TEST(EffectorSharing, DominanceThatPassesFromHandToHandMovesNothing) {
  scene::Body body = floating_box("tool", 1.0);
  body.gravity = math::Vec3{0, 0, -9.81};
  EffectorRig rig({body});
  Hand first = rig.hand("tool", 0), second = rig.hand("tool", 1);
  damp({&first, &second});
  const state::EffectorGains file = first.set_point.gains;
  math::Vec3 start;
  double moved = 0.0, min_share = 1e9, max_share = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double a = i < 1000 ? 0.5 : 0.5 + 0.5 * std::sin(1e-3 * std::numbers::pi * (i - 1000));
    const auto scaled = [&](double by) {
      state::EffectorGains gains = file;
      gains.linear_stiffness = gains.linear_stiffness * by;
      gains.linear_damping = gains.linear_damping * by;
      return gains;
    };
    first.set_point.gains = scaled(2.0 * a);
    second.set_point.gains = scaled(2.0 * (1.0 - a));
    post_all({&first, &second});
    ASSERT_TRUE(rig.simulation.step());
    if (i == 999) start = rig.position("tool");
    if (i < 1000) continue;
    moved = std::max(moved, math::norm(rig.position("tool") - start));
    min_share = std::min(min_share, rig.share(0, "tool")->force.z);
    max_share = std::max(max_share, rig.share(0, "tool")->force.z);
  }
  EXPECT_LT(moved, 1e-4);
  EXPECT_LT(min_share, 0.1) << "the other one carried all";
  EXPECT_GT(max_share, 9.7) << "and this one";
}

TEST(EffectorSharing, OnlyAxesOfThePartnerAreGivenUp) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand clutched = rig.hand("tool", 0), partner = rig.hand("tool", 1);
  partner.set_point.gains.linear_stiffness = {500, 0, 0};
  partner.set_point.gains.linear_damping = {10, 0, 0};
  partner.set_point.gains.angular_stiffness = {0, 2, 0};
  partner.set_point.gains.angular_damping = {};
  clutched.set_point.T_world_ref.position += {0, 0.01, 0};
  clutched.set_point.engaged = false;
  post_all({&clutched, &partner});
  ASSERT_TRUE(rig.simulation.step());
  const state::EffectorGains& left = rig.row(0, "tool")->gains;
  EXPECT_EQ(left.linear_stiffness, (math::Vec3{0, 500, 500}));
  EXPECT_EQ(left.angular_stiffness, (math::Vec3{2, 0, 2}));
  EXPECT_NEAR(rig.share(0, "tool")->force.y, 5.0, 1e-9);
}

TEST(EffectorSharing, APoseCommandIsAPartner) {
  scene::Body body = floating_box("tool", 1.0);
  body.linear = {{300, 300, 0}, {}, {20, 20, 0}, scene::ControllerOutput::force};
  EffectorRig rig({body});
  const auto ros = rig.simulation.bind(rig.id("tool"), state::Source::ros);
  Hand hand = rig.hand("tool");
  hand.set_point.engaged = false;
  for (int i = 0; i < 1000; ++i) {
    ros->post(model::test::pose({kCentre + math::Vec3{0.1, 0, 0}, {}}));
    hand.post();
    ASSERT_TRUE(rig.simulation.step());
  }
  EXPECT_NEAR(rig.position("tool").x, 0.1, 1e-3);
  EXPECT_EQ(rig.row(0, "tool")->gains.linear_stiffness, (math::Vec3{0, 0, 500}));
}

TEST(EffectorHolds, EndWithThePortByReleaseAndInSilence) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand hand = rig.hand("tool");
  const auto expect_held = [&](bool held, const char* why) {
    ASSERT_TRUE(rig.simulation.step());
    EXPECT_EQ(rig.row(0, "tool") != nullptr, held) << why;
    EXPECT_EQ(rig.share(0, "tool").has_value(), held) << why;
  };
  expect_held(false, "nothing was posted");
  hand.at({0.01, 0, 0});
  expect_held(true, "posted");
  EXPECT_EQ(rig.row(0, "tool")->first_step, rig.simulation.frame().sim_step);
  EXPECT_GT(rig.row(0, "tool")->applied_ns, 0);
  hand.port->let_go();
  expect_held(false, "let go");
  hand.at({0.01, 0, 0});
  ASSERT_TRUE(rig.simulation.step(480));
  expect_held(true, "within the watchdog's time");
  ASSERT_TRUE(rig.simulation.step(40));
  expect_held(false, "silent");
  hand.post();
  expect_held(true, "again");
  Hand newer = rig.hand("tool");
  hand.post();
  expect_held(false, "there is a newer port of this device");
  newer.post();
  expect_held(true, "the newer port");
  newer.port.reset();
  expect_held(false, "the port ended");
}

TEST(EffectorHolds, RefuseWhatCannotBeHeld) {
  EffectorRig rig({floating_box("tool", 1.0), floating_box("block", 0.0, {0, 1, 0})});
  EXPECT_EQ(rig.simulation.hold(rig.id("block"), state::Source::device_0), nullptr) << "it is static";
  EXPECT_EQ(rig.simulation.hold({}, state::Source::device_0), nullptr);
  std::vector<std::unique_ptr<state::EffectorPort>> ports;
  for (std::size_t i = 0; i < base::kMaxEffectors; ++i)
    ports.push_back(rig.simulation.hold(rig.id("tool"), state::Source::device_0));
  EXPECT_NE(ports.back(), nullptr);
  EXPECT_EQ(rig.simulation.hold(rig.id("tool"), state::Source::device_0), nullptr) << "no room";
  ports.clear();

  Hand hand = rig.hand("tool");
  const state::SetPoint good = hand.set_point;
  const auto expect_ignored = [&](auto spoil) {
    hand.set_point = good;
    spoil(hand.set_point);
    hand.post();
    ASSERT_TRUE(rig.simulation.step());
    EXPECT_EQ(rig.row(0, "tool"), nullptr);
  };
  expect_ignored([](state::SetPoint& set_point) { set_point.T_world_ref.position.x = NAN; });
  expect_ignored([](state::SetPoint& set_point) { set_point.T_world_ref.orientation.w = 2.0; });
  expect_ignored([](state::SetPoint& set_point) { set_point.gains.linear_damping.y = -1.0; });
  expect_ignored([](state::SetPoint& set_point) { set_point.jaw = NAN; });
  expect_ignored([](state::SetPoint& set_point) { set_point.period_s = -1.0; });
}

TEST(EffectorHolds, OutliveOtherBodiesAndEndWithTheirOwn) {
  EffectorRig rig({floating_box("other", 1.0, {1, 0, 0}), floating_box("tool", 1.0)});
  Hand of_other = rig.hand("other"), hand = rig.hand("tool", 1);
  post_all({&of_other, &hand});
  ASSERT_TRUE(rig.simulation.step());
  ASSERT_EQ(rig.simulation.frame().effectors.size(), 2u);
  ASSERT_TRUE(rig.simulation.remove("/test/other").success);
  post_all({&of_other, &hand});
  ASSERT_TRUE(rig.simulation.step());
  ASSERT_EQ(rig.simulation.frame().effectors.size(), 1u);
  EXPECT_NE(rig.row(1, "tool"), nullptr);
}

TEST(EffectorHolds, ASetPointOfTheTimeBeforeAResetPullsNothing) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand hand = rig.hand("tool");
  for (int i = 0; i < 500; ++i) {
    hand.at({0.1, 0, 0});
    ASSERT_TRUE(rig.simulation.step());
  }
  rig.simulation.reset();
  hand.post();
  ASSERT_TRUE(rig.simulation.step());
  EXPECT_EQ(rig.position("tool"), math::Vec3{});
  EXPECT_TRUE(rig.simulation.frame().effectors.empty());
  hand.set_point.epoch = rig.simulation.frame().epoch;
  hand.post();
  ASSERT_TRUE(rig.simulation.step());
  EXPECT_GT(rig.position("tool").x, 0.0);
}

// Two devices of different rates, one of which clutches, on a body that a snapshot finds on its way.
TEST(EffectorHolds, ASnapshotRepeatsARunBitForBit) {
  EffectorRig rig({floating_box("tool", 1.0)});
  Hand fast = rig.hand("tool", 0), slow = rig.hand("tool", 1);
  slow.set_point.period_s = 0.01;
  const auto run = [&](int from, int to) {
    std::vector<std::uint64_t> hashes;
    for (int i = from; i < to; ++i) {
      fast.set_point.epoch = slow.set_point.epoch = rig.simulation.frame().epoch;
      fast.set_point.engaged = i < 130 || i > 160;
      fast.set_point.sample = slow.set_point.sample = static_cast<std::uint64_t>(i);  // a repeat repeats these, too
      fast.at({1e-4 * i, 0, 0});
      if (i % 10 == 0) slow.at({0, 2e-4 * i, 0});
      EXPECT_TRUE(rig.simulation.step());
      hashes.push_back(state::state_hash(rig.simulation.frame()));
    }
    return hashes;
  };
  run(0, 105);
  ASSERT_TRUE(rig.simulation.snapshot("here").success);
  const auto first = run(105, 300);
  for (int repeat = 0; repeat < 2; ++repeat) {
    const state::Outcome restored = rig.simulation.restore("here");
    ASSERT_TRUE(restored.success) << restored.message;
    EXPECT_EQ(rig.simulation.frame().effectors.size(), 2u);
    EXPECT_EQ(run(105, 300), first);
  }
  ASSERT_TRUE(rig.simulation.restore("here").success);
  ASSERT_TRUE(rig.simulation.step(600));
  EXPECT_TRUE(rig.simulation.frame().effectors.empty()) << "nobody posts: the watchdog ends what was restored";
}

// Ports come, post and go on threads of their own while bodies are removed and loaded.
TEST(EffectorHolds, PortsPostWhileBodiesComeAndGo) {
  Rig rig;
  rig.simulation.begin();
  const char* scene =
      "bodies: [BODY tool]\nnamespace: /test/\n"
      "BODY tool: {name: tool, mass: 1, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: "
      "BOX,\n"
      "  geometry: {x: 0.1, y: 0.1, z: 0.1}, location: {position: {x: 2, y: 2, z: 2}, orientation: {r: 0, p: 0, y: "
      "0}}}\n";
  std::atomic<bool> stop{false};
  std::atomic<int> posts{0};
  const auto device = [&](int number) {
    state::SetPoint set_point;
    set_point.gains = thesis_gains();
    set_point.T_world_ref.position = {2, 2, 2};
    set_point.pulls = set_point.engaged = true;
    while (!stop) {
      const auto structure = rig.simulation.structure();
      const std::uint32_t object = state::find(*structure, "/test/tool", state::ObjectKind::rigid_body);
      if (object == state::kNone) continue;
      const auto source = static_cast<state::Source>(static_cast<int>(state::Source::device_0) + number);
      const auto port = rig.simulation.hold(structure->objects[object].id, source);
      for (int i = 0; i < 50 && port != nullptr; ++i, ++posts) port->post(set_point);
    }
  };
  std::thread first(device, 0), second(device, 0), third(device, 1);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(rig.load(scene).success);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::promise<state::Outcome> removed;
    rig.simulation.remove("/test/tool", [&](const state::Outcome& outcome) { removed.set_value(outcome); });
    ASSERT_TRUE(removed.get_future().get().success);
  }
  stop = true;
  for (std::thread* thread : {&first, &second, &third}) thread->join();
  EXPECT_GT(posts.load(), 100);
  ASSERT_TRUE(rig.step(5).success);
  EXPECT_TRUE(rig.frame().effectors.empty());
}

}  // namespace
}  // namespace ambf::runtime
