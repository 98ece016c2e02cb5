#include "render/marks/layer_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/rotation.h"
#include "scenes.h"
#include "state/actuators.h"
#include "state/ghosts.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"
#include "tests/support/fake_devices.h"

namespace ambf::render {
namespace {

constexpr double kPi = std::numbers::pi;

class LayerDrawing : public ::testing::Test {
 protected:
  LayerDrawing() {
    state::make_tables(*scene_.structure);
    scene_.body(mesh::make_box(2, 2, 0.1), {{0, 0, -0.05}, {}}, nullptr);  // 0: static
    scene_.body(mesh::make_box(0.2, 0.2, 0.2), {{0, 0, 0.1}, {}}, nullptr);
    scene_.body(mesh::make_box(0.2, 0.2, 0.2), {{0.5, 0, 0.1}, {}}, nullptr);
    for (std::uint32_t slot : {1U, 2U}) {
      info(slot).mass = 2.0;
      info(slot).inertia = {2.0 / 12 * 0.08, 2.0 / 12 * 0.08, 2.0 / 12 * 0.08};
    }
    for (state::BodyInfo& body : scene_.structure->bodies) body.collision_appearance = body.appearance;
    camera_.T_world_camera = {{3, 0, 0}, {}};
  }
  state::BodyInfo& info(std::uint32_t slot) { return scene_.structure->bodies[slot]; }
  void make_frame() {
    frame_ = scene_.frame();
    frame_->run.step_s = 0.001;
    poses_.bodies = scene_.bodies;
  }
  state::JointInfo& joint(state::JointType type, bool limits = false, double lower = 0, double upper = 0) {
    state::JointInfo joint;
    joint.object = scene_.object(state::ObjectKind::joint, "joint", 0);
    joint.type = type;
    joint.parent_body = 0;
    joint.child_body = 2;
    joint.name = "hinge";
    joint.has_limits = limits;
    joint.lower = lower;
    joint.upper = upper;
    joint.pivot_parent = {0, 0, 0.15};
    joint.axis_parent = {0, 0, 1};
    scene_.structure->joints.push_back(joint);
    return scene_.structure->joints.back();
  }
  void ghost() {
    const state::ObjectKind kind = state::ghost_kind().kind;
    state::GhostInfo ghost;
    ghost.object = scene_.object(kind, "ghost", 0);
    ghost.collision_appearance = info(0).appearance;
    state::table<state::GhostInfo>(*scene_.structure, kind).push_back(ghost);
    poses_.placed.resize(state::kind_count());
    poses_.placed[static_cast<std::size_t>(kind)].resize(1);
  }
  // Two rays along z from the scene's origin, 0.2 m long, the second of which senses a body half way.
  void sensor() {
    state::SensorInfo info;
    info.object = scene_.object(state::sensor_kind().kind, "sensor", 0);
    info.rays = std::make_shared<const std::vector<state::SensorRay>>(2, state::SensorRay{{0, 0, 0}, {0, 0, 0.2}});
    info.elements = 2;
    state::table<state::SensorInfo>(*scene_.structure, state::sensor_kind().kind).push_back(info);
    make_frame();
    poses_.placed.resize(state::kind_count());
    poses_.placed[static_cast<std::size_t>(state::sensor_kind().kind)] = {math::Pose{{0, 0, 1.0}, {}}};
    state::SensedElement sensed;
    sensed.body = 1;
    sensed.fraction = 0.5;
    state::sensed_elements(*frame_) = {state::SensedElement{}, sensed};
  }
  // Three rays side by side, as sensor(), the last of which senses a body half way.
  void skinned_sensor() {
    sensor();
    state::SensorInfo& info = state::table<state::SensorInfo>(*scene_.structure, state::sensor_kind().kind)[0];
    info.rays = std::make_shared<const std::vector<state::SensorRay>>(std::vector<state::SensorRay>{
        {{0, 0, 0}, {0, 0, 0.2}}, {{0.1, 0, 0}, {0.1, 0, 0.2}}, {{0, 0.1, 0}, {0, 0.1, 0.2}}});
    info.elements = 3;
    info.skin = std::make_shared<const std::vector<std::array<std::uint32_t, 3>>>(1, std::array{0U, 1U, 2U});
    auto& elements = state::sensed_elements(*frame_);
    elements.insert(elements.begin(), state::SensedElement{});
  }
  // Two nodes and a link, for the next frame.
  void thread() {
    auto shape = std::make_shared<state::SoftShape>();
    shape->links = {{{0, 1}, 1.0F}};
    state::SoftBodyInfo info;
    info.object = scene_.object(state::soft_body_kind().kind, "thread", 0);
    info.shape = shape;
    info.nodes = 2;
    state::table<state::SoftBodyInfo>(*scene_.structure, state::soft_body_kind().kind).push_back(info);
  }
  // One at z = 1 that holds nothing.
  void actuator() {
    const state::ObjectKind kind = state::actuator_kind().kind;
    state::ActuatorInfo info;
    info.object = scene_.object(kind, "grip", 0);
    state::table<state::ActuatorInfo>(*scene_.structure, kind).push_back(info);
    make_frame();
    poses_.placed.resize(state::kind_count());
    poses_.placed[static_cast<std::size_t>(kind)] = {math::Pose{{0, 0, 1.0}, {}}};
  }
  WorldShapes draw(const Layers& layers) {
    WorldShapes out;
    draw_layers(layers, {*frame_, poses_, picked_, PixelScale(camera_, 640, 480, 1.0), {}, &devices_}, out);
    return out;
  }
  static Layers only(LayerId layer) {
    Layers layers;
    layers.show(layer);
    return layers;
  }
  static math::Vec3 point(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

  testing::SceneMaker scene_;
  Camera camera_;
  ScenePoses poses_;
  state::ObjectId picked_;
  FakeDevices devices_;
  std::unique_ptr<state::Frame> frame_;
};

TEST_F(LayerDrawing, NothingIsDrawnWhereNothingIsAskedFor) {
  make_frame();
  EXPECT_TRUE(draw({}).empty());
}

TEST_F(LayerDrawing, EveryLayerDrawsSomethingOfItsOwn) {
  joint(state::JointType::revolute);
  ghost();
  thread();
  actuator();
  skinned_sensor();
  state::soft_nodes(*frame_) = {{{0, 0, 0}}, {{1, 0, 0}}};
  devices_.add("left");
  picked_ = {1, 1};
  frame_->contacts = {{1, 0, {0, 0, 0}, {0, 0, 1}, 0.0, 0.0196, {}}};
  frame_->bodies[1].twist_world = {{1, 0, 0}, {0, 0, 3}};
  for (std::size_t i = 0; i < all_layers().size(); ++i)
    EXPECT_EQ(draw(only(static_cast<LayerId>(i))).empty(), all_layers()[i].draw == nullptr) << all_layers()[i].label;
}

TEST_F(LayerDrawing, FramesStandWhereTheBodiesAreAndOnlyThePickedOneWhenAskedFor) {
  make_frame();
  EXPECT_EQ(draw(only(LayerId::frames)).lines(Seen::always).size(), 9U);
  picked_ = {2, 1};
  const WorldShapes one = draw(only(LayerId::picked_frame));
  ASSERT_EQ(one.lines(Seen::always).size(), 3U);
  EXPECT_LT(math::norm(point(one.lines(Seen::always)[0].from) - math::Vec3{0.5, 0, 0.1}), 1e-6);
  picked_ = {9, 1};  // gone
  EXPECT_TRUE(draw(only(LayerId::picked_frame)).empty());
}

TEST_F(LayerDrawing, FramesCanBeSeenAtAnyDistance) {
  make_frame();
  picked_ = {2, 1};
  for (const double distance : {1.0, 30.0, 300.0}) {
    camera_.T_world_camera.position.x = 0.5 + distance;
    const auto drawn = draw(only(LayerId::picked_frame));
    const double length = point(drawn.lines(Seen::always)[0].to).x - 0.5;
    const double px = length / (2.0 * std::tan(camera_.field_of_view_rad / 2) * distance / 480.0);
    EXPECT_GE(px, 17.9) << distance;
    EXPECT_LE(px, 55.1) << distance;
  }
}

TEST_F(LayerDrawing, CollisionShapesTellMovingFromSleepingFromStatic) {
  make_frame();
  frame_->bodies[2].asleep = true;
  const WorldShapes drawn = draw(only(LayerId::collision));
  ASSERT_EQ(drawn.meshes().size(), 3U);
  const DebugColor still = drawn.meshes()[0].edges, moving = drawn.meshes()[1].edges, asleep = drawn.meshes()[2].edges;
  EXPECT_GT(moving[0], moving[2]) << "orange";
  EXPECT_GT(asleep[2], asleep[0]) << "blue";
  EXPECT_NEAR(still[0], still[2], 0.1) << "grey";
  EXPECT_LT(math::norm(drawn.meshes()[2].T_world_mesh.position - math::Vec3{0.5, 0, 0.1}), 1e-9);
  EXPECT_FALSE(drawn.meshes()[0].all_edges);
}

TEST_F(LayerDrawing, TheInertiaBoxOfASolidBoxIsThatBox) {
  info(1).inertia = {2.0 / 12 * (0.04 + 0.09), 2.0 / 12 * (0.01 + 0.09), 2.0 / 12 * (0.01 + 0.04)};  // 0.1 x 0.2 x 0.3
  info(1).T_body_com = {{0, 0, 0.05}, {}};
  info(2).mass = 0.0;
  make_frame();
  const WorldShapes drawn = draw(only(LayerId::mass));
  math::Vec3 low{9, 9, 9}, high{-9, -9, -9};
  for (const DebugLine& line : drawn.lines(Seen::through)) {
    const math::Vec3 p = point(line.from), q = point(line.to);
    for (const math::Vec3& at : {p, q}) {
      low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
    }
  }
  EXPECT_LT(math::norm(high - low - math::Vec3{0.1, 0.2, 0.3}), 1e-5);
  EXPECT_LT(math::norm(0.5 * (high + low) - math::Vec3{0, 0, 0.15}), 1e-5);
  ASSERT_EQ(drawn.lines(Seen::always).size(), 2U) << "one centre of mass: static bodies have none";
}

TEST_F(LayerDrawing, AContactsArrowPointsAlongTheForceOnWhatMoves) {
  make_frame();
  frame_->contacts = {{1, 0, {0, 0, 0}, {0, 0, 1}, 0.0, 0.0196, {}},     // the box is A: 19.6 N upwards
                      {0, 2, {0.5, 0, 0}, {0, 0, -1}, 0.0, 0.0196, {}},  // the box is B
                      {1, 2, {0.25, 0, 0.1}, {1, 0, 0}, 0.001, 0.0, {}}};
  const auto drawn = draw(only(LayerId::contacts));
  const auto& lines = drawn.lines(Seen::through);
  ASSERT_EQ(lines.size(), 3U + 3U + 1U) << "shaft, head and point; only a point where nothing is pressed";
  for (const std::size_t head : {1U, 4U}) {
    const math::Vec3 from = point(lines[head].from), to = point(lines[head].to);
    EXPECT_GT(to.z, from.z);
    EXPECT_NEAR(to.x, from.x, 1e-6);
  }
}

TEST_F(LayerDrawing, FrictionTiltsTheArrow) {
  make_frame();
  frame_->contacts = {{1, 0, {0, 0, 0}, {0, 0, 1}, 0.0, 0.02, {0, 0.01, 0}}};
  const auto drawn = draw(only(LayerId::contacts));
  const DebugLine& head = drawn.lines(Seen::through)[1];
  const math::Vec3 tip = point(head.to);
  EXPECT_NEAR(tip.y / tip.z, 0.5, 1e-4);
}

TEST_F(LayerDrawing, GreaterForcesAreLongerAndRedder) {
  make_frame();
  double before = 0.0;
  float red = -2.0F;
  for (const double newtons : {0.01, 1.0, 100.0}) {
    frame_->contacts = {{1, 0, {0, 0, 0}, {0, 0, 1}, 0.0, newtons * 0.001, {}}};
    const auto drawn = draw(only(LayerId::contacts));
    const double length = point(drawn.lines(Seen::through)[1].to).z;
    EXPECT_GT(length, before + 0.05);
    EXPECT_LT(length, 0.7);
    before = length;
    const DebugColor color = force_color(newtons);
    EXPECT_GT(color[0] - color[1], red) << newtons;
    red = color[0] - color[1];
  }
  EXPECT_EQ(force_color(1e9), force_color(100.0));
  EXPECT_EQ(force_color(0.0), force_color(0.001));
}

TEST_F(LayerDrawing, AHingesSectorSpansItsLimitsAndItsNeedleShowsTheValue) {
  joint(state::JointType::revolute, true, -0.5, 1.0);
  scene_.bodies[2] = {math::rotate(math::from_axis_angle({0, 0, 1}, 0.3), {0.5, 0, 0}) + math::Vec3{0, 0, 0.1},
                      math::from_axis_angle({0, 0, 1}, 0.3)};
  make_frame();
  frame_->joints[0].position = 0.3;
  const WorldShapes drawn = draw(only(LayerId::joints));
  double least = 9, most = -9;
  for (const DebugVertex& corner : drawn.triangles(Seen::through)) {
    const math::Vec3 p = point(corner.point);
    EXPECT_NEAR(p.z, 0.1, 1e-6);
    if (std::hypot(p.x, p.y) < 1e-6) continue;
    least = std::min(least, std::atan2(p.y, p.x));
    most = std::max(most, std::atan2(p.y, p.x));
  }
  EXPECT_NEAR(least, -0.5, 1e-4);
  EXPECT_NEAR(most, 1.0, 1e-4);
  const DebugLine& needle = drawn.lines(Seen::through).back();
  EXPECT_NEAR(std::atan2(needle.to[1], needle.to[0]), 0.3, 1e-4);
  ASSERT_EQ(drawn.texts().size(), 1U);
  EXPECT_EQ(drawn.texts()[0].text, "hinge 17.2\u00b0");
}

TEST_F(LayerDrawing, AJointAtItsLimitIsRed) {
  joint(state::JointType::revolute, true, -0.5, 1.0);
  make_frame();
  const auto needle = [&](double position) {
    frame_->joints[0].position = position;
    return draw(only(LayerId::joints)).lines(Seen::through).back().color;
  };
  EXPECT_GT(needle(0.2)[1], 150) << "yellow";
  EXPECT_LT(needle(1.0)[1], 80) << "red";
  EXPECT_LT(needle(-0.51)[1], 80);
}

TEST_F(LayerDrawing, AHingeWithoutLimitsIsAFullCircle) {
  joint(state::JointType::revolute);
  make_frame();
  const WorldShapes drawn = draw(only(LayerId::joints));
  EXPECT_TRUE(drawn.triangles(Seen::through).empty());
  EXPECT_GT(drawn.lines(Seen::through).size(), 40U);
}

TEST_F(LayerDrawing, AHingeWhoseChildLiesOnItsAxisTurnsWithTheChildsOwnAxes) {
  joint(state::JointType::revolute, true, -3.0, 3.0).pivot_parent = {0.5, 0, 0.15};
  make_frame();
  const auto angle_at = [&](double turn) {
    poses_.bodies[2].orientation = math::from_axis_angle({0, 0, 1}, turn);
    frame_->joints[0].position = turn;
    const DebugLine needle = draw(only(LayerId::joints)).lines(Seen::through).back();
    return std::atan2(needle.to[1] - needle.from[1], needle.to[0] - needle.from[0]);
  };
  const double start = angle_at(0.0);
  for (const double turn : {0.4, 1.1, 2.0}) {
    const double moved = std::remainder(angle_at(turn) - start - turn, 2 * kPi);
    EXPECT_NEAR(moved, 0.0, 1e-4) << turn;
  }
}

TEST_F(LayerDrawing, ASlidersRangeIsASegmentAlongItsAxis) {
  joint(state::JointType::prismatic, true, -0.1, 0.3);
  make_frame();
  frame_->joints[0].position = 0.25;
  const WorldShapes drawn = draw(only(LayerId::joints));
  const DebugLine& range = drawn.lines(Seen::through).front();
  EXPECT_NEAR(range.from[2], 0.1 - 0.1, 1e-6);
  EXPECT_NEAR(range.to[2], 0.1 + 0.3, 1e-6);
  ASSERT_EQ(drawn.lines(Seen::always).size(), 1U);
  EXPECT_NEAR(drawn.lines(Seen::always)[0].from[2], 0.1 + 0.25, 1e-6);
  EXPECT_EQ(drawn.texts()[0].text, "hinge 250.00 mm");
}

TEST_F(LayerDrawing, EveryKindOfJointIsDrawn) {
  using state::JointType;
  for (const JointType type : {JointType::fixed, JointType::revolute, JointType::prismatic, JointType::linear_spring,
                               JointType::torsion_spring, JointType::p2p, JointType::cone_twist, JointType::six_dof,
                               JointType::six_dof_spring}) {
    scene_.structure->joints.clear();
    joint(type);
    make_frame();
    EXPECT_FALSE(draw(only(LayerId::joints)).empty()) << static_cast<int>(type);
  }
}

TEST_F(LayerDrawing, TheGroundIsNotNamed) {
  const std::uint32_t ground = scene_.body(mesh::make_box(8, 8, 0.1), {}, nullptr);
  make_frame();
  const std::string name = scene_.structure->objects[info(ground).object].local_name;
  const WorldShapes drawn = draw(only(LayerId::names));
  EXPECT_EQ(drawn.texts().size(), 3U);
  for (const DebugText& text : drawn.texts()) EXPECT_NE(text.text, name);
}

// Fig. 6.8c: starts of rays red, ends green.
TEST_F(LayerDrawing, ASensorsRaysShowWhatTheySense) {
  sensor();
  const WorldShapes drawn = draw(only(LayerId::sensors));
  const auto& marks = drawn.lines(Seen::through);
  ASSERT_EQ(marks.size(), 6U) << "two ends each, and of the triggered one the way to what it senses and that point";
  EXPECT_GT(marks[0].color[0], marks[0].color[1]);
  EXPECT_GT(marks[1].color[1], marks[1].color[0]);
  EXPECT_NEAR(point(marks[0].from).z, 1.0, 1e-6);
  EXPECT_NEAR(point(marks[1].from).z, 1.2, 1e-6);
  EXPECT_NEAR(point(marks.back().from).z, 1.1, 1e-6);
}

TEST_F(LayerDrawing, WhatASensorResistsWithIsAnArrowAndASlipIsMagenta) {
  sensor();
  const std::size_t lines = draw(only(LayerId::sensors)).lines(Seen::through).size();
  state::SensedElement& element = state::sensed_elements(*frame_)[1];
  element.force_world = {0, 0, 2.0};
  const WorldShapes pressed = draw(only(LayerId::sensors));
  EXPECT_GT(pressed.lines(Seen::through).size(), lines);
  EXPECT_GT(pressed.lines(Seen::through).back().to[2], 1.1F) << "from the point, along the force";
  element.force_world = {};
  element.slipped = true;
  const auto color = draw(only(LayerId::sensors)).lines(Seen::through).back().color;
  EXPECT_TRUE(color[0] > 200 && color[1] < 100 && color[2] > 180);
}

// Fig. 6.5b: pressed in where something is sensed.
TEST_F(LayerDrawing, ASkinPassesThroughWhatIsSensedAndElsewhereThroughTheEndsOfRays) {
  skinned_sensor();
  const WorldShapes drawn = draw(only(LayerId::sensor_skins));
  const auto& corners = drawn.triangles(Seen::through);
  ASSERT_EQ(corners.size(), 3U);
  EXPECT_NEAR(point(corners[0].point).z, 1.2, 1e-6);
  EXPECT_NEAR(point(corners[1].point).z, 1.2, 1e-6);
  EXPECT_NEAR(point(corners[2].point).z, 1.1, 1e-6);
  const auto pressed = corners[0].color;
  state::sensed_elements(*frame_)[2] = {};
  EXPECT_NE(draw(only(LayerId::sensor_skins)).triangles(Seen::through)[0].color, pressed);
}

TEST_F(LayerDrawing, ASensorThatIsVisibleIsSeenWithoutItsLayer) {
  const auto drawn_without_layer = [this] {
    WorldShapes out;
    draw_visible_sensors({*frame_, poses_, picked_, PixelScale(camera_, 640, 480, 1.0), {}, &devices_}, out);
    return !out.empty();
  };
  sensor();
  EXPECT_FALSE(drawn_without_layer());
  state::table<state::SensorInfo>(*scene_.structure, state::sensor_kind().kind)[0].visible = true;
  EXPECT_TRUE(drawn_without_layer());
}

TEST_F(LayerDrawing, AnActuatorIsTiedToWhatItHolds) {
  actuator();
  const std::size_t idle = draw(only(LayerId::actuators)).lines(Seen::through).size();
  state::ActuatorState& row = state::rows(*frame_, state::actuator_kind().column).at(0);
  row.held[0] = 1;
  row.held_count = 1;
  const WorldShapes drawn = draw(only(LayerId::actuators));
  ASSERT_EQ(drawn.lines(Seen::through).size(), idle + 1);
  EXPECT_NEAR(point(drawn.lines(Seen::through).back().from).z, 1.0, 1e-6);
  WorldShapes without_layer;
  draw_visible_actuators({*frame_, poses_, picked_, PixelScale(camera_, 640, 480, 1.0), {}, &devices_}, without_layer);
  EXPECT_TRUE(without_layer.empty()) << "its file does not make it visible";
}

TEST_F(LayerDrawing, VelocitiesShowWhereTheCentreOfMassWillBe) {
  make_frame();
  frame_->bodies[1].twist_world.linear = {0, 2, 0};
  const WorldShapes drawn = draw(only(LayerId::velocities));
  const auto& lines = drawn.lines(Seen::through);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_LT(math::norm(point(lines[1].to) - math::Vec3{0, 0.2, 0.1}), 1e-5);
}

TEST_F(LayerDrawing, APickShowsItsForceWhereverItComesFrom) {
  make_frame();
  frame_->picks = {{0, 1, {0, 0, 0.1}, {0, 0.5, 0.5}, {0, 3, 4}}, {3, 0, {}, {0, 0, 1}, {}}};
  WorldShapes out;
  draw_picks({*frame_, poses_, {}, PixelScale(camera_, 640, 480, 1.0)}, out);
  ASSERT_EQ(out.texts().size(), 1U) << "static bodies are moved, not pulled";
  EXPECT_EQ(out.texts()[0].text, "5.0 N");
  EXPECT_EQ(out.texts()[0].size_m, 0.0) << "never left out";
  EXPECT_LT(math::norm(point(out.lines(Seen::always).front().from) - math::Vec3{0, 0, 0.2}), 1e-6);
}

TEST_F(LayerDrawing, ForcesAreToldInFittingUnits) {
  EXPECT_EQ(force_text(0.0), "0 mN");
  EXPECT_EQ(force_text(0.0374), "37 mN");
  EXPECT_EQ(force_text(2.46), "2.5 N");
  EXPECT_EQ(force_text(46.2), "46 N");
  EXPECT_EQ(force_text(1240.0), "1.2 kN");
}

}  // namespace
}  // namespace ambf::render
