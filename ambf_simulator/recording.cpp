#include "recording.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "base/realtime.h"
#include "progress.h"
#include "render/camera/stereo.h"
#include "render/navigation/framing.h"
#include "render/pictures/offscreen.h"
#include "render/pictures/video_writer.h"
#include "state/soft_bodies.h"
#include "timeline.h"

namespace ambf::simulator {

namespace {

constexpr int kNice = 10;
constexpr int kWidth = 1280, kHeight = 720;                  // where neither flag nor camera says otherwise
constexpr double kLookEvery_s = 0.1, kLongestWait_s = 10.0;  // for a scene to come to rest
constexpr double kStill_m_s = 1e-3, kStill_rad_s = 1e-2;
constexpr double kStillNode_m_s = 5e-3;  // single nodes of a hanging cloth tremble

bool same(const math::Pose& a, const math::Pose& b) {
  constexpr double kSame = 1e-9;
  const math::Quat &p = a.orientation, &q = b.orientation;
  return math::norm(a.position - b.position) < kSame &&
         1.0 - std::abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w) < kSame;
}

bool at_rest(const state::Frame& frame) {
  for (const state::BodyState& body : frame.bodies) {
    if (body.asleep) continue;
    if (math::norm(body.twist_world.linear) > kStill_m_s || math::norm(body.twist_world.angular) > kStill_rad_s) {
      return false;
    }
  }
  return true;
}

// Whether the nodes of soft bodies are about where `before` has them, where they are now afterwards. They have no
// velocities in frames.
bool nodes_rest(const state::Frame& frame, std::vector<math::Vec3>& before) {
  std::vector<math::Vec3> now;
  const auto bodies = static_cast<std::uint32_t>(state::soft_bodies(*frame.structure).size());
  for (std::uint32_t slot = 0; slot < bodies; ++slot)
    for (const state::SoftNode& node : state::nodes_of(frame, slot)) now.push_back(node.position_world);
  const bool rest = std::equal(now.begin(), now.end(), before.begin(), before.end(), [](const auto& a, const auto& b) {
    return math::norm(a - b) <= kStillNode_m_s * kLookEvery_s;
  });
  before = std::move(now);
  return rest;
}

// By its full name, its name in the file, or an unambiguous part of either; without a name the first camera that has a
// window, else the first camera.
std::optional<std::uint32_t> find_camera(const state::Structure& structure, const std::string& name) {
  if (structure.cameras.empty()) return std::nullopt;
  if (name.empty()) {
    for (std::uint32_t slot = 0; slot < structure.cameras.size(); ++slot) {
      if (structure.cameras[slot].visible) return slot;
    }
    return 0;
  }
  const state::ObjectKind kind = structure.objects[structure.cameras.front().object].kind;
  const std::uint32_t found = state::find(structure, name, kind);
  if (found != state::kNone) return structure.objects[found].slot;
  for (std::uint32_t slot = 0; slot < structure.cameras.size(); ++slot) {
    if (structure.objects[structure.cameras[slot].object].local_name == name) return slot;
  }
  return std::nullopt;
}

// Into the first: eyes' pictures next to each other in one so wide (an odd width leaves a black column between them).
void join(std::vector<render::Shot>& shots, const std::vector<render::EyeView>& eyes, int width) {
  const auto bytes = [](double pixels) { return 3 * static_cast<std::size_t>(pixels); };
  render::Shot& all = shots.front();
  std::vector<std::uint8_t> rgb(bytes(width) * static_cast<std::size_t>(all.height));
  for (std::size_t eye = 0; eye < shots.size(); ++eye) {
    const render::Shot& shot = shots[eye];
    if (!shot.failure.empty()) {
      all.failure = shot.failure;
      return;
    }
    const std::size_t row = bytes(shot.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(shot.height); ++y) {
      std::copy_n(shot.rgb.data() + y * row, row, rgb.data() + y * bytes(width) + bytes(eyes[eye].left));
    }
  }
  all.rgb = std::move(rgb);
  all.width = width;
}

class Recorder {
 public:
  Recorder(const CommandLine& options, Timeline& time, base::Log& log) : options_(options), time_(time), log_(log) {}

