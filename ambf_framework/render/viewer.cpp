#include "render/viewer.h"

#include <algorithm>
#include <cstdio>

#include "base/clock.h"
#include "base/realtime.h"
#include "render/window_viewer.h"

namespace ambf::render {

namespace {

constexpr int kNice = 10;  // graphics yields to everything else
// Where the display paces swaps, ours must not get in its way; else 60 pictures a second are enough.
constexpr std::int64_t kShortestPicture_ns = 13'300'000, kSoftwarePicture_ns = 16'666'667;
constexpr std::int64_t kTellEvery_ns = 500'000'000;
constexpr std::int64_t kHiddenPicture_ns = 100'000'000;

constexpr std::array<float, 4> kPickedTint = {1.0F, 0.15F, 0.05F, 0.3F};  // tomato, 30 %
constexpr FlatColor kPickColor = {0.68F, 1.0F, 0.18F, 1.0F};

}  // namespace

std::unique_ptr<Viewer> Viewer::open(state::Control& control, base::Log& log, std::string& why) {
  base::lower_priority(kNice);  // before GL makes its own threads, which inherit it
  auto viewer = std::make_unique<WindowViewer>(control, log);
  if (!viewer->start(why)) return nullptr;
  return viewer;
}

WindowViewer::WindowViewer(state::Control& control, base::Log& log)
    : control_(control), log_(log), reader_(control.make_reader()), view_(control), picker_(control) {}

WindowViewer::~WindowViewer() {
  if (picker_.pressed()) picker_.release();
  view_.rest();
  control_.report_graphics_rate(0.0);
}

bool WindowViewer::start(std::string& why) {
  if (reader_ == nullptr) {
    why = "too many readers of frames";
    return false;
  }
  display_ = Display::open(why);
  if (display_ == nullptr) return false;
  unsigned monitor = 0;
  for (const state::CameraInfo& camera : control_.structure()->cameras) {
    if (!camera.visible) continue;
    monitor = camera.monitor;
    break;
  }
  window_ = Window::open(*display_, "AMBF", monitor, why);
  if (window_ == nullptr) return false;
  std::string missing;
  if (!gl_.load(Window::address_of, missing)) {
    why = "the graphics driver lacks " + missing;
    return false;
  }
  software_ = draws_in_software(gl_);
  quality_ = QualityGovernor(software_);
  window_->wait_for_display(!software_);
  shared_ = std::make_unique<SharedStore>(gl_);
  painter_ = std::make_unique<Painter>(gl_, *shared_);
  if (!shared_->build(why) || !painter_->build(why)) return false;
  log_.info("window: %s%s", reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER)),
            software_ ? " (drawn by the processor: pictures adapt to its speed)" : "");
  return true;
}

bool WindowViewer::draw() {
  const std::vector<Input> inputs = window_->take_inputs();
  frame_ = reader_->latest();
  for (const Input& input : inputs) {
    if (frame_ != nullptr) handle(input);
  }
  const std::int64_t now_ns = base::steady_ns();
  if (!display_->lost() && frame_ != nullptr && !window_->hidden() && !draw_picture(now_ns)) return false;
  if (display_->lost()) {
    log_.warning("the display server is gone");
    return false;
  }
  tell_rates(now_ns);
  pace();
  return !quit_ && !window_->close_asked();
}

