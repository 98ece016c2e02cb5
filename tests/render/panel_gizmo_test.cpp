// Arrows and rings in the scene that move the selected object.
#include <gtest/gtest.h>

#include <numbers>

#include "fake_abilities.h"
#include "math/rotation.h"
#include "offscreen_fixture.h"
#include "panel_rig.h"
#include "reference_picture.h"
#include "render/camera/camera.h"
#include "render/marks/label_layout.h"
#include "render/panel/relations.h"
#include "render/pictures/extras.h"
#include "render/pictures/offscreen.h"
#include "scenes.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

// --- 17: the gizmo.

class PanelGizmo : public ::testing::Test {
 protected:
  PanelGizmo() : rig("", 1600, 1200, 1.0) {}

  void select(state::ObjectId object) {
    rig.model.selection.select(object);
    rig.pictures(3);
    rig.click("gizmo/shown", 0.1);
    // From aside, so that no axis points at the viewer.
    rig.view->move({looking_at(at() + math::Vec3{3.0, -2.0, 1.6}, at()), 3.0}, 0);
    rig.pictures(2);
  }
  state::ObjectId object(const std::string& name, state::ObjectKind kind) {
    const auto all = rig.rig.simulation.structure();
    return all->objects[state::find(*all, name, kind)].id;
  }
  math::Pose pose() {
    math::Pose T;
    EXPECT_TRUE(GizmoHand::pose_of(rig.rig.frame(), rig.model.selection.id(), T));
    return T;
  }
  math::Vec3 at() { return pose().position; }
  GizmoShape shape() {
    const auto found = rig.model.gizmo.shape(rig.moment, rig.model.selection.id());
    EXPECT_TRUE(found);
    return found.value_or(GizmoShape{});
  }
  // Where a point of the world is in the window.
  PanelRig::At place(const math::Vec3& point) {
    const Camera& camera = rig.moment.camera;
    const auto clip = transform(projection_matrix(camera, rig.moment.sizes.width / rig.moment.sizes.height) *
                                    view_matrix(camera.T_world_camera),
                                point);
    return {0.5 * (1.0 + clip[0] / clip[3]) * rig.moment.sizes.width,
            0.5 * (1.0 - clip[1] / clip[3]) * rig.moment.sizes.height};
  }
  bool press(const PanelRig::At& where, Modifiers modifiers = {}) {
    rig.put(MotionInput{where.x, where.y, false});
    rig.picture();
    const bool taken = rig.put(ButtonInput{MouseButton::left, true, modifiers, where.x, where.y});
    rig.picture();
    return taken;
  }
  void go(const PanelRig::At& where) {
    EXPECT_TRUE(rig.put(MotionInput{where.x, where.y, false}));
    rig.picture();
  }
  void release(const PanelRig::At& where) {
    EXPECT_TRUE(rig.put(ButtonInput{MouseButton::left, false, {}, where.x, where.y}));
    rig.picture();
  }
  // Points of the handles.
  math::Vec3 on_arrow(int axis, double part = 0.6) {
    return shape().centre + part * shape().arrow_m * axis_of({false, axis});
  }
  // Of the z ring, which lies flat: where it is nearest to the viewer, turned by an angle.
  math::Vec3 on_ring(double angle_rad) {
    const math::Vec3 viewer = rig.moment.camera.T_world_camera.position - shape().centre;
    const math::Vec3 flat = math::normalized(math::Vec3{viewer.x, viewer.y, 0.0});
    return shape().centre + shape().ring_m * math::rotate(math::from_axis_angle({0, 0, 1}, angle_rad), flat);
  }
  // Shows what the simulation makes of it until the object is there.
  template <class Condition>
  bool until(Condition good) {
    for (int i = 0; i < 2000; ++i) {
      if (good()) {
        rig.pictures(3);
        return true;
      }
      rig.picture();
      if (running_) rig.rig.step(2);
      rig.rig.reader->wait_newer(rig.rig.frame().sequence, std::chrono::milliseconds(10));
    }
    return false;
  }
  // The steps are those of until(): the Step service holds the clock.
  void run_freely() {
    running_ = true;
    rig.rig.simulation.set_paused(false);
    ASSERT_TRUE(rig.until([](const state::Frame& frame) { return !frame.run.paused; }));
  }

