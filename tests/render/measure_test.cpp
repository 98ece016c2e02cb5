// Measuring: clicks in, points, numbers and drawing out.
#include "render/window/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "math/rotation.h"
#include "panel_rig.h"
#include "render/window/scene_marks.h"
#include "scenes.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

// The panel's scene from above, without the panel: the table's top is at z = 1 and ends at x = +-1, y = +-1.
struct MeasureRig : PanelRig {
  MeasureRig() : PanelRig("", 800, 800, 1.0) {
    ui.set_open(false);
    layers.show(LayerId::collision);  // its bodies have nothing else to show
    pictures(2);
    look_at({0, 0, 0});
  }
  void look_at(const math::Vec3& target) {
    view->move({looking_at({0, 0, 4}, target), 3.0}, now_ns);
    view->rest();
    pictures(2);
  }
  // Where a point of the world is in the window.
  At at_point(const math::Vec3& p) const {
    const Mat4 m = projection_matrix(moment.camera, moment.sizes.width / moment.sizes.height) *
                   view_matrix(moment.camera.T_world_camera);
    const std::array<double, 4> clip = transform(m, p);
    return {0.5 * (1.0 + clip[0] / clip[3]) * moment.sizes.width,
            0.5 * (1.0 - clip[1] / clip[3]) * moment.sizes.height};
  }
  bool press(const math::Vec3& p) {
    const At where = at_point(p);
    return marks.on_input(moment, ButtonInput{MouseButton::left, true, {}, where.x, where.y});
  }
  std::vector<math::Vec3> points() { return measure.points(*rig.frame().structure, *moment.poses); }
  std::vector<std::string> texts() {
    WorldShapes debug;
    marks.draw_debug(moment, debug);
    std::vector<std::string> all;
    for (const DebugText& text : debug.texts()) all.push_back(text.text);
    return all;
  }

  SceneMarks marks{nullptr};
};

bool has(const std::vector<std::string>& all, const std::string& text) {
  return std::find(all.begin(), all.end(), text) != all.end();
}

TEST(Measure, ShowsTheDistanceOfTwoPointsAndTheAngleAtTheSecondOfThree) {
  MeasureRig rig;
  EXPECT_FALSE(rig.press({-0.5, 0.5, 1.0})) << "not before it is on";
  EXPECT_TRUE(rig.marks.on_input(rig.moment, KeyInput{"D", {false, false, true}, false, false}));
  ASSERT_TRUE(rig.measure.on());
  EXPECT_TRUE(rig.press({-0.5, 0.5, 1.0}));
  EXPECT_TRUE(rig.press({-0.5, -0.5, 1.0}));
  ASSERT_EQ(rig.points().size(), 2u);
  EXPECT_LT(math::norm(rig.points()[0] - math::Vec3{-0.5, 0.5, 1.0}), 1e-4);
  EXPECT_TRUE(has(rig.texts(), "1.000 m"));
  EXPECT_TRUE(rig.press({0.2, -0.5, 1.0}));
  EXPECT_TRUE(has(rig.texts(), "700.0 mm"));
  EXPECT_TRUE(has(rig.texts(), "90.0\u00b0"));
  EXPECT_TRUE(rig.press({0.0, 0.5, 1.0}));
  EXPECT_EQ(rig.points().size(), 1u) << "begins anew";
  EXPECT_TRUE(rig.marks.on_input(rig.moment, KeyInput{"Esc", {}, false, false})) << "does not end the program";
  EXPECT_FALSE(rig.measure.on());
  EXPECT_TRUE(rig.texts().empty());
  EXPECT_FALSE(rig.marks.on_input(rig.moment, KeyInput{"Esc", {}, false, false})) << "the window's again";
}

TEST(Measure, PicksNothingBesideThings) {
  MeasureRig rig;
  rig.measure.set_on(true);
  rig.press({0.5, 0.0, 1.1});  // on the box
  ASSERT_EQ(rig.points().size(), 1u);
  EXPECT_NEAR(rig.points()[0].z, 1.1, 1e-3);
  rig.look_at({0, 0, 9});
  EXPECT_TRUE(rig.press({0, 0, 9})) << "a click into the sky moves no camera, either";
  EXPECT_EQ(rig.points().size(), 1u);
  const PanelRig::At at = rig.at_point({0, 0, 9});
  EXPECT_FALSE(rig.marks.on_input(rig.moment, ButtonInput{MouseButton::right, true, {}, at.x, at.y}));
  EXPECT_FALSE(rig.marks.on_input(rig.moment, ButtonInput{MouseButton::left, true, {true, false, false}, at.x, at.y}))
      << "dragging bodies goes on";
}

