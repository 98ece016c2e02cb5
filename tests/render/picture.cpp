// Takes a picture of a scene without a display: ambf_render_picture [--layers=JOINTS,CONTACTS,...] [--frame] OUT.png
// WIDTH HEIGHT SECONDS LAUNCH_FILE WHAT... For looking at what the renderer makes of our scenes, and for the pictures
// of docs. WHAT: the place of a model in the launch file (the first one brings its world), an ADF file, @NAME for
// another camera than the first one, or `times` to print what a picture costs at several qualities.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "adf/adf.h"
#include "base/clock.h"
#include "base/detail/stream_sink.h"
#include "base/log.h"
#include "base/log_drain.h"
#include "render/marks/label_layout.h"
#include "render/marks/layer_shapes.h"
#include "render/navigation/framing.h"
#include "render/pictures/extras.h"
#include "render/pictures/offscreen.h"
#include "runtime/simulation.h"

namespace {

// From the beginnings of their labels: "joints,contacts".
ambf::render::Layers layers_of(std::string words) {
  ambf::render::Layers layers;
  for (char& c : words) c = static_cast<char>(std::tolower(c));
  words = "," + words + ",";
  for (std::size_t i = 0; i < ambf::render::all_layers().size(); ++i) {
    const std::string& whole = ambf::render::all_layers()[i].label;
    std::string label = whole.substr(0, whole.find(' '));
    for (char& c : label) c = static_cast<char>(std::tolower(c));
    if (words.find("," + label + ",") != std::string::npos) layers.show(static_cast<ambf::render::LayerId>(i));
  }
  return layers;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace ambf;
  render::Layers layers;
  constexpr std::string_view kLayers = "--layers=";
  if (argc > 1 && std::string_view(argv[1]).substr(0, kLayers.size()) == kLayers) {
    layers = layers_of(argv[1] + kLayers.size());
    --argc;
    ++argv;
  }
  const bool framed =
      argc > 1 && std::string_view(argv[1]) == "--frame";  // all but the ground, not what the camera sees
  if (framed) {
    --argc;
    ++argv;
  }
  if (argc < 7) {
    std::fprintf(stderr, "usage: %s OUT.png WIDTH HEIGHT SECONDS LAUNCH_FILE WHAT...\n", argv[0]);
    return 2;
  }
  base::Log log;
  base::LogDrain drain(log, base::make_stream_sink("", nullptr));
  const adf::LaunchResult launch = adf::load_launch(argv[5]);
  if (!launch.launch) return 1;
  adf::ColorsResult colors = adf::load_colors(launch.launch->color_file);
  adf::Options options;
  if (colors.colors) options.colors = &*colors.colors;
  std::vector<std::string> files;
  bool times = false;
  std::string world_file = launch.launch->world_file, camera_name;
  for (int i = 6; i < argc; ++i) {
    const std::string what = argv[i];
    if (what.find_first_not_of("0123456789") == std::string::npos) {
      const std::size_t place = std::strtoul(argv[i], nullptr, 10);
      if (files.empty() && place < launch.launch->world_files.size()) world_file = launch.launch->world_files[place];
      if (place < launch.launch->model_files.size()) files.push_back(launch.launch->model_files[place]);
    } else if (what == "times") {
      times = true;
    } else if (what.front() == '@') {
      camera_name = what.substr(1);
    } else {
      files.push_back(what);
    }
  }
  const adf::WorldResult world = adf::load_world(world_file, options);
  if (!world.world) return 1;
  runtime::Simulation simulation({}, *world.world, colors.colors ? *colors.colors : scene::ColorTable{}, log);
  for (const std::string& file : files) {
    state::LoadRequest request;
    request.path = file;
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
  std::uint32_t chosen = 0;
  for (std::uint32_t slot = 0; slot < frame->structure->cameras.size(); ++slot) {
    if (frame->structure->objects[frame->structure->cameras[slot].object].local_name == camera_name) chosen = slot;
  }
  render::Camera camera = render::Offscreen::camera_of(*frame, chosen);
  const int width = std::atoi(argv[2]), height = std::atoi(argv[3]);
  render::Motion now;
  now.take(*frame);
  render::WorldShapes debug;
  if (framed) {
    render::MeshIdentity meshes;
    const render::SceneBatches scene = render::make_scene_batches(*frame->structure, meshes);
    const auto things = render::things_in(*frame->structure, scene, now.at(frame->steady_ns).bodies);
    camera = render::framing(things, 1.0 * width / height).camera;
  }
  const render::PixelScale scale(camera, width, height, 1.0);
  render::draw_layers(layers, {*frame, now.at(frame->steady_ns), {}, scale}, debug);
  const auto letters = std::make_shared<const render::Lettering>(1.0);
  render::TextDrawing text(letters, width, height);
  render::draw_labels(render::lay_out(debug.texts(), camera, width, height, *letters), text);
  const render::Extras extras{
      {}, &debug, &text, render::BodyLooks().by_slot(*frame->structure, layers.shows(render::LayerId::no_visuals))};
  if (!offscreen->picture(*frame, camera, width, height, image, diagnostics, why, {}, &extras) ||
      !render::write_png(argv[1], image, why)) {
    std::fprintf(stderr, "no picture: %s\n", why.c_str());
    return 1;
  }
  log.report(diagnostics);
  if (!times) return 0;
  // What a picture costs at each quality, physics standing still: CPU time of all threads.
  simulation.set_paused(true);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  constexpr int kPictures = 2, kRounds = 3;  // the least of several rounds: other programs run, too
  struct Kind {
    const char* name;
    render::Quality quality;
  };
  const bool software = offscreen->in_software();
  const Kind kinds[] = {{"screenshots, windows at level 0", render::QualityGovernor::at(0)},
                        {"videos", render::video_quality(software)},
                        {"streams, windows at levels 1 and 2 with new shadows", render::stream_quality(software)},
                        {"windows at level 3", render::QualityGovernor::at(3)}};
  double min_s[std::size(kinds)][2];  // things standing still, moving
  for (auto& of_kind : min_s) std::fill(std::begin(of_kind), std::end(of_kind), 1e9);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < std::size(kinds); ++k) {
      for (const int moving : {0, 1}) {
        render::Quality quality = kinds[k].quality;
        offscreen->picture(*reader->latest(), camera, width, height, image, diagnostics, why, quality);
        const std::int64_t begin_ns = base::process_cpu_ns();
        for (int i = 0; i < kPictures; ++i) {
          quality.shadow_side -= moving;  // shadow maps are drawn anew as if something had moved
          offscreen->picture(*reader->latest(), camera, width, height, image, diagnostics, why, quality);
        }
        min_s[k][moving] = std::min(min_s[k][moving], base::to_seconds(base::process_cpu_ns() - begin_ns) / kPictures);
      }
    }
  }
  for (std::size_t k = 0; k < std::size(kinds); ++k) {
    std::printf("%s: %.0f ms of CPU a picture, %.0f ms while things move\n", kinds[k].name, min_s[k][0] * 1e3,
                min_s[k][1] * 1e3);
  }
  return 0;
}
