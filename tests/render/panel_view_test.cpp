// The view, cameras, lights, layers and pictures of a window, from the panel.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "no_ffmpeg.h"
#include "panel_rig.h"
#include "render/panel/sections/sections.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

// --- 8: layers.

TEST(Panel, SwitchesLayers) {
  PanelRig rig;
  rig.tab("View");
  rig.click("layer/Contacts", 0.1);
  EXPECT_TRUE(rig.layers.shows(LayerId::contacts));
  rig.click("layer/Contacts", 0.1);
  EXPECT_FALSE(rig.layers.shows(LayerId::contacts));
  for (const LayerInfo& one : all_layers()) EXPECT_TRUE(rig.shown("layer/" + one.label));
}

TEST(Panel, HidesVisualsSoThatCollisionShapesAreSeenAlone) {
  PanelRig rig;
  rig.tab("View");
  rig.click("layer/Hide visuals", 0.1);
  EXPECT_TRUE(rig.layers.shows(LayerId::no_visuals));
  for (const BodyLook& look : rig.looks.by_slot(rig.model.structure(), rig.layers.shows(LayerId::no_visuals))) {
    EXPECT_FALSE(look.has_faces());
  }
  EXPECT_FALSE(rig.looks.any()) << "what single bodies look like is kept";
  rig.click("layer/Hide visuals", 0.1);
  EXPECT_TRUE(rig.looks.by_slot(rig.model.structure(), rig.layers.shows(LayerId::no_visuals)).empty());
}

// --- 10: views.

TEST(Panel, LooksFromTheSidesCentresAndCopiesTheCamera) {
  PanelRig rig;
  rig.tab("View");
  rig.click("view/Left");
  const math::Vec3 at = rig.view->camera().T_world_camera.position, target = target_of(rig.view->view());
  EXPECT_LT(at.y, target.y - 0.1);
  EXPECT_NEAR(at.x, target.x, 1e-6);
  rig.model.selection.select(rig.rig.id("BODY box"));
  rig.pictures(2);
  rig.click("view/centre");
  EXPECT_LT(math::norm(target_of(rig.view->view()) - rig.rig.body("BODY box").T_world_body.position), 1e-6);
  rig.click("view/copy");
  EXPECT_NE(rig.clipboard.find("look at: {x: 0.5"), std::string::npos) << rig.clipboard;
}

TEST(Panel, StereoSaysWhatItDoesAndHowFarApartTheEyesAre) {
  PanelRig rig;
  rig.tab("View");
  rig.click("view/object//test/eye");
  rig.tab("Objects");
  const auto told = [&rig](const std::string& text) {
    const std::vector<std::string> lines = rig.said();
    return std::any_of(lines.begin(), lines.end(), [&](const auto& l) { return l.find(text) != std::string::npos; });
  };
  rig.click("lens/stereo");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.cameras[0].lens.stereo; }));
  EXPECT_TRUE(told("side by side, 200 mm apart; what is 500 mm away"));
  rig.click("lens/stereo");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return !frame.cameras[0].lens.stereo; }));
  EXPECT_TRUE(told("stereo off"));
}

TEST(Panel, ChangesLensesAndBeamsAndTakesThemBack) {
  PanelRig rig;
  const state::Structure& all = rig.model.structure();
  ASSERT_EQ(all.cameras.size(), 1u);
  ASSERT_EQ(all.lights.size(), 1u);
  rig.tab("View");
  rig.click("view/object//test/eye");
  rig.tab("Objects");
  rig.enter("lens/far", "25");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.cameras[0].lens.far_m == 25.0; }));
  rig.click("lens/revert");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.cameras[0].lens.far_m == 10.0; }));
  rig.enter("lens/near", "50");  // beyond the far plane: said, not done
  EXPECT_EQ(rig.rig.frame().cameras[0].lens.near_m, 0.1);
  const auto lines = rig.said();
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& l) { return l.find("lens:") == 0; }));

  rig.model.selection.select(all.objects[all.lights[0].object].id);
  rig.pictures(3);
  rig.enter("beam/cone", "30");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) {
    return std::abs(frame.lights[0].beam.cutoff_angle_rad - 0.5235987755982988) < 1e-9;
  }));
}

TEST(Panel, FollowsABody) {
  PanelRig rig;
  rig.rig.simulation.set_gravity({});
  rig.model.selection.select(rig.rig.id("BODY box"));
  rig.tab("View");
  rig.click("view/follow", 0.1);
  const math::Vec3 before = rig.view->camera().T_world_camera.position;
  state::Push push;
  push.force_world = {0, 0, 5};
  push.seconds = 0.1;
  const double z = rig.rig.body("BODY box").T_world_body.position.z;
  rig.model.run.push(rig.rig.id("BODY box"), push);
  rig.run(500);
  rig.pictures(2);
  const double risen = rig.rig.body("BODY box").T_world_body.position.z - z;
  ASSERT_GT(risen, 0.1);
  EXPECT_NEAR(rig.view->camera().T_world_camera.position.z - before.z, risen, 1e-3);
}

// --- 10: through which camera.

TEST(Panel, ChoosesTheCameraOfTheWindow) {
  PanelRig rig;
  rig.tab("View");
  const state::Structure& all = rig.model.structure();
  const state::ObjectId eye = all.objects[all.cameras[0].object].id;
  ASSERT_FALSE(rig.view->object().valid());
  rig.click("view/camera");
  rig.click("view/camera//test/eye");
  EXPECT_EQ(rig.view->object(), eye);
  rig.pictures(2);
  EXPECT_LT(math::norm(rig.view->camera().T_world_camera.position - math::Vec3{3, 0, 2}), 1e-6);
  EXPECT_FALSE(rig.shown("view/go//test/eye")) << "it is there already";
  rig.click("view/camera");
  rig.click("view/camera/Free view");
  EXPECT_FALSE(rig.view->object().valid());
}