bool WindowViewer::draw_picture(std::int64_t now_ns) {
  const auto [width, height] = window_->picture();
  if (width <= 0 || height <= 0) return true;
  motion_.take(*frame_);
  const state::Structure& structure = *frame_->structure;
  log_.report(shared_->take(structure));
  const ScenePoses& poses = motion_.at(now_ns);
  const double aspect = static_cast<double>(width) / height;
  view_.follow(*frame_, poses, bounds_of(shared_->scene(), poses.bodies), aspect, now_ns);
  if (picker_.update(*frame_, poses, view_.camera())) {
    const std::uint32_t object = state::find(structure, picker_.last());
    messages_->add("picked " + structure.objects[object].name);
  }

  FlatDrawing marks(width, height);
  draw_marks(marks, projection_matrix(view_.camera(), aspect) * view_matrix(view_.camera().T_world_camera), poses,
             now_ns);
  PaintJob job;
  job.structure = &structure;
  job.poses = &poses;
  job.camera = view_.camera();
  job.width = width;
  job.height = height;
  job.quality = quality_.quality();
  if (picker_.holds()) job.tint = {picker_.body(), kPickedTint};
  job.marks = &marks;
  std::string why;
  if (!painter_->paint(job, why)) {
    if (display_->lost()) return true;  // draw() says so
    log_.error("%s: the window is closed", why.c_str());
    return false;
  }
  painter_->canvas().resolve_to(0);
  if (software_) gl_.Finish();
  quality_.picture_done(now_ns, base::to_seconds(base::steady_ns() - now_ns));
  window_->show_picture();
  ++pictures_;
  return true;
}

void WindowViewer::draw_marks(FlatDrawing& marks, const Mat4& world_to_clip, const ScenePoses& poses,
                              std::int64_t now_ns) {
  constexpr double kAxisPart = 0.08, kWidth_px = 2.5;  // of the distance to the target
  const double length = kAxisPart * view_.view().target_distance_m;
  if (all_frames_) {
    for (const math::Pose& T_world_body : poses.bodies) marks.axes(world_to_clip, T_world_body, length, kWidth_px);
  } else if (framed_body_) {
    const std::uint32_t object = state::find(*frame_->structure, *framed_body_);
    if (object != state::kNone) {
      marks.axes(world_to_clip, poses.bodies[frame_->structure->objects[object].slot], length, kWidth_px);
    }
  }
  for (const state::PickState& pick : frame_->picks) {  // by all users
    if (pick.body >= poses.bodies.size()) continue;
    const math::Vec3 at = poses.bodies[pick.body] * pick.point_body;
    const double arm = 0.15 * length;
    marks.line(world_to_clip, at, pick.target_world, kWidth_px, kPickColor);
    for (const math::Vec3& axis : {math::Vec3{arm, 0, 0}, math::Vec3{0, arm, 0}, math::Vec3{0, 0, arm}}) {
      marks.line(world_to_clip, at - axis, at + axis, 2.0 * kWidth_px, kPickColor);
    }
  }
  draw_labels(marks, now_ns);
}

void WindowViewer::tell_rates(std::int64_t now_ns) {
  if (told_ns_ == 0) told_ns_ = now_ns;
  const double seconds = base::to_seconds(now_ns - told_ns_);
  if (now_ns - told_ns_ < kTellEvery_ns || frame_ == nullptr) return;
  const double rate = static_cast<double>(pictures_ - pictures_told_) / seconds;
  pictures_told_ = pictures_;
  told_ns_ = now_ns;
  control_.report_graphics_rate(rate);
  const state::RunState& run = frame_->run;
  char title[256];
  std::snprintf(title, sizeof title, "AMBF: %s | physics %.0f Hz, pictures %.0f Hz, real-time factor %.3f%s%s",
                view_.name().c_str(), run.steps_per_second, rate, run.real_time_factor,
                run.diverged ? " | diverged"
                : run.paused ? " | paused"
                             : "",
                picking_ ? " | picking" : "");
  window_->set_title(title);
}

void WindowViewer::pace() {
  const std::int64_t now_ns = base::steady_ns();
  const std::int64_t shortest = window_->hidden() ? kHiddenPicture_ns
                                : software_       ? kSoftwarePicture_ns
                                                  : kShortestPicture_ns;
  next_ns_ = std::max(next_ns_ + shortest, now_ns);
  // A late picture is not made up for; an early one waits.
  if (next_ns_ > now_ns + shortest) next_ns_ = now_ns + shortest;
  if (next_ns_ > now_ns) base::sleep_until(next_ns_);
}

}  // namespace ambf::render
