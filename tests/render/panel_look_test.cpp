// How single bodies look in a window, and hidden visuals: events in, state and pictures out.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "offscreen_fixture.h"
#include "panel_rig.h"
#include "render/marks/layer_shapes.h"
#include "render/pictures/extras.h"
#include "scenes.h"

namespace ambf::render {
namespace {

using testing::matte;
using testing::PanelRig;
using testing::SceneMaker;

// --- 16: looks of single bodies.

TEST(PanelLook, HidesABodyInThisWindowOnly) {
  PanelRig rig;
  const state::ObjectId box = rig.rig.id("BODY box"), table = rig.rig.id("BODY table");
  const std::uint64_t before = state::state_hash(rig.rig.frame());
  rig.model.selection.select(box);
  rig.pictures(3);
  rig.click("look/shown", 0.2);
  EXPECT_TRUE(rig.looks.of(box).hidden);
  EXPECT_FALSE(rig.looks.of(table).hidden);
  rig.click("look/shown", 0.2);
  EXPECT_FALSE(rig.looks.any()) << "as it was loaded";
  rig.click("look/wireframe", 0.2);
  EXPECT_TRUE(rig.looks.of(box).wireframe);
  rig.drag("look/opacity", 0.98, 0.4);
  EXPECT_NEAR(rig.looks.of(box).opacity, 0.4F, 0.06F);
  EXPECT_EQ(state::state_hash(rig.rig.frame()), before) << "physics knows nothing of it";
  rig.click("look/revert");
  EXPECT_FALSE(rig.looks.any());
}

TEST(PanelLook, AllBodiesOfAModelLookAlike) {
  PanelRig rig;
  rig.model.selection.select(rig.rig.id("BODY upper"));
  rig.pictures(3);
  rig.click("look/wireframe", 0.2);
  rig.click("look/model");
  for (const char* name : {"BODY table", "BODY box", "BODY base", "BODY lower"}) {
    EXPECT_TRUE(rig.looks.of(rig.rig.id(name)).wireframe) << name;
  }
}

TEST(PanelLook, WhatIsLoadedInTheSamePlaceLooksAsLoaded) {
  BodyLooks looks;
  looks.set({3, 1}, {true, false, 1.0F});
  EXPECT_TRUE(looks.of({3, 1}).hidden);
  EXPECT_FALSE(looks.of({3, 2}).hidden);
}

TEST(PanelLook, WireframesAreDrawnOfWhatAsksForThem) {
  SceneMaker scene;
  const mesh::SurfaceMaterial red = matte(1, 0, 0);
  for (int i = 0; i < 3; ++i) scene.body(mesh::make_box(0.2, 1.0, 1.0), {{1.0 * i, 0, 0}, {}}, &red);
  const auto frame = scene.frame();
  Motion motion;
  motion.take(*frame);
  LayerInput input{*frame, motion.at(frame->steady_ns), {}, PixelScale({}, 64, 64, 1.0)};
  input.looks = {{}, {false, true, 1.0F}, {true, true, 1.0F}};
  const auto meshes = [&](const Layers& layers) {
    WorldShapes debug;
    draw_layers(layers, input, debug);
    return debug.meshes().size();
  };
  EXPECT_EQ(meshes({}), 1u) << "the second; the third is hidden";
  Layers all;
  all.show(LayerId::wireframe);
  EXPECT_EQ(meshes(all), 2u);
}

class LookPictures : public testing::OffscreenFixture {
 protected:
  // A red box before a white wall, seen from +x.
  LookPictures() {
    const mesh::SurfaceMaterial red = matte(1, 0, 0), white = matte(1, 1, 1);
    scene.body(mesh::make_box(0.2, 1.0, 1.0), {}, &red);
    scene.body(mesh::make_box(0.2, 9.0, 9.0), {{-2, 0, 0}, {}}, &white);
    camera.T_world_camera = {{3, 0, 0}, {}};
    camera.near_m = 0.1;
    camera.far_m = 20.0;
  }
  std::array<int, 3> middle(const BodyLook& of_box, bool no_visuals = false) {
    const auto frame = scene.frame();
    BodyLooks looks;
    looks.set(frame->structure->objects[frame->structure->bodies[0].object].id, of_box);
    Extras extras;
    extras.looks = looks.by_slot(*frame->structure, no_visuals);
    Image image;
    std::string why;
    EXPECT_TRUE(offscreen_->picture(*frame, camera, 64, 64, image, diagnostics_, why, {}, &extras)) << why;
    const std::uint8_t* p = &image.rgba[4 * (32 * 64 + 32)];
    return {p[0], p[1], p[2]};
  }

  SceneMaker scene;
  Camera camera;
};

TEST_F(LookPictures, ABodyIsShownHiddenOrSeenThrough) {
  const auto shown = middle({}), hidden = middle({true, false, 1.0F}), half = middle({false, false, 0.5F});
  const auto greenness = [](const auto& c) { return c[1]; };
  EXPECT_GT(shown[0] - shown[1], 60) << "red";
  EXPECT_LT(std::abs(hidden[0] - hidden[1]), 30) << "the white wall";
  EXPECT_GT(greenness(half), greenness(shown) + 15) << "some of the wall";
  EXPECT_LT(greenness(half), greenness(hidden) - 15) << "and some of the box";
  EXPECT_EQ(middle({false, true, 1.0F}), hidden) << "a wireframe's edges are drawn by the window";
  EXPECT_EQ(middle({}), shown) << "nothing is left behind";
}

TEST_F(LookPictures, WithoutVisualsNothingIsLeft) {
  const auto nothing = middle({}, true);
  EXPECT_NE(nothing, middle({true, false, 1.0F})) << "the wall is gone, too";
}

TEST_F(LookPictures, HiddenBodiesThrowNoShadows) {
  // From above: a sheet over a floor, and a light straight above both.
  SceneMaker room;
  const mesh::SurfaceMaterial white = matte(0.8F, 0.8F, 0.8F);
  room.body(mesh::make_box(0.5, 0.5, 0.02), {{0, 0, 1}, {}}, &white);
  room.body(mesh::make_box(6, 6, 0.1), {{0, 0, -0.05}, {}}, &white);
  room.light(testing::shining({0, 0, 4}, {})).beam.shadow_quality = 3;
  Camera side;
  side.T_world_camera = looking_at({2, 0, 0.6}, {0, 0, 0});
  side.far_m = 20.0;
  const auto floor = [&](bool hidden) {
    const auto frame = room.frame();
    BodyLooks looks;
    looks.set(frame->structure->objects[frame->structure->bodies[0].object].id, {hidden, false, 1.0F});
    Extras extras;
    extras.looks = looks.by_slot(*frame->structure);
    Image image;
    std::string why;
    EXPECT_TRUE(offscreen_->picture(*frame, side, 64, 64, image, diagnostics_, why, {}, &extras)) << why;
    return static_cast<int>(image.rgba[4 * (32 * 64 + 32) + 1]);
  };
  const int shaded = floor(false), lit = floor(true);
  EXPECT_GT(lit, shaded + 20);
  EXPECT_EQ(floor(false), shaded);
}

}  // namespace
}  // namespace ambf::render
