// The layers of soft bodies: nodes by what they are, links by how far they are stretched, held nodes, pointers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/marks/layer_soft_bodies.h"
#include "scenes.h"
#include "state/actuators.h"
#include "state/kind_rows.h"
#include "state/soft_bodies.h"

namespace ambf::render {
namespace {

// Three nodes in a row, the first one fixed; the second link is 5 % longer than as loaded.
class SoftLayers : public ::testing::Test {
 protected:
  SoftLayers() {
    state::make_tables(*scene_.structure);
    auto shape = std::make_shared<state::SoftShape>();
    shape->links = {{{0, 1}, 1.0F}, {{1, 2}, 1.0F}};
    state::SoftBodyInfo body;
    body.object = scene_.object(state::soft_body_kind().kind, "thread", 0);
    body.shape = shape;
    body.nodes = 3;
    body.fixed = {true, false, false};
    state::table<state::SoftBodyInfo>(*scene_.structure, state::soft_body_kind().kind).push_back(body);
    state::ActuatorInfo grip;
    grip.object = scene_.object(state::actuator_kind().kind, "grip", 0);
    state::table<state::ActuatorInfo>(*scene_.structure, state::actuator_kind().kind).push_back(grip);
    frame_ = scene_.frame();
    for (const double x : {0.0, 1.0, 2.05}) state::soft_nodes(*frame_).push_back({{x, 0, 0}});
    state::held_nodes(*frame_).push_back({0, 0, 2, {2.1, 0, 0}, {1.5, 0, 0}, state::HeldNode::Puncture::none, {}});
    poses_.placed.resize(state::kind_count());
    poses_.placed[static_cast<std::size_t>(state::actuator_kind().kind)] = {math::Pose{{2.0, 0, 0.5}, {}}};
    camera_.T_world_camera = {{3, 0, 0}, {}};
  }
  WorldShapes drawn(void (*draw)(const LayerInput&, WorldShapes&)) const {
    WorldShapes out;
    draw({*frame_, poses_, {}, PixelScale(camera_, 640, 480, 1.0), {}, nullptr}, out);
    return out;
  }
  static bool is(const DebugLine& line, double from, double to) {
    return line.from[0] == static_cast<float>(from) && line.to[0] == static_cast<float>(to);
  }

  testing::SceneMaker scene_;
  std::unique_ptr<state::Frame> frame_;
  ScenePoses poses_;
  Camera camera_;
};

TEST_F(SoftLayers, NodesAreMarkedByWhatTheyAre) {
  const WorldShapes shown = drawn(draw_soft_nodes);
  const auto& through = shown.lines(Seen::through);
  ASSERT_EQ(through.size(), 2U + 3U) << "links and nodes";
  EXPECT_TRUE(is(through[0], 0.0, 1.0));
  EXPECT_TRUE(is(through[1], 1.0, 2.05));
  EXPECT_GT(through[2].from_half_px, through[3].from_half_px) << "the fixed one is larger";
  EXPECT_GT(through[2].color[0], 2 * through[2].color[1]) << "and red";
  const auto& held = shown.lines(Seen::always);
  ASSERT_EQ(held.size(), 1U);
  EXPECT_TRUE(is(held[0], 2.05, 2.05));
}

TEST_F(SoftLayers, LinksHaveTheColorOfTheirStrain) {
  const auto lines = drawn(draw_soft_strain).lines(Seen::through);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_LT(std::abs(lines[0].color[0] - lines[0].color[2]), 20) << "grey: as loaded";
  EXPECT_GT(lines[1].color[0], lines[1].color[2] + 40) << "longer";
  EXPECT_EQ(strain_color(1.1), strain_color(2.0)) << "full at 10 %";
  EXPECT_GT(strain_color(0.9)[2], strain_color(0.9)[0] + 0.5F);
}

TEST_F(SoftLayers, AnActuatorShowsTheGapOfEachNodeThatItHolds) {
  const auto lines = drawn(draw_actuators).lines(Seen::through);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const DebugLine& line) { return is(line, 2.1, 2.05); }));
}

TEST_F(SoftLayers, PointersShowWhereTheyPull) {
  state::soft_picks(*frame_).push_back({0, 0, {1, 0, 0}, {1, 0, 1}, {0, 0, 2.5}});
  const WorldShapes shown = drawn(draw_picks);
  EXPECT_FALSE(shown.lines(Seen::always).empty());
  ASSERT_EQ(shown.texts().size(), 1U);
  EXPECT_EQ(shown.texts()[0].text, "2.5 N");
}

}  // namespace
}  // namespace ambf::render