  PanelRig rig;

 private:
  bool running_ = false;
};

TEST_F(PanelGizmo, AnArrowShiftsALightAlongItsAxisAndARingTurnsIt) {
  select(object("lamp", state::ObjectKind::light));
  const math::Pose before = pose();
  // As far as the point under the pointer goes.
  const math::Vec3 from = on_arrow(1), to = from + math::Vec3{0, 0.25, 0};
  ASSERT_TRUE(press(place(from)));
  ASSERT_TRUE(rig.model.gizmo.dragging());
  go(place(to));
  ASSERT_TRUE(until([&] { return std::abs(at().y - before.position.y - 0.25) < 1e-4; })) << at().y;
  release(place(to));
  rig.pictures(20);
  EXPECT_NEAR(at().y, before.position.y + 0.25, 1e-4) << "it stays";
  EXPECT_NEAR(at().x, before.position.x, 1e-9);
  EXPECT_NEAR(at().z, before.position.z, 1e-9);

  const PanelRig::At a = place(on_ring(0.0)), b = place(on_ring(0.5));
  ASSERT_TRUE(press(a));
  go(b);
  release(b);
  ASSERT_TRUE(until([&] {
    const math::Vec3 turned = math::log(pose().orientation * math::inverse(before.orientation));
    return math::norm(turned - math::Vec3{0, 0, 0.5}) < 1e-3;
  }));
  EXPECT_NEAR(at().y, before.position.y + 0.25, 1e-4) << "turned about itself";
}

TEST_F(PanelGizmo, MovesACameraThatTheWindowDoesNotLookThrough) {
  select(object("eye", state::ObjectKind::camera));
  const double before = at().z;
  const math::Vec3 from = on_arrow(2), to = from + math::Vec3{0, 0, -0.1};
  ASSERT_TRUE(press(place(from)));
  go(place(to));
  release(place(to));
  EXPECT_TRUE(until([&] { return std::abs(at().z - before + 0.1) < 1e-4; }));
  rig.camera = rig.model.selection.id();
  rig.pictures(3);
  EXPECT_FALSE(rig.model.gizmo.shape(rig.moment, rig.model.selection.id())) << "it would be all around the viewer";
}

TEST_F(PanelGizmo, MovesAStaticBodyRunningAndPaused) {
  select(rig.rig.id("BODY base"));
  EXPECT_FALSE(shape().rings) << "nothing would turn it while paused";
  const math::Vec3 before = at();
  math::Vec3 from = on_arrow(0), to = from + math::Vec3{0.2, 0, 0};
  ASSERT_TRUE(press(place(from)));
  go(place(to));
  ASSERT_TRUE(until([&] { return std::abs(at().x - before.x - 0.2) < 1e-4; })) << at().x;
  release(place(to));

  run_freely();
  EXPECT_TRUE(shape().rings);
  ASSERT_TRUE(press(place(on_ring(0.0))));
  const PanelRig::At turned = place(on_ring(-0.4));
  go(turned);
  release(turned);
  EXPECT_TRUE(until([&] { return std::abs(math::log(pose().orientation).z + 0.4) < 1e-3; }))
      << math::log(pose().orientation).z;
  EXPECT_NEAR(at().x, before.x + 0.2, 1e-4);
}

TEST_F(PanelGizmo, ShiftsAMovingBodyWhilePausedAndPullsItWhileRunning) {
  select(rig.rig.id("BODY box"));
  const math::Vec3 before = at();
  math::Vec3 from = on_arrow(2), to = from + math::Vec3{0, 0, 0.3};
  ASSERT_TRUE(press(place(from)));
  go(place(to));
  ASSERT_TRUE(until([&] { return std::abs(at().z - before.z - 0.3) < 1e-4; })) << at().z;
  release(place(to));
  EXPECT_TRUE(until([&] { return rig.rig.frame().picks.empty(); }));
  EXPECT_NEAR(at().x, before.x, 1e-6);

  ASSERT_TRUE(press(place(on_arrow(2))));
  run_freely();
  EXPECT_TRUE(until([&] { return !rig.rig.frame().picks.empty(); })) << "the spring holds it";
  go(place(on_arrow(2)));
  EXPECT_TRUE(until([&] { return pulled_by(rig.model.frame(), rig.model.selection.id()) > 5.0; }))
      << "up, against its weight";
  release(place(on_arrow(2)));
  EXPECT_TRUE(until([&] { return rig.rig.frame().picks.empty(); }));
}

