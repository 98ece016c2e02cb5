#include "render/pictures/picture_streamer.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/clock.h"
#include "base/hash.h"
#include "base/realtime.h"
#include "render/camera/intrinsics.h"
#include "render/pictures/detail/depth_noise.h"
#include "render/pictures/detail/stream_schedule.h"
#include "render/pictures/offscreen.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

constexpr int kNice = 10;                         // as windows: yields to everything else
constexpr std::int64_t kUpdate_ns = 16'666'667;   // 60 scene updates a second at most
constexpr std::int64_t kLook_ns = 20'000'000;     // how soon a new listener is noticed
constexpr std::int64_t kRest_ns = 5'000'000'000;  // after which memory and context go when nobody listens
constexpr std::int64_t kStill_ns = 500'000'000;   // a world that stands still is shown so often

// Of everything that a picture shows and that may change while a world is paused.
std::uint64_t looks_of(const state::Frame& frame) {
  base::Fnv1a hash;
  const auto mix_pose = [&hash](const math::Pose& pose) {
    for (const double value : {pose.position.x, pose.position.y, pose.position.z, pose.orientation.x,
                               pose.orientation.y, pose.orientation.z, pose.orientation.w}) {
      hash.add_word(value);
    }
  };
  for (const std::uint64_t word :
       {std::uint64_t{frame.structure->version}, std::uint64_t{frame.epoch}, std::uint64_t{frame.sim_step}}) {
    hash.add_word(word);
  }
  for (const state::BodyState& body : frame.bodies) mix_pose(body.T_world_body);
  for (const state::CameraState& camera : frame.cameras) {
    mix_pose(camera.T_world_camera);
    const state::Lens& lens = camera.lens;
    for (const double value : {lens.near_m, lens.far_m, lens.field_of_view_rad, lens.orthographic_width_m,
                               lens.optics.focal_ratio, lens.optics.axis_right, lens.optics.axis_down, lens.optics.skew,
                               lens.eye_separation_m, lens.focal_length_m}) {
      hash.add_word(value);
    }
    hash.add_word(std::uint64_t{lens.orthographic});
    hash.add_word(std::uint64_t{lens.stereo});
  }
  for (const state::LightState& light : frame.lights) mix_pose(light.T_world_light);
  return hash.value();
}

}  // namespace

class PictureStreamer::Work {
 public:
  Work(state::PictureSink& sink, base::Log& log, OffscreenBackend backend)
      : sink_(sink), log_(log), backend_(backend) {}

  // Nobody listens.
  void rest(std::int64_t now_ns) {
    if (offscreen_ == nullptr || now_ns - drawn_ns_ < kRest_ns) return;
    offscreen_.reset();
  }

  // One scene update. False when no picture can ever be drawn.
  bool update(const state::Frame& frame) {
    const std::uint64_t looks = looks_of(frame);
    const bool still = looks == looks_;
    if (still && frame.steady_ns - shown_ns_ < kStill_ns) return true;
    looks_ = looks;
    shown_ns_ = frame.steady_ns;
    orders_ = schedule_.due(frame, sink_, still);
    if (orders_.empty()) return true;
    if (!draw(frame)) return false;
    for (std::size_t i = 0; i < orders_.size(); ++i) post(frame, orders_[i], shots_[i]);
    return true;
  }

 private:
  bool draw(const state::Frame& frame) {
    shots_.assign(orders_.size(), {});
    bool any = false;
    for (std::size_t i = 0; i < orders_.size(); ++i) {
      const StreamOrder& order = orders_[i];
      Shot& shot = shots_[i];
      shot.camera = eye_of(Offscreen::camera_of(frame, order.camera), frame.cameras[order.camera].lens, order.eye);
      shot.width = static_cast<int>(order.width);
      shot.height = static_cast<int>(order.height);
      shot.color = order.color || order.depth_color;
      shot.measured = order.measures();
      if (order.depth) shot.depth_shaders = frame.structure->cameras[order.camera].depth_shaders;
      shot.multipass = frame.structure->cameras[order.camera].multipass;
      shot.shaders = frame.structure->cameras[order.camera].preprocessing_shaders;
      any = any || order.draws();
    }
    if (!any) {  // somebody only asks where cameras are
      rest(base::steady_ns());
      return true;
    }
    if (offscreen_ == nullptr && !open()) return false;
    base::Diagnostics diagnostics;
    drawn_ns_ = base::steady_ns();
    offscreen_->shoot(frame, shots_, diagnostics, stream_quality(offscreen_->in_software()));
    log_.report(diagnostics);
    for (const Shot& shot : shots_) {
      if (shot.failure.empty() || shot.failure == told_) continue;
      told_ = shot.failure;
      log_.error("published pictures: %s", told_.c_str());
    }
    return true;
  }

  bool open() {
    std::string why;
    offscreen_ = Offscreen::open(why, backend_);
    if (offscreen_ == nullptr) {
      log_.error("no pictures are published: %s", why.c_str());
      return false;
    }
    if (!std::exchange(opened_, true) && !why.empty()) log_.warning("published pictures: %s", why.c_str());
    log_.info("published pictures: drawn by %s", offscreen_->renderer().c_str());
    return true;
  }