TEST(Panel, GoesToWhereAnotherCameraIs) {
  PanelRig rig;
  rig.tab("View");
  rig.click("view/go//test/eye");
  EXPECT_FALSE(rig.view->object().valid()) << "it is the window's own view that moved";
  EXPECT_LT(math::norm(rig.view->camera().T_world_camera.position - math::Vec3{3, 0, 2}), 1e-6);
}

TEST(Panel, TheNextCameraComesAfterTheLastAgain) {
  PanelRig rig;
  const state::Structure& all = rig.model.structure();
  const state::ObjectId eye = all.objects[all.cameras[0].object].id;
  EXPECT_EQ(next_camera(all, {}), eye);
  EXPECT_FALSE(next_camera(all, eye).valid());
}

TEST(ViewCamera, OfAWindowsOwnBeginsWhereTheOneBeforeWas) {
  PanelRig rig;
  const state::Structure& all = rig.model.structure();
  rig.camera = all.objects[all.cameras[0].object].id;
  rig.pictures(2);
  ViewCamera own(rig.rig.simulation, rig.rig.simulation, {});
  own.begin_like(*rig.view);
  EXPECT_FALSE(own.wants_framing());
  own.follow(*rig.moment.frame, *rig.moment.poses, {}, 1.0, rig.now_ns);
  EXPECT_TRUE(own.camera().T_world_camera == rig.view->camera().T_world_camera);
}

// --- 19: screenshots and films.

class PanelPictures : public ::testing::Test {
 protected:
  PanelPictures() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  ~PanelPictures() override { std::filesystem::remove_all(folder); }

  std::vector<std::string> files(const std::string& ending) const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ending) found.push_back(entry.path().filename().string());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  static bool said(PanelRig& rig, const std::string& text) {
    return rig.rig.wait_until([&](const state::Frame&) {
      const auto lines = rig.said();
      return std::any_of(lines.begin(), lines.end(), [&](const auto& l) { return l.find(text) != l.npos; });
    });
  }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("ambf_panel_pictures" + std::to_string(getpid()));
};

TEST_F(PanelPictures, ScreenshotsAreNamedByDateInTheChosenFolder) {
  PanelRig rig;
  rig.tab("View");
  rig.click("pictures/folder");
  rig.type(folder.string());
  rig.click("pictures/screenshot");
  rig.click("pictures/screenshot");
  ASSERT_TRUE(said(rig, "screenshot: " + folder.string()));
  ASSERT_TRUE(rig.rig.wait_until([&](const state::Frame&) { return files(".png").size() == 2; }))
      << "the second of the same second has another name";
  EXPECT_EQ(files(".png")[0].rfind("ambf_20", 0), 0u) << files(".png")[0];
}

TEST_F(PanelPictures, WhatCannotBeWrittenIsSaid) {
  PanelRig rig;
  rig.rig.log.expect_warning("no screenshot: ");
  rig.rig.log.expect_warning("no film: ");
  rig.model.settings.picture_folder = (folder / "is not there").string();
  rig.tab("View");
  rig.click("pictures/screenshot");
  EXPECT_TRUE(said(rig, "no screenshot: "));
  rig.click("pictures/film");
  EXPECT_TRUE(said(rig, "no film: "));
  EXPECT_TRUE(rig.rig.wait_until([&](const state::Frame&) { return !rig.recorder.filming(); }));
  EXPECT_TRUE(files(".mp4").empty());
}

// Pictures are left out while the encoder is behind, and made up for by a later one.
bool lasts(PanelRig& rig, double seconds, double tolerance) {
  for (int i = 0; i < 3000 && std::abs(rig.recorder.film_s() - seconds) > tolerance; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    rig.pictures(1);
  }
  return std::abs(rig.recorder.film_s() - seconds) <= tolerance;
}

TEST_F(PanelPictures, AFilmLastsAsLongAsTheSimulationRan) {
  testing::NoFfmpeg no_ffmpeg;  // pictures can be counted
  PanelRig rig;
  rig.model.settings.picture_folder = folder.string();
  rig.tab("View");
  rig.click("pictures/film");
  ASSERT_TRUE(rig.recorder.filming());
  rig.run(1000);
  ASSERT_TRUE(lasts(rig, 1.0, 0.05));
  EXPECT_TRUE(rig.shown("pictures/filmed"));
  rig.pictures(30);  // paused: nothing happens
  EXPECT_NEAR(rig.recorder.film_s(), 1.0, 0.05);
  const double so_far = rig.recorder.film_s();
  rig.rig.simulation.reset_world();
  ASSERT_TRUE(rig.until([](const state::Frame& frame) { return frame.sim_time == 0.0; }));
  rig.run(500);  // time went back; the film goes on
  ASSERT_TRUE(lasts(rig, so_far + 0.5, 0.1));
  const double all = rig.recorder.film_s();
  rig.click("pictures/film");
  EXPECT_FALSE(rig.recorder.filming());
  ASSERT_TRUE(said(rig, "film: " + folder.string()));
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    pictures += entry.path().extension() == ".png" ? 1 : 0;
  }
  EXPECT_EQ(pictures, static_cast<std::size_t>(std::lround(all * WindowRecorder::kFilmRate)));
}

}  // namespace
}  // namespace ambf::render
