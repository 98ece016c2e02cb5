// Joints with several free directions: their coordinates are the ones that physics limits, and their limits are drawn.
#include "render/marks/joint_span.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../runtime/simulation_rig.h"
#include "math/rotation.h"

namespace ambf::render {
namespace {

// Hangs from a static anchor at (0, 0, 2) by one joint; the bob's centre is half a metre below the pivot.
std::string hanging(const std::string& joint) {
  return R"(
bodies: [BODY anchor, BODY bob]
joints: [JOINT wide]
namespace: /test/
BODY anchor: {name: anchor, mass: 0, collision shape: BOX, collision geometry: {x: 0.02, y: 0.02, z: 0.02},
  location: {position: {x: 0, y: 0, z: 2}, orientation: {r: 0, p: 0, y: 0}}}
BODY bob: {name: bob, mass: 1, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}, collision shape: BOX,
  collision geometry: {x: 0.05, y: 0.05, z: 0.05}, location: {position: {x: 0, y: 0, z: 1.5}, orientation: {r: 0,
  p: 0, y: 0}}}
JOINT wide: {name: wide, parent: BODY anchor, child: BODY bob, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0,
  y: 0, z: 0.5},
  parent axis: {x: 0, y: 0, z: 1}, child axis: {x: 0, y: 0, z: 1}, damping: 0.2, )" +
         joint + "}\n";
}

class JointSpan : public ::testing::Test {
 protected:
  void hang(const std::string& joint) {
    rig = std::make_unique<runtime::test::Rig>(runtime::test::free_running(), hanging(joint));
    rig->simulation.set_paused(true);
    rig->simulation.begin();
    rig->step(1);
  }
  // So long that it lies against its limit.
  void push(const math::Vec3& force, const math::Vec3& torque) {
    state::Push push;
    push.force_world = force;
    push.torque_world = torque;
    push.seconds = 10.0;
    rig->wait_for([&](auto done) { rig->simulation.push(rig->id("BODY bob"), push, done); });
    rig->step(4000);
  }
  const state::JointInfo& joint() { return rig->frame().structure->joints.at(0); }
  math::Pose pose(const std::string& body) { return rig->body(body).T_world_body; }
  std::vector<SpanCoordinate> coordinates() { return span_coordinates(joint(), pose("BODY anchor"), pose("BODY bob")); }
  WorldShapes draw() {
    WorldShapes out;
    draw_span(joint(), pose("BODY anchor"), pose("BODY bob"), {0.3, 0.001, 1.0, {1.0F, 0.8F, 0.2F, 1.0F}}, out);
    return out;
  }
  // Of what is drawn in the colour of a limit that was reached.
  static bool warns(const WorldShapes& drawn) {
    const auto& lines = drawn.lines(Seen::through);
    return std::any_of(lines.begin(), lines.end(), [](const DebugLine& line) {
      return line.color[0] > 230 && line.color[1] < 80 && line.color[2] < 80;
    });
  }

  std::unique_ptr<runtime::test::Rig> rig;
};

TEST_F(JointSpan, AConeTwistSwingsToItsLimitInEachDirection) {
  hang("type: cone twist, joint limits: {x: 0.3, y: 0.6, z: 0.2}");
  auto now = coordinates();
  ASSERT_EQ(now.size(), 2u);
  EXPECT_NEAR(now[0].value, 0.0, 1e-3);
  EXPECT_FALSE(now[0].at_limit());
  EXPECT_FALSE(warns(draw()));
  push({50, 0, 0}, {});  // turns it about -y
  now = coordinates();
  EXPECT_NEAR(now[0].high, 0.6, 0.01);
  EXPECT_NEAR(now[0].value, 0.6, 0.02);
  EXPECT_TRUE(now[0].at_limit());
  EXPECT_TRUE(warns(draw()));

  hang("type: cone twist, joint limits: {x: 0.3, y: 0.6, z: 0.2}");
  push({0, 50, 0}, {});
  EXPECT_NEAR(coordinates()[0].high, 0.3, 0.01);
  EXPECT_NEAR(coordinates()[0].value, 0.3, 0.02);

  hang("type: cone twist, joint limits: {x: 0.3, y: 0.6, z: 0.2}");
  push({}, {0, 0, 2});
  EXPECT_NEAR(coordinates()[1].value, 0.2, 0.01);
  EXPECT_EQ(coordinates()[1].high, 0.2);
  EXPECT_TRUE(coordinates()[1].at_limit());
}

TEST_F(JointSpan, SixDirectionsHaveTheirOwnLimits) {
  hang(
      "type: six dof, joint limits: {linear: {low: {x: -0.1, y: 0, z: -0.2}, high: {x: 0.3, y: 0, z: 0.2}}, "
      "angular: {low: {x: 0, y: 0, z: 1}, high: {x: 0, y: 0, z: -1}}}");
  rig->log.expect_warning("such an axis moves freely");
  push({30, 0, 0}, {0, 0, 0.01});
  const auto now = coordinates();
  ASSERT_EQ(now.size(), 6u);
  EXPECT_NEAR(now[0].value, 0.3, 0.01);
  EXPECT_TRUE(now[0].at_limit());
  EXPECT_TRUE(now[1].locked());
  EXPECT_FALSE(now[1].at_limit());
  EXPECT_NEAR(now[2].value, -0.2, 0.01) << "it hangs as low as it may";
  EXPECT_TRUE(now[3].locked());
  EXPECT_TRUE(now[5].free());
  EXPECT_GT(std::abs(now[5].value), 0.01) << "and turns";
  EXPECT_TRUE(warns(draw()));
}

TEST_F(JointSpan, OthersHaveNone) {
  hang("type: revolute");
  EXPECT_EQ(joint().span, nullptr);
  EXPECT_TRUE(coordinates().empty());
  EXPECT_TRUE(draw().empty());
}

TEST_F(JointSpan, TheConeIsDrawnAsWideAsItIs) {
  hang("type: cone twist, joint limits: {x: 0.3, y: 0.6, z: 0.2}");
  double widest_x = 0.0, widest_y = 0.0;
  const WorldShapes drawn = draw();
  for (const DebugLine& line : drawn.lines(Seen::through)) {
    widest_x = std::max(widest_x, std::abs(static_cast<double>(line.from[0])));
    widest_y = std::max(widest_y, std::abs(static_cast<double>(line.from[1])));
  }
  EXPECT_NEAR(widest_x, 0.3 * std::sin(0.6), 2e-3) << "a swing about y";
  EXPECT_NEAR(widest_y, 0.3 * std::sin(0.3), 2e-3) << "a swing about x";
}

}  // namespace
}  // namespace ambf::render
