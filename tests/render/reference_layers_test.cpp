// What debug drawings and layers look like: pixels where they must be, and whole pictures compared with committed ones.
#include <gtest/gtest.h>

#include <numbers>
#include <optional>

#include "math/rotation.h"
#include "offscreen_fixture.h"
#include "reference_picture.h"
#include "render/marks/label_layout.h"
#include "render/marks/layer_shapes.h"
#include "render/pictures/extras.h"
#include "render/pictures/offscreen.h"
#include "scenes.h"
#include "still_picture.h"
#include "tests/support/compat_models.h"

namespace ambf::render {
namespace {

using testing::differs_from_reference;
using testing::matches_reference;
using testing::matte;
using testing::SceneMaker;

constexpr int kWidth = 320, kHeight = 240;

class LayerPictures : public testing::OffscreenFixture {
 protected:
  Image take(const state::Frame& frame, const Camera& camera, const WorldShapes& debug, int width = kWidth,
             int height = kHeight) {
    const auto letters = std::make_shared<const Lettering>(1.0);
    TextDrawing text(letters, width, height);
    draw_labels(lay_out(debug.texts(), camera, width, height, *letters), text);
    Extras extras{{}, &debug, &text};
    for (const state::PickState& pick : frame.picks) extras.outlined.push_back(pick.body);
    Image image;
    std::string why;
    EXPECT_TRUE(offscreen_->picture(frame, camera, width, height, image, diagnostics_, why, {}, &extras)) << why;
    return image;
  }
  Image take(const state::Frame& frame, const Camera& camera, const Layers& layers, int width = kWidth,
             int height = kHeight) {
    Motion now;
    now.take(frame);
    const ScenePoses& poses = now.at(frame.steady_ns);
    const LayerInput input{frame, poses, {}, PixelScale(camera, width, height, 1.0)};
    WorldShapes debug;
    draw_layers(layers, input, debug);
    draw_picks(input, debug);
    return take(frame, camera, debug, width, height);
  }
  static const std::uint8_t* at(const Image& image, int x, int y) {
    return &image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
  }
};

int redness(const std::uint8_t* pixel) { return pixel[0] - (pixel[1] + pixel[2]) / 2; }

TEST_F(LayerPictures, WhatLiesBehindIsHiddenOrFaintOrNot) {
  const mesh::SurfaceMaterial grey = matte(0.3F, 0.3F, 0.3F);
  SceneMaker scene;
  scene.body(mesh::make_box(0.1, 1.0, 1.0), {}, &grey);
  Camera camera;
  camera.T_world_camera = {{3, 0, 0}, {}};
  const auto redness_of = [&](double x, Seen seen) {
    WorldShapes debug;
    debug.line({x, -0.3, 0}, {x, 0.3, 0}, {1, 0, 0, 1}, 6.0, seen);
    return redness(at(take(*scene.frame(), camera, debug), kWidth / 2, kHeight / 2));
  };
  for (const Seen seen : {Seen::in_front, Seen::through, Seen::always}) {
    EXPECT_GT(redness_of(0.5, seen), 200) << "before the box";
  }
  EXPECT_LT(redness_of(-0.5, Seen::in_front), 10);
  EXPECT_GT(redness_of(-0.5, Seen::through), 30);
  EXPECT_LT(redness_of(-0.5, Seen::through), 150);
  EXPECT_GT(redness_of(-0.5, Seen::always), 200);
}

TEST_F(LayerPictures, LinesAreAsWideFarAwayAsNear) {
  const SceneMaker scene;
  Camera camera;
  camera.far_m = 100.0;
  camera.T_world_camera = {{3, 0, 0}, {}};
  for (const double x : {2.0, -40.0}) {
    WorldShapes debug;
    debug.line({x, -20, 0}, {x, 20, 0}, {1, 0, 0, 1}, 6.0);
    const Image image = take(*scene.frame(), camera, debug);
    int rows = 0;
    for (int y = 0; y < kHeight; ++y) rows += redness(at(image, kWidth / 2, y)) > 100 ? 1 : 0;
    EXPECT_NEAR(rows, 6, 1) << x;
  }
}

TEST_F(LayerPictures, ALineThatBeginsBehindTheViewerIsCutThere) {
  const SceneMaker scene;
  Camera camera;
  camera.T_world_camera = {{3, 0, 0}, {}};
  WorldShapes debug;
  debug.line({10, 0, -0.5}, {0, 0, 0}, {1, 0, 0, 1}, 6.0);  // from far behind and below to the middle
  const Image image = take(*scene.frame(), camera, debug);
  EXPECT_GT(redness(at(image, kWidth / 2, kHeight / 2 + 4)), 100);
  EXPECT_GT(redness(at(image, kWidth / 2, kHeight - 10)), 100);
  EXPECT_LT(redness(at(image, kWidth / 2, kHeight / 4)), 20) << "nothing above";
}

TEST_F(LayerPictures, ThreeHundredEqualMeshesAndNoneCostNoErrors) {
  SceneMaker scene;
  WorldShapes debug;
  for (int i = 0; i < 300; ++i) {
    debug.mesh(std::make_shared<mesh::Mesh>(mesh::make_box(0.05, 0.05, 0.05)),
               {{0, -1.0 + 0.1 * (i % 20), -0.7 + 0.1 * (i / 20)}, {}}, 1.0, {1, 0, 0, 0.5F}, {1, 0, 0, 1});
  }
  Camera camera;
  camera.T_world_camera = {{3, 0, 0}, {}};
  const Image many = take(*scene.frame(), camera, debug);
  int red = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) red += redness(at(many, x, y)) > 30 ? 1 : 0;
  }
  EXPECT_GT(red, 5000);
  debug.clear();
  const Image none = take(*scene.frame(), camera, debug);
  for (int x = 0; x < kWidth; ++x) EXPECT_LT(redness(at(none, x, kHeight / 2)), 20);
}