TEST_F(PanelGizmo, StepsEndOnMultiples) {
  select(object("lamp", state::ObjectKind::light));
  rig.click("gizmo/snaps", 0.1);
  rig.enter("gizmo/snap_mm", "50");
  EXPECT_EQ(rig.model.gizmo.snap_m, 0.05);
  const math::Vec3 from = on_arrow(0), to = from + math::Vec3{0.138, 0, 0};
  ASSERT_TRUE(press(place(from)));
  go(place(to));
  release(place(to));
  EXPECT_TRUE(until([&] { return std::abs(at().x - 0.15) < 1e-9; })) << at().x;
  const PanelRig::At a = place(on_ring(0.0)), b = place(on_ring(0.3));
  const math::Quat before = pose().orientation;
  ASSERT_TRUE(press(a));
  go(b);
  release(b);
  EXPECT_TRUE(until([&] {
    return std::abs(math::log(pose().orientation * math::inverse(before)).z - 15.0 / 180.0 * std::numbers::pi) < 1e-6;
  })) << "15 degrees of 17.2";
}

TEST_F(PanelGizmo, IsNotInTheWayElsewhere) {
  select(object("lamp", state::ObjectKind::light));
  const PanelRig::At on = place(on_arrow(1));
  EXPECT_FALSE(press(on, {true, false, false})) << "Ctrl picks bodies";
  EXPECT_FALSE(press({on.x + 60.0, on.y + 200.0})) << "beside it";
  rig.model.gizmo.shown = false;
  rig.pictures(2);
  EXPECT_FALSE(press(on)) << "not shown";
  rig.model.gizmo.shown = true;
  rig.model.selection.select(rig.joint("elbow"));
  rig.pictures(2);
  EXPECT_FALSE(rig.model.gizmo.shape(rig.moment, rig.model.selection.id())) << "a joint has no pose to move";
}

TEST_F(PanelGizmo, AResetEndsTheDrag) {
  select(object("lamp", state::ObjectKind::light));
  const math::Vec3 before = at(), from = on_arrow(2), to = from + math::Vec3{0, 0, 0.3};
  ASSERT_TRUE(press(place(from)));
  go(place(to));
  ASSERT_TRUE(until([&] { return at().z > before.z + 0.2; }));
  rig.rig.simulation.reset_world();
  ASSERT_TRUE(until([&] { return !rig.model.gizmo.dragging(); }));
  rig.put(MotionInput{place(to).x, place(to).y, false});
  rig.pictures(30);
  EXPECT_NEAR(at().z, before.z, 1e-9);
}

TEST_F(PanelGizmo, CopiesThePoseAsAnAdfFileSaysIt) {
  select(rig.rig.id("BODY table"));
  rig.click("gizmo/copy");
  EXPECT_EQ(rig.clipboard, "location: {position: {x: 0, y: 0, z: 0.9}, orientation: {r: 0, p: 0, y: 0}}\n");
  rig.model.selection.select(object("lamp", state::ObjectKind::light));
  rig.pictures(3);
  rig.click("gizmo/copy");
  EXPECT_EQ(rig.clipboard.rfind("location: {x: 0, y: 0, z: 4}\ndirection: {", 0), 0u) << rig.clipboard;
}

TEST_F(PanelGizmo, IsDrawnAsLargeWhereverTheObjectIs) {
  select(object("lamp", state::ObjectKind::light));
  WorldShapes near, far;
  rig.model.gizmo.draw(rig.moment, rig.model.selection.id(), near);
  const double near_m = shape().arrow_m;
  rig.view->move({looking_at(at() + math::Vec3{6.0, -4.0, 3.2}, at()), 6.0}, 0);
  rig.pictures(2);
  rig.model.gizmo.draw(rig.moment, rig.model.selection.id(), far);
  EXPECT_NEAR(shape().arrow_m / near_m, 2.0, 1e-6);
  EXPECT_GT(near.lines(Seen::always).size(), 6u);
  EXPECT_EQ(near.lines(Seen::always).size(), far.lines(Seen::always).size());
}

