// What a camera sees of files of ADF while nothing moves: a paused simulation without ROS and windows loads them,
// Mesa draws the picture. Whatever is refused or complained about on the way fails the test. One thread.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "adf/adf.h"
#include "render/pictures/offscreen.h"
#include "runtime/simulation.h"
#include "tests/support/judged_log.h"
#include "tests/support/slowness.h"

namespace ambf::render::testing {

class StillSimulation {
 public:
  explicit StillSimulation(const scene::World& world, const scene::ColorTable& colors = {})
      : simulation_({}, world, colors, log_), reader_(simulation_.make_reader()) {
    simulation_.set_paused(true);
    simulation_.begin();
  }
  void load(const std::string& model_file) {
    state::LoadRequest request;
    request.path = model_file;
    const state::Outcome outcome = simulation_.load_and_wait(std::move(request));
    EXPECT_TRUE(outcome.success) << model_file << ": " << outcome.message;
  }
  // The newest one, which holds all that was loaded; null after a failure.
  const state::Frame* frame() {
    const auto wanted = simulation_.structure();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20 * kTestSlowness);
    while (std::chrono::steady_clock::now() < end) {
      const state::Frame* newest = reader_->latest();
      if (newest != nullptr && newest->structure == wanted) return newest;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "no frame of what was loaded";
    return nullptr;
  }
  // By the world's first camera; empty after a failure.
  Image picture(int width, int height) {
    Image image;
    std::string why;
    base::Diagnostics findings;
    const state::Frame* newest = frame();
    const auto offscreen = Offscreen::open(why, OffscreenBackend::osmesa);
    EXPECT_NE(offscreen, nullptr) << why;
    if (offscreen == nullptr || newest == nullptr) return image;
    const Camera camera = Offscreen::camera_of(*newest, 0);
    EXPECT_TRUE(offscreen->picture(*newest, camera, width, height, image, findings, why)) << why;
    for (const base::Diagnostic& finding : findings) ADD_FAILURE() << base::to_string(finding);
    EXPECT_EQ(offscreen->counts().gl_errors, 0U);
    return image;
  }

 private:
  JudgedLog log_;
  runtime::Simulation simulation_;
  std::unique_ptr<state::FrameReader> reader_;
};

// Of a launch file's world or another one, in the launch file's colours.
inline Image still_picture(const adf::LaunchResult& launch, const std::string& world_file,
                           const std::vector<std::string>& model_files, int width, int height) {
  adf::ColorsResult colors = adf::load_colors(launch.launch->color_file);
  EXPECT_TRUE(colors.colors) << launch.launch->color_file;
  if (!colors.colors) return {};
  adf::Options options;
  options.colors = &*colors.colors;
  const adf::WorldResult world = adf::load_world(world_file, options);
  EXPECT_TRUE(world.world) << world_file;
  if (!world.world) return {};
  StillSimulation simulation(*world.world, *colors.colors);
  for (const std::string& file : model_files) simulation.load(file);
  return simulation.picture(width, height);
}

}  // namespace ambf::render::testing
