// URDF robots as bodies and joints that can be simulated: what is folded into what.
#include <gtest/gtest.h>

#include "adf/detail/urdf_tree.h"

namespace ambf::adf {
namespace {

// A chain of links without mass, whose joints stand in the file from the tip down: all are folded, and what they carry
// is in its place.
TEST(UrdfPlan, LongChainsOfLinksWithoutMassBecomeOneBody) {
  urdf::Robot robot;
  constexpr int kLinks = 10000;
  for (int i = 0; i < kLinks; ++i) {
    urdf::Link link;
    link.name = "l" + std::to_string(i);
    link.visuals.emplace_back().kind = urdf::ShapeKind::sphere;
    link.visuals.back().origin.position = {0, 0.5, 0};
    robot.links.push_back(link);
  }
  for (int i = kLinks - 1; i > 0; --i) {
    urdf::Joint joint;
    joint.name = "j" + std::to_string(i);
    joint.parent = "l" + std::to_string(i - 1);
    joint.child = "l" + std::to_string(i);
    joint.kind = i == 1 ? urdf::JointKind::continuous : urdf::JointKind::fixed;
    joint.origin.position = {0, 0, 0.25};
    robot.joints.push_back(joint);
  }
  robot.root = "l0";
  const urdf::Plan plan = urdf::plan_of(std::move(robot), {}, [](int, const std::string&, const std::string&) {});
  ASSERT_EQ(plan.bodies.size(), 2U);
  ASSERT_EQ(plan.bodies[1].link.visuals.size(), static_cast<std::size_t>(kLinks - 1));
  EXPECT_EQ(plan.bodies[1].link.visuals.back().origin.position, (math::Vec3{0, 0.5, 0.25 * (kLinks - 2)}));
  EXPECT_EQ(plan.joints.at(0).child, "l1");
}

}  // namespace
}  // namespace ambf::adf
