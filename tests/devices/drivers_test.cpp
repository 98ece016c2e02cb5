// The table of drivers, and the offsets of a mounting (EQUATIONS 3).
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "devices/driver.h"
#include "math/rotation.h"

namespace ambf::devices {
namespace {

// A right master of the da Vinci: home pose and tip of the shipped device files.
DriverRequest right_master() {
  DriverRequest request;
  request.T_base_offset = {{-0.181, -0.0163, -0.262}, math::from_rpy(0.0, 0.0, -M_PI / 2)};
  request.T_tip_offset = {{}, math::from_rpy(0.0, M_PI / 2, 0.0)};
  return request;
}

void expect_near(const math::Vec3& a, const math::Vec3& b) { EXPECT_LT(math::norm(a - b), 1e-12); }

TEST(DriverOffsets, HomePoseIsTheOrigin) {
  const DriverRequest request = right_master();
  const math::Pose T_u_tip = to_user_frame(request, request.T_base_offset * math::inverse(request.T_tip_offset));
  expect_near(T_u_tip.position, {});
  expect_near(math::log(T_u_tip.orientation), {});
}

TEST(DriverOffsets, MotionAndWrenchTurnByTheSameRotation) {
  const DriverRequest request = right_master();
  const math::Pose home = request.T_base_offset * math::inverse(request.T_tip_offset);
  for (const math::Vec3& along_u : {math::Vec3{1, 0, 0}, math::Vec3{0, 1, 0}, math::Vec3{0, 0, 1}}) {
    const math::Vec3 along_base = to_base_axes(request, {along_u, 2.0 * along_u}).force;
    math::Pose moved = home;
    moved.position += 0.01 * along_base;
    expect_near(to_user_frame(request, moved).position, 0.01 * along_u);
    // A hand that rolls in the base about an axis rolls in U about that axis, wherever the tip points.
    moved.orientation = math::exp(0.3 * along_base) * home.orientation;
    expect_near(math::log(to_user_frame(request, moved).orientation), 0.3 * along_u);
    expect_near(to_base_axes(request, {along_u, 2.0 * along_u}).torque, 2.0 * along_base);
  }
}

TEST(DriverOffsets, OperatorsRightIsPlusY) {
  // The base's x axis points to the operator's right: a base turned by -90 degrees about z.
  const DriverRequest request = right_master();
  math::Pose tip = request.T_base_offset;
  tip.position.x += 0.02;
  expect_near(to_user_frame(request, tip).position, {0.0, 0.02, 0.0});
}

TEST(DriverTable, FindsByTypeElseByHardwareName) {
  register_driver({"test_arm", {"Test Arm", "TA-7"}, nullptr});
  DriverRequest request;
  request.hardware_name = "TA-7";
  ASSERT_NE(find_driver(request), nullptr);
  EXPECT_EQ(find_driver(request)->type, "test_arm");
  request.type = "not_there";
  EXPECT_EQ(find_driver(request), nullptr) << "a type that is named is not replaced by another one";
  request.type = "test_arm";
  request.hardware_name = "anything";
  EXPECT_NE(find_driver(request), nullptr);
  EXPECT_EQ(find_driver({}), nullptr);
  EXPECT_THROW(register_driver({"test_arm", {}, nullptr}), std::logic_error);
}

}  // namespace
}  // namespace ambf::devices