TEST(SurfaceRay, MeetsTheNearestThatIsShown) {
  testing::SceneMaker scene;
  const mesh::SurfaceMaterial red = testing::matte(1, 0, 0);
  scene.body(mesh::make_box(0.2, 1.0, 1.0), {{1, 0, 0}, math::from_axis_angle({1, 0, 0}, 0.3)}, &red);
  scene.body(mesh::make_sphere(0.5), {{-1, 0, 0}, {}}, &red);
  const auto meets = [&](const std::vector<BodyLook>& looks, bool shapes, const Ray& ray) {
    return first_surface(*scene.structure, scene.bodies, looks, shapes, ray);
  };
  const Ray along{{3, 0.1, 0}, {-9, 0.1, 0}};
  auto hit = meets({}, false, along);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, 0u);
  EXPECT_LT(math::norm(hit->point_world - math::Vec3{1.1, 0.1, 0}), 1e-7);
  EXPECT_LT(math::norm(scene.bodies[0] * hit->point_body - hit->point_world), 1e-9);
  hit = meets({{true, false, 1.0F}}, false, along);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, 1u) << "the first is hidden";
  EXPECT_NEAR(hit->point_world.x, -1.0 + std::sqrt(0.25 - 0.01), 5e-3);
  EXPECT_TRUE(meets({{false, true, 0.2F}}, false, along)->body == 0) << "what can be seen can be met";
  scene.structure->bodies[0].collision_appearance = scene.structure->bodies[0].appearance;
  EXPECT_EQ(meets({{true, false, 1.0F}}, true, along)->body, 0u) << "by its collision shape";
  EXPECT_FALSE(meets({}, true, {{3, 0.1, 0}, {1.2, 0.1, 0}})) << "it ends before";
  EXPECT_FALSE(meets({}, true, {{3, 5, 0}, {-9, 5, 0}}));
}

TEST(Measure, PointsStayOnBodiesThatMove) {
  MeasureRig rig;
  rig.measure.set_on(true);
  rig.press({0.5, 0.0, 1.1});
  rig.press({-0.5, 0.0, 1.0});
  const double before = math::norm(rig.points()[1] - rig.points()[0]);
  state::Push push;
  push.force_world = {20, 0, 0};
  push.seconds = 0.2;
  const double x = rig.rig.body("BODY box").T_world_body.position.x;
  rig.model.run.push(rig.rig.id("BODY box"), push);
  rig.run(200);
  const double moved = rig.rig.body("BODY box").T_world_body.position.x - x;
  ASSERT_GT(moved, 0.05);
  EXPECT_GT(math::norm(rig.points()[1] - rig.points()[0]), before + 0.8 * moved);
  ASSERT_TRUE(rig.rig.wait_for([&](state::Completion done) { rig.rig.simulation.remove("/test/box", std::move(done)); })
                  .success);
  rig.pictures(2);
  rig.texts();
  EXPECT_TRUE(rig.points().empty()) << "one of them is gone";
  rig.press({-0.5, 0.0, 1.0});
  EXPECT_EQ(rig.points().size(), 1u);
}

TEST(Measure, ThePanelStartsAndEndsItAndShowsTheNumbers) {
  MeasureRig rig;
  rig.ui.set_open(true);
  rig.pictures(3);
  rig.tab("View");
  rig.click("measure/on");
  ASSERT_TRUE(rig.measure.on());
  EXPECT_FALSE(rig.shown("measure/distance/1"));
  rig.press({-0.5, 0.5, 1.0});
  rig.press({-0.5, -0.5, 1.0});
  rig.pictures(2);
  EXPECT_TRUE(rig.shown("measure/distance/1"));
  EXPECT_FALSE(rig.shown("measure/angle"));
  rig.press({0.2, -0.5, 1.0});
  rig.pictures(2);
  EXPECT_TRUE(rig.shown("measure/distance/2"));
  EXPECT_TRUE(rig.shown("measure/angle"));
  rig.click("measure/on");
  EXPECT_FALSE(rig.measure.on());
  EXPECT_FALSE(rig.shown("measure/angle"));
}

TEST(Measure, TextsAreAsFineAsTheyCanBeRead) {
  EXPECT_EQ(Measure::distance_text(0.0012345), "1.234 mm");
  EXPECT_EQ(Measure::distance_text(0.0512), "51.20 mm");
  EXPECT_EQ(Measure::distance_text(0.75), "750.0 mm");
  EXPECT_EQ(Measure::distance_text(12.3456), "12.346 m");
  EXPECT_NEAR(Measure::angle_rad({1, 0, 0}, {}, {-1, 0, 0}), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace ambf::render
