#include "render/window/viewer.h"

#include <algorithm>
#include <cstdio>

#include "base/clock.h"
#include "base/realtime.h"
#include "render/navigation/framing.h"
#include "render/panel/panel_part.h"
#include "render/viewer/detail/glfw_viewer.h"
#include "render/window/scene_marks.h"

namespace ambf::render {

namespace {

constexpr int kNice = 10;  // graphics yields to everything else
// Where the display paces swaps, ours must not get in its way; else 60 pictures a second are enough.
constexpr std::int64_t kShortestPicture_ns = 13'300'000, kSoftwarePicture_ns = 16'666'667,
                       kStillPicture_ns = 33'333'333;
constexpr std::int64_t kTellEvery_ns = 500'000'000;
constexpr std::int64_t kHiddenPicture_ns = 100'000'000;

}  // namespace

std::unique_ptr<Viewer> Viewer::open(const state::Abilities& simulation, base::Log& log, const ViewerOptions& options,
                                     std::string& why) {
  base::lower_priority(kNice);  // before GL makes its own threads, which inherit it
  auto viewer = std::make_unique<GlfwViewer>(simulation, log, options);
  if (!viewer->start(why)) return nullptr;
  return viewer;
}

GlfwViewer::GlfwViewer(const state::Abilities& simulation, base::Log& log, const ViewerOptions& options)
    : simulation_(simulation), log_(log), options_(options), reader_(simulation.observe.make_reader()) {
  PanelHost host;
  host.set_clipboard = [this](const std::string& text) { root_->set_clipboard(text); };
  host.clipboard = [this] { return root_->clipboard(); };
  parts_.push_back(std::make_unique<PanelPart>(PanelModel::Services{simulation, log, options.messages, messages_,
                                                                    settings_path(), options.recording, options.scene},
                                               std::move(host), gl_));
  parts_.push_back(std::make_unique<SceneMarks>(simulation.devices));
  if (options_.hand != nullptr) {
    auto hand = std::make_unique<HandInput>(*options_.hand, messages_);
    hand_ = hand.get();
    parts_.push_back(std::move(hand));
  }
}

GlfwViewer::~GlfwViewer() {
  windows_.clear();
  simulation_.observe.report_graphics(0.0, 0.0);
  if (root_ != nullptr && !display_->lost()) root_->make_current();
}

bool GlfwViewer::start(std::string& why) {
  if (reader_ == nullptr) {
    why = "too many readers of frames";
    return false;
  }
  return open_shared(why) && match_windows(*simulation_.observe.structure(), why);
}

bool GlfwViewer::open_shared(std::string& why) {
  display_ = Display::open(why);
  if (display_ == nullptr) return false;
  root_ = GlfwWindow::open_hidden(*display_, options_.check_graphics ? &log_ : nullptr, why);
  if (root_ == nullptr) return false;
  std::string missing;
  if (!gl_.load(GlfwWindow::address_of, missing)) {
    why = "the graphics driver lacks " + missing;
    return false;
  }
  software_ = draws_in_software(gl_);
  quality_ = QualityGovernor(software_);
  store_ = std::make_unique<SharedStore>(gl_);
  if (!store_->build(why)) return false;
  log_.info("windows: %s%s", reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER)),
            software_ ? " (drawn by the processor: pictures adapt to its speed)" : "");
  return true;
}

bool GlfwViewer::draw() {
  display_->poll();
  frame_ = reader_->latest();
  if (frame_ != nullptr && !display_->lost() && !draw_frame()) return false;
  if (display_->lost()) {
    log_.warning("the display server is gone");
    return false;
  }
  pace();
  return !quit_ && !windows_.empty();
}

bool GlfwViewer::draw_frame() {
  const std::int64_t now_ns = base::steady_ns();
  const state::Structure& structure = *frame_->structure;
  close_windows();
  if (windows_.empty()) return false;
  homes_.take(*frame_);
  motion_.take(*frame_);
  if (structure.version != matched_version_) {
    std::string why;
    if (!match_windows(structure, why)) {
      if (!display_->lost()) log_.error("%s: no window is left", why.c_str());
      return false;
    }
  }
  root_->make_current();
  log_.report(store_->take(structure));
  const ScenePoses& poses = motion_.at(now_ns);
  store_->pose(poses.nodes);
  const bool framing =
      std::any_of(windows_.begin(), windows_.end(), [](const auto& window) { return window->view().wants_framing(); });
  CameraWindow::Scene scene{*frame_,
                            poses,
                            framing ? things_in(structure, store_->scene(), poses.bodies) : std::vector<Sphere>{},
                            quality_.quality(),
                            {},
                            now_ns,
                            labels()};
  for (const state::PickState& pick : frame_->picks) scene.outlined.push_back(pick.body);
  scene.normal_maps = normal_maps_;
  scene.software = software_;
  follow_loads(poses);
  handle_inputs(scene);
  if (!draw_windows(scene)) return false;
  tell_rates(now_ns);
  return true;
}

