// Models written by others, as they stand when loaded, compared with committed pictures of ours (tests/render/reference).
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "adf/adf.h"
#include "base/log.h"
#include "reference_picture.h"
#include "render/offscreen.h"
#include "runtime/simulation.h"

namespace ambf::render {
namespace {

std::filesystem::path compat() {
  const char* given = std::getenv("AMBF_COMPAT_DIR");
  return (given != nullptr ? std::filesystem::path(given)
                           : std::filesystem::path(AMBF_SOURCE_DIR) / "../shared/compat") /
         "ambf_models/descriptions";
}

class ReferenceModels : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::filesystem::exists(compat())) return;
    if (std::getenv("CI") != nullptr) FAIL() << "no models in " << compat() << ": set AMBF_COMPAT_DIR";
    GTEST_SKIP() << "no models in " << compat() << ": set AMBF_COMPAT_DIR";
  }
  // What `camera` sees of `models`, paused; by default the world's first camera.
  static Image take(const std::vector<std::string>& models, const Camera* camera = nullptr) {
    base::Log log;
    const adf::LaunchResult launch = adf::load_launch((compat() / "launch.yaml").string());
    adf::ColorsResult colors = adf::load_colors(launch.launch->color_file);
    adf::Options options;
    options.colors = &*colors.colors;
    const adf::WorldResult world = adf::load_world(launch.launch->world_file, options);
    runtime::Simulation simulation({}, *world.world, *colors.colors, log);
    simulation.set_paused(true);
    simulation.begin();
    for (const std::string& model : models) {
      state::LoadRequest request;
      request.path = (compat() / "multi-bodies" / model).string();
      EXPECT_TRUE(simulation.load_and_wait(std::move(request)).success) << model;
    }
    const auto reader = simulation.make_reader();
    const state::Frame* frame = reader->latest();
    for (int i = 0; i < 2000 && (frame == nullptr || frame->structure->models.size() < models.size()); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      frame = reader->latest();
    }
    Image image;
    std::string why;
    base::Diagnostics diagnostics;
    const auto offscreen = Offscreen::open(why, OffscreenBackend::osmesa);
    EXPECT_NE(offscreen, nullptr) << why;
    if (offscreen == nullptr || frame == nullptr) return image;
    EXPECT_TRUE(offscreen->picture(*frame, camera != nullptr ? *camera : Offscreen::camera_of(*frame, 0), 384, 192,
                                   image, diagnostics, why))
        << why;
    EXPECT_EQ(offscreen->counts().gl_errors, 0U);
    return image;
  }
};

TEST_F(ReferenceModels, PsmEcmMtm) {
  EXPECT_TRUE(testing::matches_reference(
      take({"robots/blender-psm.yaml", "robots/blender-ecm.yaml", "robots/blender-mtm.yaml"}), "psm_ecm_mtm"));
}

TEST_F(ReferenceModels, Puzzle2) { EXPECT_TRUE(testing::matches_reference(take({"puzzles/puzzle2.yaml"}), "puzzle2")); }

TEST_F(ReferenceModels, TexturedGround) {
  EXPECT_TRUE(testing::matches_reference(take({"environments/TexturedGround/env.yaml"}), "textured_ground"));
}

}  // namespace
}  // namespace ambf::render