  bool run() {
    std::string why;
    offscreen_ = render::Offscreen::open(why, options_.offscreen);
    if (offscreen_ == nullptr) {
      log_.error("no pictures: %s", why.c_str());
      return false;
    }
    if (!why.empty()) log_.warning("pictures: %s", why.c_str());
    if (const state::Frame* first = time_.now()) begin(*first);
    const state::Frame* frame = options_.at_seconds ? time_.at(*options_.at_seconds) : settled();
    if (frame == nullptr) {
      log_.error("no pictures: the simulation ended or halted before");
      return false;
    }
    bool good = true;
    for (const PictureFile& screenshot : options_.screenshots) good = take(*frame, screenshot) && good;
    return (options_.video.file.empty() || film(frame->sim_time)) && good;
  }

 private:
  void begin(const state::Frame& frame) {
    for (const state::CameraState& camera : frame.cameras) T_parent_camera_.push_back(camera.T_parent_camera);
    const std::vector<state::CameraInfo>& cameras = frame.structure->cameras;
    if (std::any_of(cameras.begin(), cameras.end(), [](const state::CameraInfo& info) { return info.frames_scene; })) {
      things_ = render::things_in(frame);
    }
  }

  // A camera without a description is placed, as in a window, where it sees all objects of the first frame; unless a
  // window or a user has moved it already.
  render::Camera camera_of(const state::Frame& frame, std::uint32_t slot, double aspect) {
    const state::CameraInfo& info = frame.structure->cameras[slot];
    const state::CameraState& now = frame.cameras[slot];
    if (info.frames_scene && slot < T_parent_camera_.size() && same(now.T_parent_camera, T_parent_camera_[slot]) &&
        now.lens == info.lens) {
      if (things_.empty()) things_ = render::things_in(frame);
      if (!things_.empty()) return render::framing(things_, aspect).camera;
    }
    return render::Offscreen::camera_of(frame, slot);
  }

  const state::Frame* settled() {
    const state::Frame* frame = time_.now();
    if (frame == nullptr) return nullptr;
    const double begin_s = frame->sim_time;
    bool was_still = false;
    std::vector<math::Vec3> nodes;
    for (int i = 1; i * kLookEvery_s <= kLongestWait_s; ++i) {
      frame = time_.at(begin_s + i * kLookEvery_s);
      if (frame == nullptr) return nullptr;
      const bool still = nodes_rest(*frame, nodes) && at_rest(*frame);
      if (still && was_still) return frame;
      was_still = still;
    }
    log_.info("pictures are taken of a scene that still moves after %.0f s; --at SECONDS chooses the moment",
              kLongestWait_s);
    return frame;
  }

  // The camera's picture; the size is the flag's, the one that the camera publishes in, or ours.
  bool shoot(const state::Frame& frame, const PictureFile& file, const render::Quality& quality,
             std::vector<render::Shot>& shots) {
    const state::Structure& structure = *frame.structure;
    const std::optional<std::uint32_t> slot = find_camera(structure, file.camera);
    if (!slot) {
      std::string names;
      for (const state::CameraInfo& camera : structure.cameras) {
        names += (names.empty() ? "" : ", ") + structure.objects[camera.object].name;
      }
      log_.error("%s: there is no camera '%s', but %s", file.file.c_str(), file.camera.c_str(), names.c_str());
      return false;
    }
    const state::ImageStream& stream = structure.cameras[*slot].image;
    shots.assign(1, {});
    render::Shot& shot = shots.front();
    shot.width = options_.picture_width > 0 ? options_.picture_width
                 : stream.on                ? static_cast<int>(stream.width)
                                            : kWidth;
    shot.height = options_.picture_height > 0 ? options_.picture_height
                  : stream.on                 ? static_cast<int>(stream.height)
                                              : kHeight;
    const int width = shot.width;
    shot.camera = camera_of(frame, *slot, static_cast<double>(width) / shot.height);
    shot.color = true;
    shot.multipass = structure.cameras[*slot].multipass;
    // As a window shows them: both eyes' pictures of a stereo camera side by side.
    const std::vector<render::EyeView> eyes = render::eyes_of(shot.camera, frame.cameras[*slot].lens, width);
    shots.resize(eyes.size(), shot);
    for (std::size_t eye = 0; eye < eyes.size(); ++eye) {
      shots[eye].camera = eyes[eye].camera;
      shots[eye].width = static_cast<int>(eyes[eye].width);
    }
    base::Diagnostics diagnostics;
    offscreen_->shoot(frame, shots, diagnostics, quality);
    if (eyes.size() > 1) join(shots, eyes, width);
    log_.report(diagnostics);
    if (shots.front().failure.empty()) return true;
    log_.error("%s: %s", file.file.c_str(), shots.front().failure.c_str());
    return false;
  }

