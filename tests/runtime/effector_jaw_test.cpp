// Jaws that devices open and close (EQUATIONS 8): who leads, what survives, momentum, and all of our grippers.
#include <cmath>

#include "adf/adf.h"
#include "effector_rig.h"

namespace ambf::runtime {
namespace {

using namespace test;

constexpr double kLow = -0.2, kHigh = 0.6;

// A palm with two fingers on hinges that are mirrored, and a wheel without limits.
scene::Model gripper() {
  scene::Model model = model::test::model("gripper", {floating_box("palm", 1.0)});
  const auto add = [&](const std::string& name, double y, double axis_x) {
    model.bodies.push_back(floating_box(name, 0.1, {0, y, 0.2}));
    scene::Joint joint = model::test::joint("to_" + name, "palm", name);
    joint.parent_pivot = {0, y, 0.1};
    joint.child_pivot = {0, 0, -0.1};
    joint.parent_axis = joint.child_axis = {axis_x, 0, 0};
    joint.limits = {{kLow, kHigh}};
    joint.controller = {.p = 20.0, .d = 0.5, .output = scene::ControllerOutput::force};
    joint.max_motor_impulse = 1.0;
    model.joints.push_back(joint);
  };
  add("left", 0.2, -1);
  add("right", -0.2, 1);
  add("wheel", 0.6, 1);
  model.joints.back().limits.reset();
  return model;
}

struct JawRig : EffectorRig {
  JawRig() : EffectorRig(gripper()) {}
  double angle(const std::string& finger) const {
    return simulation.frame().joints[slot("to_" + finger, state::ObjectKind::joint)].position;
  }
  const state::JointState& joint(const std::string& finger) const {
    return simulation.frame().joints[slot("to_" + finger, state::ObjectKind::joint)];
  }
  // Where the fingers are commanded to, 0 closed .. 1 open.
  double commanded() const { return (joint("left").commanded - kLow) / (kHigh - kLow); }
  Hand gripping(int device, double jaw) {
    Hand made = hand("palm", device);
    made.set_point.moves_jaw = true;
    made.set_point.jaw = jaw;
    return made;
  }
  // Opens or closes the hand evenly.
  void move(Hand& hand, double to, int steps, Hand* other = nullptr) {
    const double from = hand.set_point.jaw;
    for (int i = 1; i <= steps; ++i) {
      hand.set_point.jaw = from + (to - from) * i / steps;
      hand.post();
      if (other != nullptr) other->post();
      ASSERT_TRUE(simulation.step());
    }
  }
  bool leads(int device) const { return row(device, "palm") != nullptr && row(device, "palm")->leads_jaw; }
};

TEST(Jaw, FollowsTheHandOnceTheyMeet) {
  JawRig rig;
  const double start = -kLow / (kHigh - kLow);  // all joints are at 0
  Hand hand = rig.gripping(0, 0.9);
  rig.move(hand, 0.5, 100);
  EXPECT_FALSE(rig.leads(0)) << "the hand has not been as closed as the jaw yet";
  EXPECT_NE(rig.joint("left").commanded_type, state::JointCommandType::position);
  rig.move(hand, start - 0.1, 100);
  EXPECT_TRUE(rig.leads(0));
  rig.move(hand, 1.0, 200);
  rig.move(hand, 1.0, 1000);
  EXPECT_NEAR(rig.angle("left"), kHigh, 2e-3);
  EXPECT_NEAR(rig.angle("right"), kHigh, 2e-3) << "mirrored axes open together";
  rig.move(hand, 0.0, 200);
  rig.move(hand, 0.0, 1000);
  EXPECT_NEAR(rig.angle("left"), kLow, 2e-3);
  EXPECT_NEAR(rig.angle("right"), kLow, 2e-3);
  EXPECT_NE(rig.joint("wheel").commanded_type, state::JointCommandType::position) << "it has no limits";
}

TEST(Jaw, IsLedByTheHandThatMovedLastWithoutAJump) {
  JawRig rig;
  Hand first = rig.gripping(0, 0.4), second = rig.gripping(1, 0.9);
  double last = -1.0, largest = 0.0;
  const auto move = [&](Hand& hand, double to, Hand& other) {
    const double from = hand.set_point.jaw;
    for (int i = 1; i <= 200; ++i) {
      hand.set_point.jaw = from + (to - from) * i / 200;
      hand.post();
      other.post();
      ASSERT_TRUE(rig.simulation.step());
      if (!rig.leads(0) && !rig.leads(1)) continue;
      if (last >= 0.0) largest = std::max(largest, std::abs(rig.commanded() - last));
      last = rig.commanded();
    }
  };
  move(first, 0.1, second);
  EXPECT_TRUE(rig.leads(0));
  move(second, 0.6, first);
  EXPECT_TRUE(rig.leads(0)) << "the second hand has not met the jaw";
  move(second, 0.05, first);
  EXPECT_TRUE(rig.leads(1));
  EXPECT_FALSE(rig.leads(0));
  EXPECT_NEAR(rig.commanded(), 0.05, 1e-9);
  move(first, 0.0, second);
  EXPECT_TRUE(rig.leads(0));
  EXPECT_LT(largest, 0.025) << "of the way from closed to open, in a step";
}

TEST(Jaw, StaysAsItIsWhenItsDeviceGoesAndComesBack) {
  JawRig rig;
  Hand hand = rig.gripping(0, 0.3);
  rig.move(hand, 0.1, 200);
  ASSERT_TRUE(rig.leads(0));
  hand.port.reset();
  ASSERT_TRUE(rig.simulation.step(700));
  EXPECT_NEAR(rig.commanded(), 0.1, 1e-9) << "a grasp outlives the cable";
  Hand back = rig.gripping(0, 0.8);
  rig.move(back, 0.5, 100);
  EXPECT_NEAR(rig.commanded(), 0.1, 1e-9);
  rig.move(back, 0.05, 100);
  EXPECT_TRUE(rig.leads(0));
  rig.simulation.reset();
  ASSERT_TRUE(rig.simulation.step());
  EXPECT_EQ(rig.joint("left").commanded_type, state::JointCommandType::none) << "as loaded";
}

TEST(Jaw, FollowsTheNewestOfHandAndJointCommand) {
  JawRig rig;
  const auto ros = rig.simulation.bind(rig.id("palm"), state::Source::ros);
  Hand hand = rig.gripping(0, 0.3);
  rig.move(hand, 0.1, 200);
  ASSERT_TRUE(rig.leads(0));
  ros->post(model::test::joints({model::test::to_position(0.5)}));
  rig.move(hand, 0.1, 10);
  EXPECT_FALSE(rig.leads(0));
  EXPECT_EQ(rig.joint("left").commanded, 0.5);
  rig.move(hand, 0.6, 200);  // past the jaw
  EXPECT_TRUE(rig.leads(0));
  EXPECT_NEAR(rig.commanded(), 0.6, 1e-9);
}

TEST(Jaw, IsLeftAloneByDevicesWithoutAGripper) {
  JawRig rig;
  Hand hand = rig.gripping(0, 0.3);
  hand.set_point.moves_jaw = false;
  rig.move(hand, 0.1, 200);
  EXPECT_NE(rig.joint("left").commanded_type, state::JointCommandType::position);
}

// Joints act on both of their bodies alike: a jaw moves nothing as a whole.
TEST(Jaw, KeepsMomentum) {
  JawRig rig;
  Hand hand = rig.gripping(0, 0.25);
  hand.set_point.gains = {};
  rig.move(hand, 0.9, 300);
  ASSERT_TRUE(rig.leads(0));
  math::Vec3 momentum, angular;
  double speed = 0.0;
  const auto& frame = rig.simulation.frame();
  const auto structure = rig.simulation.structure();
  for (std::size_t slot = 0; slot < frame.bodies.size(); ++slot) {
    const state::BodyState& body = frame.bodies[slot];
    const state::BodyInfo& info = structure->bodies[slot];
    momentum += body.twist_world.linear * info.mass;
    const math::Vec3 com = body.T_world_body * info.T_body_com.position;
    angular += math::cross(com, body.twist_world.linear * info.mass) + body.twist_world.angular * info.inertia.x;
    speed = std::max(speed, math::norm(body.twist_world.angular));
  }
  EXPECT_GT(speed, 0.01) << "it moves";
  EXPECT_LT(math::norm(momentum), 1e-10);
  EXPECT_LT(math::norm(angular), 1e-10) << "cubes: the same inertia about every axis";
}

TEST(Jaw, OpensAndClosesAllOfOurGrippers) {
  struct Case {
    const char *file, *body;
    std::vector<const char*> joints;
  };
  const Case cases[] = {{"grippers/two_finger.yaml", "palm", {"palm-finger_a", "palm-finger_b"}},
                        {"puzzles/peg_transfer.yaml", "left_gripper", {"left_gripper-jaw_a", "left_gripper-jaw_b"}},
                        {"puzzles/peg_transfer.yaml", "right_gripper", {"right_gripper-jaw_a", "right_gripper-jaw_b"}}};
  for (const Case& each : cases) {
    EffectorRig rig(std::vector<scene::Body>{});
    state::LoadRequest request;
    request.path = std::string(AMBF_SOURCE_DIR) + "/ambf_models/descriptions/multi-bodies/" + each.file;
    ASSERT_TRUE(rig.simulation.load(request).success);
    const auto structure = rig.simulation.structure();
    const auto slot_of = [&](const std::string& name, state::ObjectKind kind) {
      return structure->objects.at(state::find(*structure, name, kind)).slot;
    };
    const std::uint32_t body = slot_of(std::string("BODY ") + each.body, state::ObjectKind::rigid_body);
    Hand hand;
    hand.port = rig.simulation.hold(structure->objects[structure->bodies[body].object].id, state::Source::device_0);
    ASSERT_NE(hand.port, nullptr);
    hand.set_point.T_world_ref = rig.simulation.frame().bodies[body].T_world_body;
    hand.set_point.T_world_ref.position.z += 0.1;  // clear of everything
    hand.set_point.gains = {{100, 100, 100}, {2, 2, 2}, {0.1, 0.1, 0.1}, {0.002, 0.002, 0.002}};
    hand.set_point.pulls = hand.set_point.engaged = hand.set_point.moves_jaw = true;
    const auto move = [&](double to, int steps) {
      const double from = hand.set_point.jaw;
      for (int i = 1; i <= steps; ++i) {
        hand.set_point.jaw = from + (to - from) * i / steps;
        hand.post();
        ASSERT_TRUE(rig.simulation.step());
      }
    };
    const auto expect_opening = [&](double opening) {
      for (const char* name : each.joints) {
        const std::uint32_t joint = slot_of(std::string("JOINT ") + name, state::ObjectKind::joint);
        const state::JointInfo& info = structure->joints[joint];
        EXPECT_NEAR((rig.simulation.frame().joints[joint].position - info.lower) / (info.upper - info.lower), opening,
                    0.05)
            << each.file << " " << name;
      }
    };
    move(1.0, 300);
    move(1.0, 500);
    expect_opening(1.0);
    move(0.0, 300);
    move(0.0, 500);
    expect_opening(0.0);
  }
}

}  // namespace
}  // namespace ambf::runtime