// A box on a table beside a lever on a post and a slider, so that each layer has something to say.
struct Workbench : SceneMaker {
  std::unique_ptr<state::Frame> frame_;
  Camera camera;

  Workbench() {
    const auto wood = matte(0.62F, 0.50F, 0.36F), steel = matte(0.45F, 0.50F, 0.56F), red = matte(0.70F, 0.20F, 0.16F),
               blue = matte(0.16F, 0.32F, 0.62F);
    named(body(mesh::make_box(1.2, 1.6, 0.1), {{0, 0, -0.05}, {}}, &wood), "table", 0.0, {});
    named(body(mesh::make_box(0.3, 0.3, 0.3), {{0, -0.5, 0.15}, {}}, &red), "box", 4.0, {0.06, 0.06, 0.06});
    named(body(mesh::make_cylinder(0.06, 0.4), {{0, 0.05, 0.2}, {}}, &steel), "post", 0.0, {});
    const math::Quat tilted = math::from_axis_angle({1, 0, 0}, 0.5);
    named(body(mesh::make_box(0.08, 0.5, 0.08),
               {math::rotate(tilted, {0, 0.2, 0}) + math::Vec3{0.1, 0.05, 0.4}, tilted}, &blue),
          "lever", 1.0, {0.021, 0.001, 0.021});
    named(body(mesh::make_sphere(0.1), {{0.35, 0.2, 0.1}, {}}, &steel), "ball", 0.5, {0.002, 0.002, 0.002});
    joint("hinge", state::JointType::revolute, 2, 3, {0.1, 0, 0.2}, {1, 0, 0}, -0.4, 1.2);
    joint("slide", state::JointType::prismatic, 0, 1, {0, -0.5, 0.35}, {0, 1, 0}, -0.15, 0.35);
    light({{1.5, -1.0, 3}, math::rotation_between({1, 0, 0}, math::normalized(math::Vec3{-1.5, 1.0, -3}))})
        .beam.shadow_quality = 3;
    frame_ = frame();
    frame_->run.step_s = 0.001;
    frame_->joints[0].position = 0.5;
    frame_->joints[0].commanded = 0.9;
    frame_->joints[0].commanded_type = state::JointCommandType::position;
    frame_->bodies[4].asleep = true;
    frame_->bodies[3].twist_world = {{0, 0.3, 0.8}, {4, 0, 0}};
    for (const double x : {-0.15, 0.15}) {
      for (const double y : {-0.65, -0.35}) {
        frame_->contacts.push_back({1, 0, {x, y, 0}, {0, 0, 1}, 0.0, 0.0098, {0, 0.003, 0}});
      }
    }
    frame_->contacts.push_back({4, 0, {0.35, 0.2, 0}, {0, 0, 1}, 0.0, 0.0049, {}});
    camera.T_world_camera = looking_at({2.1, -0.9, 1.3}, {0.05, 0, 0.15});
  }
  void named(std::uint32_t slot, const std::string& name, double mass, const math::Vec3& inertia) {
    state::BodyInfo& info = structure->bodies[slot];
    info.mass = mass;
    info.inertia = inertia;
    info.collision_appearance = info.appearance;
    structure->objects[info.object].local_name = name;
  }
  void joint(const char* name, state::JointType type, std::uint32_t parent, std::uint32_t child,
             const math::Vec3& pivot, const math::Vec3& axis, double lower, double upper) {
    state::JointInfo joint;
    joint.object = object(state::ObjectKind::joint, name, static_cast<std::uint32_t>(structure->joints.size()));
    joint.type = type;
    joint.parent_body = parent;
    joint.child_body = child;
    joint.name = name;
    joint.has_limits = true;
    joint.lower = lower;
    joint.upper = upper;
    joint.pivot_parent = pivot;
    joint.axis_parent = axis;
    structure->joints.push_back(joint);
  }
};

