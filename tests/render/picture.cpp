// Takes a picture of a scene without a display: ambf_render_picture OUT.png WIDTH HEIGHT SECONDS LAUNCH_FILE FILE... (ADF files). For looking
// at what the renderer makes of our scenes, and for docs/images.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "adf/adf.h"
#include "base/clock.h"
#include "base/log.h"
#include "base/log_drain.h"
#include "base/stream_sink.h"
#include "render/offscreen.h"
#include "runtime/simulation.h"

int main(int argc, char** argv) {
  using namespace ambf;
  if (argc < 7) {
    std::fprintf(stderr, "usage: %s OUT.png WIDTH HEIGHT SECONDS LAUNCH_FILE FILE...\n", argv[0]);
    return 2;
  }
  base::Log log;
  base::LogDrain drain(log, base::make_stream_sink("", nullptr));
  const adf::LaunchResult launch = adf::load_launch(argv[5]);
  if (!launch.launch) return 1;
  adf::ColorsResult colors = adf::load_colors(launch.launch->color_file);
  adf::Options options;
  if (colors.colors) options.colors = &*colors.colors;
  const adf::WorldResult world = adf::load_world(launch.launch->world_file, options);
  if (!world.world) return 1;
  runtime::Simulation simulation({}, *world.world, colors.colors ? *colors.colors : scene::ColorTable{}, log);
  for (int i = 6; i < argc; ++i) {
    state::LoadRequest request;
    request.path = argv[i];
    std::printf("%s\n", simulation.load_and_wait(std::move(request)).message.c_str());
  }
  simulation.begin();
  std::this_thread::sleep_for(std::chrono::duration<double>(std::atof(argv[4])));

  std::string why;
  const auto offscreen = render::Offscreen::open(why);
  const auto reader = simulation.make_reader();
  const state::Frame* frame = reader->latest();
  render::Image image;
  base::Diagnostics diagnostics;
  if (offscreen == nullptr || frame == nullptr || frame->cameras.empty()) {
    std::fprintf(stderr, "no picture: %s\n", why.c_str());
    return 1;
  }
  const render::Camera camera = render::Offscreen::camera_of(*frame, 0);
  if (!offscreen->picture(*frame, camera, std::atoi(argv[2]), std::atoi(argv[3]), image, diagnostics, why) ||
      !render::write_png(argv[1], image, why)) {
    std::fprintf(stderr, "no picture: %s\n", why.c_str());
    return 1;
  }
  log.report(diagnostics);
  // What a picture costs at each quality, physics standing still: CPU time of all threads.
  simulation.set_paused(true);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  constexpr int kPictures = 20;
  const render::Quality plain{1, 1024, 1, render::ShadowFilter::hard, false};
  render::Quality still = plain;
  still.shadow_interval = 0;
  for (const render::Quality& quality : {render::Quality{}, plain, still}) {
    const std::int64_t begin_ns = base::process_cpu_ns();
    for (int i = 0; i < kPictures; ++i) {
      offscreen->picture(*reader->latest(), camera, std::atoi(argv[2]), std::atoi(argv[3]), image, diagnostics, why,
                         quality);
    }
    std::printf("%d samples, %s%s: %.1f ms of CPU a picture\n", quality.samples,
                quality.shadow_interval != 0 ? "shadows" : "no shadows", quality.occlusion ? ", occlusion" : "",
                base::to_seconds(base::process_cpu_ns() - begin_ns) * 1e3 / kPictures);
  }
  return 0;
}