  bool take(const state::Frame& frame, const PictureFile& file) {
    std::vector<render::Shot> shots;
    if (!shoot(frame, file, chosen_quality({}), shots)) return false;
    const render::Shot& shot = shots.front();
    std::string why;
    if (!render::write_image(file.file, render::image_of(shot.rgb, shot.width, shot.height), why)) {
      log_.error("%s: %s", file.file.c_str(), why.c_str());
      return false;
    }
    log_.info("%s: %d x %d, at %.3f s", file.file.c_str(), shot.width, shot.height, frame.sim_time);
    return true;
  }

  // `usual` where the command line does not say.
  render::Quality chosen_quality(const render::Quality& usual) const {
    switch (options_.picture_quality) {
      case PictureQuality::draft: return render::stream_quality(true);
      case PictureQuality::normal: return render::video_quality(true);
      case PictureQuality::fine: return {};
      case PictureQuality::usual: break;
    }
    return usual;
  }

  bool film(double begin_s) {
    const auto count = static_cast<unsigned>(std::lround(options_.video_seconds * options_.video_fps));
    const render::Quality quality = chosen_quality(render::video_quality(offscreen_->in_software()));
    Progress progress(log_, options_.video.file, count);
    std::unique_ptr<render::VideoWriter> writer;
    std::vector<render::Shot> shots;
    std::string why;
    for (unsigned i = 0; i < count; ++i) {
      const state::Frame* frame = time_.at(begin_s + static_cast<double>(i) / options_.video_fps);
      if (frame == nullptr) {
        log_.warning("%s: ends after %u of %u pictures", options_.video.file.c_str(), i, count);
        break;
      }
      if (!shoot(*frame, options_.video, quality, shots)) return false;
      const render::Shot& shot = shots.front();
      if (writer == nullptr) {
        writer = render::VideoWriter::open(options_.video.file, shot.width, shot.height, options_.video_fps, why);
      }
      if (writer == nullptr || !writer->add(shot.rgb, why)) {
        log_.error("%s: %s", options_.video.file.c_str(), why.c_str());
        return false;
      }
      progress.done(i + 1);
    }
    if (writer == nullptr) return false;
    if (!writer->finish(why)) {
      log_.error("%s", why.c_str());
      return false;
    }
    if (writer->place() == options_.video.file) {
      log_.info("%s: %u pictures, %d a second", writer->place().c_str(), count, options_.video_fps);
    } else {
      log_.info("%s: %u numbered pictures, since ffmpeg is not installed", writer->place().c_str(), count);
    }
    return true;
  }

  const CommandLine& options_;
  Timeline& time_;
  base::Log& log_;
  std::unique_ptr<render::Offscreen> offscreen_;
  std::vector<math::Pose> T_parent_camera_;  // at the beginning
  std::vector<render::Sphere> things_;       // likewise; only looked for when a camera frames them
};

}  // namespace

bool records(const CommandLine& options) { return !options.screenshots.empty() || !options.video.file.empty(); }

bool runs_beside(const CommandLine& options) { return options.run_for_seconds > 0.0 || options.gui_asked_for; }

bool record(const CommandLine& options, state::RunAbility& run, state::ObserveAbility& observe, Signals& signals,
            base::Log& log) {
  base::set_thread_name("recording");
  if (runs_beside(options)) base::lower_priority(kNice);
  const std::unique_ptr<Timeline> time =
      runs_beside(options) ? Timeline::watched(observe, signals) : Timeline::stepped(run, observe, signals);
  return Recorder(options, *time, log).run();
}

}  // namespace ambf::simulator