  void post(const state::Frame& frame, const StreamOrder& order, Shot& shot) {
    if (!shot.failure.empty()) return;
    const state::CameraInfo& info = frame.structure->cameras[order.camera];
    state::Picture picture;
    picture.camera = frame.structure->objects[info.object].id;
    picture.eye = order.eye;
    picture.intrinsics = intrinsics_of(shot.camera, shot.width, shot.height);
    if (order.eye == state::Eye::right)
      picture.intrinsics.baseline_m = frame.cameras[order.camera].lens.eye_separation_m;
    picture.system_ns = frame.system_ns;
    picture.sim_step = frame.sim_step;
    picture.structure = frame.structure;
    if (order.mask) {
      state::Picture mask = picture;
      mask.kind = state::PictureKind::mask;
      mask.mask.reserve(shot.bodies.size());
      fill_mask(*frame.structure, shot.bodies, mask.mask);
      sink_.post(std::move(mask));
    }
    if (order.depth_geometry) {
      state::Picture depth = picture;
      depth.kind = state::PictureKind::depth;
      if (order.depth) {
        depth.depth_m = std::move(shot.depth_m);
        depth.points_m = std::move(shot.points_m);
        if (!depth.points_m.empty()) {
          for (std::size_t i = 0; i < depth.depth_m.size(); ++i) depth.depth_m[i] = depth.points_m[3 * i + 2];
        }
        for (float& z : depth.depth_m) {
          if (!(z > 0.0F)) z = std::numeric_limits<float>::quiet_NaN();
        }
        add_noise(depth.depth_m, info.depth_noise, noise_seed(frame, order.camera));
        move_to_depths(depth.points_m, depth.depth_m, depth.intrinsics.orthographic);
      }
      if (order.depth_color) depth.rgb = shot.rgb;
      sink_.post(std::move(depth));
    }
    if (order.color_geometry) {
      picture.kind = state::PictureKind::color;
      if (order.color) picture.rgb = std::move(shot.rgb);
      sink_.post(std::move(picture));
    }
  }

  // Noise moves computed points as it moves measured ones: along their rays.
  static void move_to_depths(std::vector<float>& points_m, const std::vector<float>& depth_m, bool parallel) {
    for (std::size_t i = 0; 3 * i < points_m.size(); ++i) {
      float* point = &points_m[3 * i];
      const float stretch = parallel ? 1.0F : depth_m[i] / point[2];
      point[0] *= stretch;
      point[1] *= stretch;
      point[2] = depth_m[i];
      if (std::isnan(depth_m[i])) point[0] = point[1] = depth_m[i];
    }
  }

  static void fill_mask(const state::Structure& structure, const std::vector<std::uint32_t>& bodies,
                        std::vector<std::uint16_t>& mask) {
    for (const std::uint32_t slot : bodies) {
      if (slot == state::kNone) {
        mask.push_back(0);
        continue;
      }
      const bool soft = slot >= structure.bodies.size();
      const std::uint32_t object =
          soft ? state::soft_bodies(structure)[slot - structure.bodies.size()].object : structure.bodies[slot].object;
      mask.push_back(state::mask_id(structure.objects[object].id));
    }
  }

  state::PictureSink& sink_;
  base::Log& log_;
  const OffscreenBackend backend_;
  StreamSchedule schedule_;
  std::unique_ptr<Offscreen> offscreen_;
  std::vector<StreamOrder> orders_;
  std::vector<Shot> shots_;
  bool opened_ = false;  // once at least
  std::string told_;
  std::uint64_t looks_ = 0;
  std::int64_t shown_ns_ = 0, drawn_ns_ = 0;
};

PictureStreamer::PictureStreamer(state::ObserveAbility& observe, state::PictureSink& sink, base::Log& log,
                                 OffscreenBackend backend)
    : observe_(observe), sink_(sink), log_(log), backend_(backend) {
  sink_.when_needed([this] {
    if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  });
}

PictureStreamer::~PictureStreamer() {
  sink_.when_needed({});
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void PictureStreamer::run() {
  base::set_thread_name("pictures");
  base::lower_priority(kNice);  // before OpenGL makes its own threads, which inherit it
  const std::unique_ptr<state::FrameReader> reader = observe_.make_reader();
  if (reader == nullptr) {
    log_.error("no pictures are published: too many readers of frames");
    return;
  }
  Work work(sink_, log_, backend_);
  std::uint64_t seen = 0;
  std::int64_t next_ns = base::steady_ns();
  while (!stop_) {
    base::sleep_until(next_ns);
    const std::int64_t now_ns = base::steady_ns();
    if (!anything_wanted(*observe_.structure(), sink_)) {
      work.rest(now_ns);
      next_ns = now_ns + kLook_ns;
      continue;
    }
    // What is late is not made up for.
    next_ns = std::max(next_ns + kUpdate_ns, now_ns);
    if (!reader->wait_newer(seen, std::chrono::nanoseconds(kLook_ns))) continue;
    const state::Frame* frame = reader->latest();
    if (frame == nullptr) continue;
    seen = frame->sequence;
    if (!work.update(*frame)) return;
  }
}

}  // namespace ambf::render