// A view that shows nothing of what was loaded turns to it.
void GlfwViewer::follow_loads(const ScenePoses& poses) {
  const state::Structure& structure = *frame_->structure;
  state::ModelId newest = newest_model_;
  for (const state::ModelInfo& model : structure.models) newest = std::max(newest, model.id);
  if (newest == newest_model_) return;
  const std::vector<Sphere> things = things_of_models(structure, store_->scene(), poses.bodies, newest_model_);
  const bool at_start = newest_model_ == state::kWorldModel;
  newest_model_ = newest;
  if (things.empty()) return;
  for (const auto& window : windows_) {
    if (at_start ? options_.frame_loaded : !window->shows_any(things)) window->view().frame(things);
  }
}

void GlfwViewer::frame_all(CameraWindow& window) {
  const ScenePoses& poses = motion_.at(base::steady_ns());
  std::vector<Sphere> things = things_in(*frame_->structure, store_->scene(), poses.bodies);
  if (!things.empty()) window.view().frame(std::move(things));
}

bool GlfwViewer::draw_windows(const CameraWindow::Scene& scene) {
  choose_pace_maker();
  bool any = false;
  for (const auto& window : windows_) {
    if (window->window().hidden()) continue;
    any = true;
    std::string why;
    if (!window->draw(scene, why)) {
      if (display_->lost()) return true;  // draw() says so
      log_.error("%s: the windows are closed", why.c_str());
      return false;
    }
    if (software_) gl_.Finish();
  }
  if (!any) return true;
  const double seconds = base::to_seconds(base::steady_ns() - scene.now_ns);
  using Painting = CameraWindow::Painting;
  const auto any_is = [&](Painting painting) {
    return std::any_of(windows_.begin(), windows_.end(),
                       [&](const auto& window) { return window->painting() == painting; });
  };
  still_ = !any_is(Painting::in_motion);
  // Pictures of what rests say nothing of what motion costs.
  if (!still_ && !any_is(Painting::at_rest)) quality_.picture_done(scene.now_ns, seconds);
  drawing_s_ += seconds;
  for (const auto& window : windows_) {
    if (window->window().hidden() || display_->lost()) continue;
    window->window().make_current();
    window->window().show_picture();
  }
  ++pictures_;
  return true;
}

// Only one window waits for its display: several would wait for each other, at a fraction of the rate.
void GlfwViewer::choose_pace_maker() {
  if (software_) return;  // pace() does it
  GlfwWindow* first = nullptr;
  for (const auto& window : windows_) {
    if (first == nullptr && !window->window().hidden()) first = &window->window();
  }
  if (first == pace_maker_) return;
  pace_maker_ = first;
  for (const auto& window : windows_) {
    window->window().make_current();
    window->window().wait_for_display(&window->window() == first);
  }
}

std::vector<std::string> GlfwViewer::labels() const {
  if (!labels_) return {};
  char times[96], rates[96];
  std::snprintf(times, sizeof times, "Wall Time: %.2f s / Sim Time: %.2f s", frame_->wall_time, frame_->sim_time);
  std::snprintf(rates, sizeof rates, "Gfx (%.0f Hz) / Phx (%.0f Hz)", rate_, frame_->run.steps_per_second);
  return {times, rates};
}

void GlfwViewer::tell_rates(std::int64_t now_ns) {
  if (told_ns_ == 0) told_ns_ = now_ns;
  if (now_ns - told_ns_ < kTellEvery_ns) return;
  const auto pictures = static_cast<double>(pictures_ - pictures_told_);
  rate_ = pictures / base::to_seconds(now_ns - told_ns_);
  simulation_.observe.report_graphics(rate_, pictures > 0.0 ? drawing_s_ / pictures : 0.0);
  drawing_s_ = 0.0;
  pictures_told_ = pictures_;
  told_ns_ = now_ns;
  for (const auto& window : windows_) window->set_title(title_of(*window));
}

bool GlfwViewer::all_hidden() const {
  return std::all_of(windows_.begin(), windows_.end(), [](const auto& window) { return window->window().hidden(); });
}

void GlfwViewer::pace() {
  const std::int64_t now_ns = base::steady_ns();
  const std::int64_t shortest = all_hidden() ? kHiddenPicture_ns
                                : software_  ? (still_ ? kStillPicture_ns : kSoftwarePicture_ns)
                                             : kShortestPicture_ns;
  next_ns_ = std::max(next_ns_ + shortest, now_ns);
  // A late picture is not made up for; an early one waits.
  if (next_ns_ > now_ns + shortest) next_ns_ = now_ns + shortest;
  if (next_ns_ > now_ns) base::sleep_until(next_ns_);
}

}  // namespace ambf::render
