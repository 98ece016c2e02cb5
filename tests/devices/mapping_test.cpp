// The 17 frames: tests 1-7 of section 4 of the equation sheet, with random hands, tools and cameras.
#include "devices/mapping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/devices/mapping_variants.h"
#include "tests/devices/random_motion.h"

namespace ambf::devices::testing {
namespace {

using math::Pose;
using math::Quat;
using math::Vec3;

constexpr double kPi = 3.14159265358979323846;

// How far a mapping is from what a user expects, over a run: 0 for the right one.
struct Errors {
  double held_m = 0.0, held_rad = 0.0;      // REF while a clutch is held
  double moved_m = 0.0, moved_rad = 0.0;    // REF against the hand's motion while engaged
  double camera_m = 0.0, camera_rad = 0.0;  // CAM-CL against the hand's motion

  double max() const { return std::max({held_m, held_rad, moved_m, moved_rad, camera_m, camera_rad}); }
};

// Presses, scalings, cameras turned by others and by this device, at random.
template <class SomeMapping>
Errors run_random(SomeMapping& mapping, unsigned seed, int ticks) {
  RandomMotion random(seed);
  MappingInput in;
  in.T_u_iid = random.pose(0.2);
  in.T_world_cam = random.pose();
  in.workspace_scaling = 5.0;
  mapping.start_at(random.pose());
  mapping.tick(in);
  Errors errors;
  for (int i = 0; i < ticks; ++i) {
    const MappingInput before = in;
    const Pose ref = mapping.frames().T_world_ref, camera = mapping.frames().T_world_cam_cl;
    in.T_u_iid = random.moved(in.T_u_iid, 1e-3, 1e-2);
    if (random.chance(0.01)) in.clutch = !in.clutch;
    if (random.chance(0.01)) in.camera_clutch = !in.camera_clutch;
    if (random.chance(0.005)) in.camera_lock = !in.camera_lock;
    if (random.chance(0.005)) in.workspace_scaling = random.uniform(0.5, 10.0);
    const bool was_moving = before.camera_clutch && before.camera_lock;
    if (was_moving) {
      in.T_world_cam = camera;
    } else if (random.chance(0.02)) {
      in.T_world_cam = random.pose();
    }
    mapping.tick(in);

    const Pose& now = mapping.frames().T_world_ref;
    const Quat& Rc = in.T_world_cam.orientation;
    const Vec3 hand_moved = in.T_u_iid.position - before.T_u_iid.position;
    const Vec3 hand_turned = math::log(in.T_u_iid.orientation * inverse(before.T_u_iid.orientation));
    if (in.clutch || in.camera_clutch) {
      errors.held_m = std::max(errors.held_m, norm(now.position - ref.position));
      errors.held_rad = std::max(errors.held_rad, angle_between(now.orientation, ref.orientation));
    } else {
      const Vec3 moved = in.workspace_scaling * rotate(Rc, hand_moved);
      const Vec3 turned = rotate(Rc, hand_turned);
      errors.moved_m = std::max(errors.moved_m, norm(now.position - ref.position - moved));
      errors.moved_rad =
          std::max(errors.moved_rad, norm(math::log(now.orientation * inverse(ref.orientation)) - turned));
    }
    if (was_moving && in.camera_clutch && in.camera_lock) {
      const Pose& wanted = mapping.frames().T_world_cam_cl;
      const Vec3 moved = in.camera_scaling * rotate(camera.orientation, hand_moved);
      errors.camera_m = std::max(errors.camera_m, norm(wanted.position - camera.position - moved));
      const Quat& before_press = mapping.frames().T_world_cam_pre_cl.orientation;
      const Vec3 turned = rotate(before_press, hand_turned);
      // The variants do not publish CAM-PRE-CL: they are judged by the angle alone.
      const double turned_by = norm(math::log(wanted.orientation * inverse(camera.orientation)));
      errors.camera_rad = std::max(errors.camera_rad, std::abs(turned_by - norm(turned)));
    }
  }
  return errors;
}

TEST(Mapping, HoldsOverARandomRunOf20000Ticks) {
  Mapping mapping;
  const Errors errors = run_random(mapping, 4, 20000);
  EXPECT_LT(errors.held_m, 1e-15);
  EXPECT_LT(errors.held_rad, 1e-14);
  EXPECT_LT(errors.moved_m, 1e-14);
  EXPECT_LT(errors.moved_rad, 1e-13);
  EXPECT_LT(errors.camera_m, 1e-12);
  EXPECT_LT(errors.camera_rad, 1e-12);
}

// The tests above and below recognise each of the printed mistakes.
class PrintedRow : public ::testing::TestWithParam<Printed> {};

// Test 4's measure, for any mapping: the camera's pitch about its own y while a tilted hand pitches about U's y.
template <class SomeMapping>
double pitch_error_of_a_tilted_hand(SomeMapping& mapping) {
  MappingInput in;
  in.T_world_cam = {{1.0, 2.0, 3.0}, math::from_rpy(0.3, -0.8, 2.0)};
  in.T_u_iid.orientation = math::from_axis_angle({1.0, 0.0, 0.0}, kPi / 2.0);
  mapping.start_at({});
  mapping.tick(in);
  in.camera_clutch = in.camera_lock = true;
  constexpr double kPitch = 0.4;
  in.T_u_iid.orientation = math::from_axis_angle({0.0, 1.0, 0.0}, kPitch) * in.T_u_iid.orientation;
  mapping.tick(in);
  const Quat expected = in.T_world_cam.orientation * math::from_axis_angle({0.0, 1.0, 0.0}, kPitch);
  return angle_between(expected, mapping.frames().T_world_cam_cl.orientation);
}

TEST_P(PrintedRow, IsFoundOut) {
  MappingVariant run(GetParam()), tilted(GetParam());
  const double error = std::max(run_random(run, 4, 2000).max(), pitch_error_of_a_tilted_hand(tilted));
  if (GetParam() == Printed::nothing) {
    EXPECT_LT(error, 1e-11);
  } else {
    EXPECT_GT(error, 1e-3);
  }
}
constexpr const char* kPrinted[] = {"Nothing", "Row2", "Row9", "Row10", "NoReanchoring"};
INSTANTIATE_TEST_SUITE_P(All, PrintedRow,
                         ::testing::Values(Printed::nothing, Printed::row_2, Printed::row_9, Printed::row_10,
                                           Printed::no_reanchoring),
                         [](const auto& parameter) { return kPrinted[static_cast<int>(parameter.param)]; });

// Where a world point is in a picture: x to the right, y up, by the distance along the view.
struct Pixel {
  double x, y, distance;
};
Pixel project(const Pose& T_world_cam, const Vec3& point_world) {
  const Vec3 p = inverse(T_world_cam) * point_world;
  return {p.y / -p.x, p.z / -p.x, -p.x};
}

// A tool in sight of a camera, and a hand, engaged.
struct User {
  explicit User(RandomMotion& random, const Pose& T_world_tool) {
    // The tool is 2 m in front of the camera, a little off its axis.
    in.T_world_cam.orientation = random.rotation();
    const Vec3 tool_in_camera{-2.0, random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
    in.T_world_cam.position = T_world_tool.position - rotate(in.T_world_cam.orientation, tool_in_camera);
    in.T_u_iid = random.pose(0.2);
    in.workspace_scaling = random.uniform(1.0, 10.0);
    mapping.start_at(T_world_tool);
    mapping.tick(in);
  }

  void move(const Vec3& hand_u) {
    in.T_u_iid.position += hand_u;
    mapping.tick(in);
  }
  Pixel tool() const { return project(in.T_world_cam, mapping.frames().T_world_ref.position); }

  MappingInput in;
  Mapping mapping;
};

TEST(Mapping, HandAndPictureAgreeForRandomCamerasAndTools) {
  RandomMotion random(3);
  for (int i = 0; i < 100; ++i) {
    User user(random, random.pose());
    const Pixel start = user.tool();
    user.move({0.0, 0.01, 0.0});
    ASSERT_GT(user.tool().x, start.x + 1e-3);
    user.move({0.0, -0.01, 0.01});
    ASSERT_GT(user.tool().y, start.y + 1e-3);
    user.move({0.01, 0.0, -0.01});
    ASSERT_LT(user.tool().distance, start.distance - 1e-3);

    // Rolled clockwise, as seen along -x of U: a tip to the tool's right in the picture goes down.
    const Pose ref = user.mapping.frames().T_world_ref;
    const Vec3 tip = inverse(ref) * (ref.position + rotate(user.in.T_world_cam.orientation, Vec3{0.0, 0.1, 0.0}));
    const Pixel tip_before = project(user.in.T_world_cam, ref * tip);
    user.in.T_u_iid.orientation = math::from_axis_angle({-1.0, 0.0, 0.0}, 0.2) * user.in.T_u_iid.orientation;
    user.mapping.tick(user.in);
    const Pixel tip_after = project(user.in.T_world_cam, user.mapping.frames().T_world_ref * tip);
    ASSERT_LT(tip_after.y, tip_before.y - 1e-3);
  }
}

TEST(Mapping, TwoUsersEachSeeTheirOwnRight) {
  RandomMotion random(11);
  for (int i = 0; i < 20; ++i) {
    const Pose tool = random.pose();
    User one(random, tool), two(random, tool);
    const Pixel one_before = one.tool(), two_before = two.tool();
    one.move({0.0, 0.01, 0.0});
    two.move({0.0, 0.01, 0.0});
    EXPECT_GT(one.tool().x, one_before.x);
    EXPECT_GT(two.tool().x, two_before.x);
    // The first user's camera is turned by the second one, who holds its lock: no REF moves.
    const Pose ref = one.mapping.frames().T_world_ref;
    one.in.T_world_cam.orientation = random.rotation();
    one.mapping.tick(one.in);
    EXPECT_LT(norm(one.mapping.frames().T_world_ref.position - ref.position), 1e-15);
    EXPECT_LT(angle_between(one.mapping.frames().T_world_ref.orientation, ref.orientation), 1e-14);
  }
}

TEST(Mapping, ATiltedHandPitchesTheCameraAboutItsOwnAxis) {
  Mapping mapping;
  EXPECT_LT(pitch_error_of_a_tilted_hand(mapping), 1e-14);
}

TEST(Mapping, EachCameraOfADeviceMovesInItsOwnAxes) {
  RandomMotion random(5);
  const Pose first = random.pose(), second = random.pose(), hand = random.pose(0.2);
  CameraClutch cameras[2];
  const Pose* poses[] = {&first, &second};
  for (int i = 0; i < 2; ++i) cameras[i].tick(*poses[i], hand, hand, 10.0, false);
  const Pose pushed{hand.position + Vec3{0.0, 0.01, 0.0}, hand.orientation};
  for (int i = 0; i < 2; ++i) {
    cameras[i].tick(*poses[i], pushed, hand, 10.0, true);
    const Vec3 in_camera = rotate(inverse(poses[i]->orientation), cameras[i].pose().position - poses[i]->position);
    EXPECT_LT(norm(in_camera - Vec3{0.0, 0.1, 0.0}), 1e-14);
  }
}

TEST(Mapping, ACameraGoesOnFromWhereOthersMovedIt) {
  RandomMotion random(6);
  Pose camera = random.pose(), hand = random.pose(0.2);
  CameraClutch clutch;
  clutch.tick(camera, hand, hand, 10.0, false);
  camera = random.pose();  // by another source, which holds the lock, while this clutch is pressed
  clutch.tick(camera, hand, hand, 10.0, false);
  const Pose turned{hand.position, math::exp({0.0, 0.1, 0.0}) * hand.orientation};
  clutch.tick(camera, turned, hand, 10.0, true);
  EXPECT_LT(norm(clutch.pose().position - camera.position), 1e-15);
  EXPECT_NEAR(angle_between(clutch.pose().orientation, camera.orientation), 0.1, 1e-12);
}

// The hand's and REF's relation after presses with the hand's motions between them.
Pose relation_after(const std::vector<std::pair<bool, bool>>& presses) {
  RandomMotion random(8);
  MappingInput in;
  in.T_u_iid = random.pose(0.2);
  in.T_world_cam = random.pose();
  in.workspace_scaling = 4.0;
  Mapping mapping;
  mapping.start_at(random.pose());
  mapping.tick(in);
  in.T_u_iid = random.moved(in.T_u_iid, 0.1, 0.5);
  mapping.tick(in);
  for (const auto& [clutch, camera_clutch] : presses) {
    in.clutch = clutch;
    in.camera_clutch = camera_clutch;
    mapping.tick(in);
    in.T_u_iid = random.moved(in.T_u_iid, 0.1, 0.5);
    mapping.tick(in);
  }
  return mapping.frames().T_world_ref;
}

TEST(Mapping, TheOrderOfPressesDoesNotMatter) {
  const std::vector<std::vector<std::pair<bool, bool>>> orders = {
      {{true, false}, {true, true}, {false, true}, {false, false}},
      {{true, false}, {true, true}, {true, false}, {false, false}},
      {{false, true}, {true, true}, {true, false}, {false, false}},
      {{false, true}, {true, true}, {false, true}, {false, false}}};
  const Pose expected = relation_after(orders.front());
  for (const auto& order : orders) {
    const Pose ref = relation_after(order);
    EXPECT_LT(norm(ref.position - expected.position), 1e-14);
    EXPECT_LT(angle_between(ref.orientation, expected.orientation), 1e-13);
  }
}

TEST(Mapping, ScalingAndModeLeaveTheReferenceWhereItIs) {
  RandomMotion random(9);
  MappingInput in;
  in.T_u_iid = random.pose(0.2);
  in.T_world_cam = random.pose();
  Mapping mapping;
  mapping.set_offsets(random.pose(), random.rotation());
  mapping.start_at(random.pose());
  mapping.tick(in);
  for (int i = 0; i < 200; ++i) {
    in.T_u_iid = random.moved(in.T_u_iid, 0.01, 0.1);
    mapping.tick(in);
    const Pose ref = mapping.frames().T_world_ref;
    in.dt = i % 2 == 0 ? 0.0 : 1e-3;  // the slow alignment of mode w is another test's
    if (i % 2 == 0) {
      in.workspace_scaling = random.uniform(0.5, 10.0);
    } else {
      in.rotation = in.rotation == state::RotationReference::camera ? state::RotationReference::world
                                                                    : state::RotationReference::camera;
    }
    mapping.tick(in);
    ASSERT_LT(norm(mapping.frames().T_world_ref.position - ref.position), 1e-14);
    ASSERT_LT(angle_between(mapping.frames().T_world_ref.orientation, ref.orientation), 1e-13);
  }
}

TEST(Mapping, InTheWorldsAxesTheToolAlignsWithTheHandAndSlowly) {
  RandomMotion random(10);
  const Pose bo = random.pose();
  const Quat to = random.rotation();
  MappingInput in;
  in.T_u_iid = random.pose(0.2);
  in.T_world_cam = random.pose();
  in.rotation = state::RotationReference::world;
  in.dt = 1e-3;
  Mapping mapping;
  mapping.set_offsets(bo, to);
  mapping.start_at(random.pose());
  for (int i = 0; i < 4000; ++i) {
    const Quat before = mapping.frames().T_world_ref.orientation;
    mapping.tick(in);
    ASSERT_LT(angle_between(before, mapping.frames().T_world_ref.orientation), Mapping::kAlignRate * in.dt + 1e-9);
  }
  const Quat absolute = bo.orientation * in.T_u_iid.orientation * to;  // row 11
  EXPECT_LT(angle_between(absolute, mapping.frames().T_world_ref.orientation), 1e-7);
  in.clutch = true;
  in.T_u_iid.orientation = random.rotation();
  const Pose ref = mapping.frames().T_world_ref;
  mapping.tick(in);
  EXPECT_LT(angle_between(ref.orientation, mapping.frames().T_world_ref.orientation), 1e-14);
}

TEST(Mapping, PressesOfFiftyDevicesAreIndependent) {
  std::vector<Mapping> together(50), alone(50);
  std::vector<MappingInput> inputs(50);
  const auto start = [&](std::vector<Mapping>& mappings, std::size_t i) {
    RandomMotion random(static_cast<unsigned>(i) + 1);
    inputs[i].T_u_iid = random.pose(0.2);
    inputs[i].T_world_cam = random.pose();
    mappings[i].start_at(random.pose());
  };
  const auto tick = [&](std::vector<Mapping>& mappings, std::size_t i, int t) {
    RandomMotion random(static_cast<unsigned>(1000 * t) + static_cast<unsigned>(i));
    inputs[i].T_u_iid = random.moved(inputs[i].T_u_iid, 1e-2, 0.1);
    inputs[i].clutch = random.chance(0.5);
    mappings[i].tick(inputs[i]);
  };
  for (std::size_t i = 0; i < together.size(); ++i) start(together, i);
  for (int t = 0; t < 50; ++t) {
    for (std::size_t i = 0; i < together.size(); ++i) tick(together, i, t);
  }
  for (std::size_t i = 0; i < alone.size(); ++i) {
    start(alone, i);
    for (int t = 0; t < 50; ++t) tick(alone, i, t);
    EXPECT_EQ(together[i].frames().T_world_ref, alone[i].frames().T_world_ref);
  }
}

TEST(Mapping, EngagesFromWhereAPartnerBroughtTheReference) {
  RandomMotion random(12);
  MappingInput in;
  in.T_u_iid = random.pose(0.2);
  in.T_world_cam = random.pose();
  Mapping mapping;
  mapping.start_at(random.pose());
  mapping.tick(in);
  in.clutch = true;
  math::Pose ref = mapping.frames().T_world_ref;
  for (int i = 0; i < 100; ++i) {
    ref = random.moved(ref, 1e-3, 1e-2);
    mapping.adopt(ref);
    in.T_u_iid = random.moved(in.T_u_iid, 1e-3, 1e-2);
    mapping.tick(in);
  }
  in.clutch = false;
  mapping.tick(in);
  EXPECT_LT(norm(mapping.frames().T_world_ref.position - ref.position), 1e-15);
  EXPECT_LT(angle_between(mapping.frames().T_world_ref.orientation, ref.orientation), 1e-14);
}

TEST(Mapping, MountingFramesComposeToTheHand) {
  RandomMotion random(13);
  MappingInput in;
  in.T_u_iid = random.pose(0.2);
  Mapping mapping;
  mapping.set_mounting(random.pose(), random.pose());
  mapping.tick(in);
  const state::MappingFrames& f = mapping.frames();
  const Pose tip = f.T_u_base * f.T_base_e * f.T_e_to;  // inv(T_B_BO) T_B_E T_E_TO
  EXPECT_LT(norm(tip.position - in.T_u_iid.position), 1e-14);
  EXPECT_LT(angle_between(tip.orientation, in.T_u_iid.orientation), 1e-13);
}

}  // namespace
}  // namespace ambf::devices::testing