// How it looks: an arrow under the pointer, and a ring while it is dragged.
class GizmoPicture : public testing::OffscreenFixture {
 protected:
  Image take(const state::Frame& frame, const Camera& camera, const WorldShapes& debug, int width, int height) {
    const auto letters = std::make_shared<const Lettering>(1.0);
    TextDrawing text(letters, width, height);
    draw_labels(lay_out(debug.texts(), camera, width, height, *letters), text);
    const Extras extras{{}, &debug, &text};
    Image image;
    std::string why;
    EXPECT_TRUE(offscreen_->picture(frame, camera, width, height, image, diagnostics_, why, {}, &extras)) << why;
    return image;
  }
};

TEST_F(GizmoPicture, AnArrowUnderThePointerAndARingThatIsDragged) {
  constexpr int kWidth = 480, kHeight = 300;
  const mesh::SurfaceMaterial blue = testing::matte(0.15F, 0.3F, 0.6F);
  testing::SceneMaker scene;
  scene.body(mesh::make_box(0.3, 0.3, 0.3), {{0, -0.6, 0}, {}}, &blue);
  scene.body(mesh::make_box(0.3, 0.3, 0.3), {{0, 0.6, 0}, {}}, &blue);
  state::Frame frame = *scene.frame();
  testing::FakeAbilities abilities;
  Gizmo gizmo(abilities, abilities);
  gizmo.shown = true;
  ViewCamera view(abilities, abilities, {});
  view.move({looking_at({2.2, 0.6, 1.2}, {0, 0, 0}), 2.5}, 0);
  Motion motion;
  motion.take(frame);
  const ScenePoses& poses = motion.at(frame.steady_ns);
  view.follow(frame, poses, {}, 1.6, 0);
  WindowMoment moment;
  moment.window = 1;
  moment.frame = &frame;
  moment.poses = &poses;
  moment.view = &view;
  moment.camera = view.camera();
  moment.camera.field_of_view_rad = 0.9;
  moment.sizes.picture_width = kWidth, moment.sizes.picture_height = kHeight;
  moment.sizes.width = kWidth, moment.sizes.height = kHeight;
  const auto id = [&](std::size_t slot) { return frame.structure->objects[frame.structure->bodies[slot].object].id; };
  const auto pointer_on = [&](const math::Vec3& point) {
    const auto clip = transform(projection_matrix(moment.camera, moment.sizes.width / moment.sizes.height) *
                                    view_matrix(moment.camera.T_world_camera),
                                point);
    return PanelRig::At{0.5 * (1.0 + clip[0] / clip[3]) * kWidth, 0.5 * (1.0 - clip[1] / clip[3]) * kHeight};
  };
  std::string told;
  WorldShapes debug;
  const GizmoShape left = gizmo.shape(moment, id(0)).value();
  const auto arrow = pointer_on(left.centre + 0.7 * left.arrow_m * math::Vec3{0, 0, 1});
  EXPECT_FALSE(gizmo.on_input(moment, MotionInput{arrow.x, arrow.y, false}, id(0), told));
  EXPECT_EQ(gizmo.under_pointer(), (GizmoHandle{false, 2}));
  gizmo.draw(moment, id(0), debug);

  const GizmoShape right = gizmo.shape(moment, id(1)).value();
  const auto from = pointer_on(right.centre + right.ring_m * math::normalized(math::Vec3{1, 0.3, 0}));
  const auto to = pointer_on(right.centre + right.ring_m * math::normalized(math::Vec3{0.6, 1, 0}));
  EXPECT_TRUE(gizmo.on_input(moment, ButtonInput{MouseButton::left, true, {}, from.x, from.y}, id(1), told));
  EXPECT_TRUE(gizmo.on_input(moment, MotionInput{to.x, to.y, false}, id(1), told));
  gizmo.draw(moment, id(1), debug);
  EXPECT_TRUE(testing::matches_reference(take(frame, moment.camera, debug, kWidth, kHeight), "panel_gizmo"));
}

}  // namespace
}  // namespace ambf::render