TEST_F(LayerPictures, OfEachLayer) {
  const Workbench bench;
  const auto picture = [&](LayerId layer, std::optional<LayerId> other = {}) {
    Layers layers;
    layers.show(layer);
    if (other) layers.show(*other);
    return take(*bench.frame_, bench.camera, layers);
  };
  EXPECT_TRUE(matches_reference(picture(LayerId::frames, LayerId::names), "layer_frames_names"));
  EXPECT_TRUE(matches_reference(picture(LayerId::collision), "layer_collision"));
  EXPECT_TRUE(matches_reference(picture(LayerId::joints), "layer_joints"));
  EXPECT_TRUE(matches_reference(picture(LayerId::contacts), "layer_contacts"));
  EXPECT_TRUE(matches_reference(picture(LayerId::mass), "layer_masses"));
  EXPECT_TRUE(matches_reference(picture(LayerId::wireframe, LayerId::velocities), "layer_wireframe_velocities"));
}

// Without this, the comparison could miss what users look for in these pictures.
TEST_F(LayerPictures, WithoutOneSmallThingAreNotTakenForTheReference) {
  const auto picture = [&](Workbench& bench, LayerId layer, std::optional<LayerId> other = {}) {
    Layers layers;
    layers.show(layer);
    if (other) layers.show(*other);
    return take(*bench.frame_, bench.camera, layers);
  };
  {
    Workbench bench;
    bench.frame_->contacts.pop_back();
    EXPECT_TRUE(differs_from_reference(picture(bench, LayerId::contacts), "layer_contacts")) << "the ball's force";
  }
  {
    Workbench bench;
    bench.structure->objects[bench.structure->bodies[4].object].local_name.clear();
    const Image image = picture(bench, LayerId::frames, LayerId::names);
    EXPECT_TRUE(differs_from_reference(image, "layer_frames_names")) << "the ball's name";
  }
  {
    Workbench bench;
    bench.frame_->bodies[3].twist_world.linear = {};
    const Image image = picture(bench, LayerId::wireframe, LayerId::velocities);
    EXPECT_TRUE(differs_from_reference(image, "layer_wireframe_velocities")) << "the lever's arrow";
  }
  {
    Workbench bench;
    bench.frame_->joints[0].commanded = bench.frame_->joints[0].position;
    EXPECT_TRUE(differs_from_reference(picture(bench, LayerId::joints), "layer_joints")) << "the hinge's set point";
  }
}

TEST_F(LayerPictures, OfTwoUsersPicks) {
  Workbench bench;
  bench.frame_->picks = {{0, 1, {0.15, 0, 0.05}, {0.5, -0.75, 0.7}, {10, -20, 40}},
                         {1, 3, {0.04, 0.2, 0.04}, {0.3, 0.6, 0.75}, {0.1, 0.3, 0.2}}};
  EXPECT_TRUE(matches_reference(take(*bench.frame_, bench.camera, Layers{}), "picks"));
}

TEST_F(LayerPictures, OfARobotsJointsAndCollisionShapes) {
  AMBF_NEEDS_COMPAT();
  testing::StillSimulation simulation({});
  simulation.load(compat::model("robots/blender-psm.yaml"));
  const state::Frame* frame = simulation.frame();
  ASSERT_NE(frame, nullptr);
  Sphere robot{{}, -1.0};
  for (std::size_t slot = 0; slot < frame->bodies.size(); ++slot) {
    Sphere bounds = bounds_of(frame->structure->bodies[slot]);
    bounds.centre = frame->bodies[slot].T_world_body * bounds.centre;
    const state::ObjectInfo& object = frame->structure->objects[frame->structure->bodies[slot].object];
    if (object.name.find("psm") != std::string::npos) robot = around(robot, bounds);
  }
  ASSERT_GT(robot.radius, 0.0);
  robot.radius *= 0.75;
  Camera camera;  // from the front right and above, all of the sphere in the picture
  const double radius = 1.1 * robot.radius, distance = radius / std::sin(camera.field_of_view_rad / 2.0);
  const math::Vec3 direction = math::normalized(math::Vec3{1.0, 0.55, 0.6});
  camera.T_world_camera = looking_at(robot.centre + distance * direction, robot.centre);
  camera.near_m = std::max(0.02 * radius, distance - 2.0 * radius) / 2.0;
  camera.far_m = 4.0 * (distance + radius);
  Layers layers;
  layers.show(LayerId::joints);
  layers.show(LayerId::collision);
  EXPECT_TRUE(matches_reference(take(*frame, camera, layers, 640, 480), "layer_psm"));
}

}  // namespace
}  // namespace ambf::render
