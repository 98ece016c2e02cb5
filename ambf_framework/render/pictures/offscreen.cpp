#include "render/pictures/offscreen.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "render/drawing/depth_compute.h"
#include "render/drawing/depth_pass.h"
#include "render/gl/offscreen_context.h"
#include "render/gl/readback.h"
#include "render/pictures/extras.h"
#include "render/pictures/picture_composer.h"

namespace ambf::render {

namespace {

constexpr std::uint64_t kForgetAfter = 100;  // calls in which nobody asked for pictures of a size

// What pictures of one size are drawn into: so cameras of different sizes do not take each other's memory away.
struct Station {
  Station(const Gl& gl, SharedStore& shared) : painter(gl, shared), depth(gl), depth_compute(gl) {}
  PictureComposer painter;
  DepthPass depth;
  DepthCompute depth_compute;
  bool depth_built = false;
  std::uint64_t used = 0;
};

// The read-backs of one shot.
struct Reading {
  Reading(const Gl& gl, bool overlap) : color(gl, overlap), measured(gl, overlap), points(gl, overlap) {}
  Readback color, measured, points;
  bool computed = false;  // points were started
};

void take_rgb(const void* row, std::size_t width, std::uint8_t* to) {
  const auto* from = static_cast<const std::uint8_t*>(row);
  for (std::size_t x = 0; x < width; ++x, from += 4, to += 3) {
    to[0] = from[0];
    to[1] = from[1];
    to[2] = from[2];
  }
}

void take_measured(const void* row, std::size_t width, float* depth_m, std::uint32_t* bodies) {
  const auto* from = static_cast<const float*>(row);
  for (std::size_t x = 0; x < width; ++x, from += 2) {
    depth_m[x] = from[0];
    bodies[x] = from[1] > 0.5F ? static_cast<std::uint32_t>(from[1] - 0.5F) : state::kNone;
  }
}

// From OpenGL's axes to optical ones.
void take_points(const void* row, std::size_t width, float* points_m) {
  const auto* from = static_cast<const float*>(row);
  for (std::size_t x = 0; x < width; ++x, from += 4, points_m += 3) {
    const bool any = from[3] > 0.5F && std::isfinite(from[0]) && std::isfinite(from[1]) && std::isfinite(from[2]);
    points_m[0] = any ? from[0] : std::numeric_limits<float>::quiet_NaN();
    points_m[1] = any ? -from[1] : std::numeric_limits<float>::quiet_NaN();
    points_m[2] = any ? -from[2] : std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace

Image image_of(const std::vector<std::uint8_t>& rgb, int width, int height) {
  Image image{width, height, std::vector<std::uint8_t>(rgb.size() / 3 * 4, 255)};
  for (std::size_t i = 0; i < rgb.size(); ++i) image.rgba[4 * (i / 3) + i % 3] = rgb[i];
  return image;
}

struct Offscreen::Impl {
  std::unique_ptr<OffscreenContext> context;
  Gl gl;
  std::string renderer;
  bool software = false, overlap = false;
  std::unique_ptr<SharedStore> shared;
  std::unique_ptr<UserShaders> depth_shaders;
  std::uint64_t structure_version = ~std::uint64_t{0};
  std::map<std::pair<int, int>, Station> stations;
  std::vector<std::unique_ptr<Reading>> readings;
  std::uint64_t calls = 0;
  std::size_t instances_drawn = 0;

  ~Impl() {
    if (context == nullptr || !context->make_current()) return;
    readings.clear();
    stations.clear();
    depth_shaders.reset();
    shared.reset();
  }

  Station* station(int width, int height, std::string& why) {
    const auto [at, is_new] = stations.try_emplace({width, height}, gl, *shared);
    at->second.used = calls;
    if (!is_new || at->second.painter.build(why)) return &at->second;
    stations.erase(at);
    return nullptr;
  }
  bool start(const state::Frame& frame, const ScenePoses& poses, const Quality& quality, Shot& shot, Reading& reading);
  bool finish(Shot& shot, Reading& reading);
  bool paint(const state::Frame& frame, const ScenePoses& poses, const Quality& quality, Station& station, Shot& shot);
};

Offscreen::Offscreen(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Offscreen::~Offscreen() = default;

const std::string& Offscreen::renderer() const { return impl_->renderer; }
bool Offscreen::in_software() const { return impl_->software; }

std::unique_ptr<Offscreen> Offscreen::open(std::string& why, OffscreenBackend wanted, bool overlap_reading) {
  auto impl = std::make_unique<Impl>();
  impl->context = OffscreenContext::open(wanted, why);
  if (impl->context == nullptr) return nullptr;
  std::string missing;
  if (!impl->gl.load([&](const char* name) { return impl->context->address_of(name); }, missing)) {
    why = "the graphics driver lacks " + missing;
    return nullptr;
  }
  const auto* renderer = reinterpret_cast<const char*>(impl->gl.GetString(GL_RENDERER));
  impl->renderer = renderer == nullptr ? "" : renderer;
  impl->software = draws_in_software(impl->gl);
  impl->overlap = overlap_reading || !impl->software;
  impl->shared = std::make_unique<SharedStore>(impl->gl);
  if (!impl->shared->build(why)) return nullptr;
  impl->depth_shaders = std::make_unique<UserShaders>(impl->gl, "depth is measured as without it meanwhile");
  return std::unique_ptr<Offscreen>(new Offscreen(std::move(impl)));
}

Camera Offscreen::camera_of(const state::Frame& frame, std::size_t slot) {
  Camera camera;
  camera.T_world_camera = frame.cameras.at(slot).T_world_camera;
  set_lens(camera, frame.cameras.at(slot).lens);
  return camera;
}

bool Offscreen::Impl::paint(const state::Frame& frame, const ScenePoses& poses, const Quality& quality,
                            Station& station, Shot& shot) {
  const ShaderPair shaders{shot.shaders.vertex, shot.shaders.fragment};
  PictureJob job;
  job.structure = frame.structure.get();
  job.poses = &poses;
  job.camera = shot.camera;
  job.width = shot.width;
  job.height = shot.height;
  job.quality = quality;
  job.multipass = shot.multipass;
  if (shot.extras != nullptr) job.extras = *shot.extras;
  if (!shaders.empty()) job.all_bodies_shader = &shaders;
  const bool good = station.painter.paint(job, shot.failure);
  instances_drawn = station.painter.instances_drawn();
  return good;
}

bool Offscreen::Impl::start(const state::Frame& frame, const ScenePoses& poses, const Quality& quality, Shot& shot,
                            Reading& reading) {
  Station* at = station(shot.width, shot.height, shot.failure);
  if (at == nullptr) return false;
  if (shot.color) {
    if (!paint(frame, poses, quality, *at, shot)) return false;
    at->painter.canvas().show_to_read();
    reading.color.start(shot.width, shot.height, GL_RGBA, GL_UNSIGNED_BYTE, 4);
  }
  if (shot.measured) {
    if (!at->depth_built && !at->depth.build(shot.failure)) return false;
    at->depth_built = true;
    if (!at->depth.draw(shared->gpu(), shared->scene(), poses.bodies, shot.camera, shot.width, shot.height,
                        shot.failure)) {
      return false;
    }
    reading.measured.start(shot.width, shot.height, GL_RG, GL_FLOAT, 2 * sizeof(float));
    const ShaderPair shaders{shot.depth_shaders.vertex, shot.depth_shaders.fragment};
    UserProgram* user = shaders.empty() ? nullptr : depth_shaders->program(shaders);
    reading.computed = user != nullptr;
    if (user != nullptr) {
      if (!at->depth_compute.draw(*user, at->depth.depth_texture(), shot.camera, shot.width, shot.height,
                                  shot.failure)) {
        return false;
      }
      reading.points.start(shot.width, shot.height, GL_RGBA, GL_FLOAT, 4 * sizeof(float));
    }
  }
  return true;
}

bool Offscreen::Impl::finish(Shot& shot, Reading& reading) {
  const auto width = static_cast<std::size_t>(shot.width), pixels = width * static_cast<std::size_t>(shot.height);
  bool good = true;
  if (shot.color) {
    shot.rgb.resize(3 * pixels);
    good = reading.color.finish([&](int y, const void* row) {
      take_rgb(row, width, shot.rgb.data() + 3 * width * static_cast<std::size_t>(y));
    });
  }
  if (shot.measured) {
    shot.depth_m.resize(pixels);
    shot.bodies.resize(pixels);
    good = reading.measured.finish([&](int y, const void* row) {
      const std::size_t at = width * static_cast<std::size_t>(y);
      take_measured(row, width, shot.depth_m.data() + at, shot.bodies.data() + at);
    }) && good;
    if (reading.computed) {
      shot.points_m.resize(3 * pixels);
      good = reading.points.finish([&](int y, const void* row) {
        take_points(row, width, shot.points_m.data() + 3 * width * static_cast<std::size_t>(y));
      }) && good;
    }
  }
  if (!good) shot.failure = "the graphics card does not hand out its picture";
  return good;
}

void Offscreen::shoot(const state::Frame& frame, std::vector<Shot>& shots, base::Diagnostics& diagnostics,
                      const Quality& quality) {
  Impl& impl = *impl_;
  impl.context->make_current();
  ++impl.calls;
  // Those that nothing asked for while the last structure lasted: a camera may be due only now and then.
  if (impl.structure_version != frame.structure->version) impl.depth_shaders->forget_unused();
  impl.structure_version = frame.structure->version;
  for (base::Diagnostic& finding : impl.shared->take(*frame.structure)) diagnostics.push_back(std::move(finding));
  // Nobody watches it come: a picture is complete.
  for (base::Diagnostic& finding : impl.shared->finish_textures()) diagnostics.push_back(std::move(finding));
  Motion now;
  now.take(frame);
  const ScenePoses& poses = now.at(frame.steady_ns);
  impl.shared->pose(poses.nodes);
  while (impl.readings.size() < shots.size()) impl.readings.push_back(std::make_unique<Reading>(impl.gl, impl.overlap));
  for (std::size_t i = 0; i < shots.size(); ++i) impl.start(frame, poses, quality, shots[i], *impl.readings[i]);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (shots[i].failure.empty()) impl.finish(shots[i], *impl.readings[i]);
  }
  for (base::Diagnostic& finding : impl.depth_shaders->take_findings()) diagnostics.push_back(std::move(finding));
  std::erase_if(impl.stations, [&](const auto& entry) { return entry.second.used + kForgetAfter < impl.calls; });
}

bool Offscreen::picture(const state::Frame& frame, const Camera& camera, int width, int height, Image& image,
                        base::Diagnostics& diagnostics, std::string& why, const Quality& quality,
                        const Extras* extras) {
  std::vector<Shot> shots(1);
  Shot& shot = shots.front();
  shot.camera = camera;
  shot.width = width;
  shot.height = height;
  shot.color = true;
  shot.extras = extras;
  shoot(frame, shots, diagnostics, quality);
  why = shot.failure;
  if (!why.empty()) return false;
  image = image_of(shot.rgb, width, height);
  return true;
}

Offscreen::Counts Offscreen::counts() {
  Impl& impl = *impl_;
  impl.context->make_current();
  Counts counts{impl.shared->gpu().mesh_count(),
                impl.shared->gpu().texture_count(),
                impl.shared->scene().batches.size(),
                impl.instances_drawn,
                impl.stations.size(),
                impl.shared->shadows().drawn(),
                0};
  while (impl.gl.GetError() != GL_NO_ERROR) ++counts.gl_errors;
  return counts;
}

}  // namespace ambf::render
