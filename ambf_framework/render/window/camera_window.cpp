#include "render/window/camera_window.h"

#include <algorithm>
#include <optional>

#include "base/clock.h"
#include "render/marks/label_layout.h"
#include "render/window/overlay.h"
#include "state/tasks.h"

namespace ambf::render {

CameraWindow::CameraWindow(const Shared& shared, unsigned number, state::ObjectId camera)
    : shared_(shared),
      number_(number),
      camera_(camera),
      wanted_(camera),
      view_(std::make_unique<ViewCamera>(shared.simulation.command, shared.simulation.tune, camera)),
      recorder_(shared.log, shared.messages),
      picker_(shared.simulation.pick) {}

std::unique_ptr<CameraWindow> CameraWindow::open(const Shared& shared, unsigned number, state::ObjectId camera,
                                                 const Area& place, std::string& why) {
  std::unique_ptr<CameraWindow> view(new CameraWindow(shared, number, camera));
  view->title_ = "AMBF Simulator Window " + std::to_string(number);
  view->window_ = GlfwWindow::open(shared.display, view->title_, place, shared.root, why);
  if (view->window_ == nullptr) return nullptr;
  view->painter_ = std::make_unique<PictureComposer>(shared.gl, shared.store);
  const bool built = view->painter_->build(why);
  if (!built) return nullptr;
  shared.root.make_current();
  return view;
}

CameraWindow::~CameraWindow() {
  if (picker_.pressed()) picker_.release();
  view_->rest();
  if (window_ == nullptr) return;
  if (!shared_.display.lost()) window_->make_current();
  if (painter_ != nullptr) {
    for (const auto& part : shared_.parts) part->on_close(number_);
  }
  painter_.reset();
  window_.reset();
  if (!shared_.display.lost()) shared_.root.make_current();
}

void CameraWindow::serve(state::ObjectId camera) {
  camera_ = wanted_ = camera;
  look_through(camera);
}

void CameraWindow::look_through(state::ObjectId camera) {
  if (picker_.pressed()) picker_.release();
  view_->rest();
  rotating_ = panning_ = looking_ = false;
  auto view = std::make_unique<ViewCamera>(shared_.simulation.command, shared_.simulation.tune, camera);
  if (camera_.valid()) view->begin_like(*view_);
  view_ = std::move(view);
}

void CameraWindow::set_title(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  window_->set_title(title);
}

WindowMoment CameraWindow::moment(const Scene& scene) {
  WindowMoment moment;
  moment.window = number_;
  moment.frame = &scene.frame;
  moment.poses = &scene.poses;
  moment.now_ns = scene.now_ns;
  moment.shows.layers = &layers;
  moment.shows.looks = &looks;
  moment.shows.measure = &measure;
  moment.choices.picked = shared_.picked;
  moment.choices.set_picked = &shared_.picked;
  moment.choices.set_camera = &wanted_;
  moment.recorder = &recorder_;
  moment.view = view_.get();
  moment.camera_object = view_->object();
  moment.camera = view_->camera();
  moment.sizes = sizes();
  return moment;
}

// Films and screenshots are of the whole window, as if nothing covered it.
WindowSizes CameraWindow::sizes() const {
  const auto [picture_width, picture_height] = window_->picture();
  const auto [width, height] = window_->size();
  int covered = 0;
  if (!whole_) {
    for (const auto& part : shared_.parts) covered = std::max(covered, part->covered(number_));
  }
  WindowSizes sizes;
  sizes.picture_width = std::max(picture_width - covered, 1);
  sizes.picture_height = picture_height;
  sizes.window_picture_width = picture_width;
  sizes.width = picture_width > 0 ? static_cast<double>(width) * sizes.picture_width / picture_width : 0.0;
  sizes.height = height;
  sizes.mirrored = gestures_.mirrored;
  sizes.scale = window_->scale();
  return sizes;
}

std::pair<double, double> CameraWindow::scene_size() const {
  const WindowSizes all = sizes();
  return {all.width, all.height};
}

bool CameraWindow::shows_any(const std::vector<Sphere>& things) const {
  const auto [width, height] = scene_size();
  if (width <= 0.0 || height <= 0.0) return true;
  const Camera& camera = view_->camera();
  const Frustum frustum(projection_matrix(camera, width / height) * view_matrix(camera.T_world_camera));
  return std::any_of(things.begin(), things.end(), [&](const Sphere& thing) { return frustum.may_see(thing); });
}

void CameraWindow::choose_quality(const Scene& scene, PictureJob& job) {
  painting_ = Painting::in_motion;
  if (recording_ || gestures_.mirrored) job.quality.resolution = 1.0;
  // In stereo the canvas holds the other eye's picture.
  const bool still = scene.software && !view_->lens().stereo && painter_->shows(job);
  if (!still) {
    still_since_ns_ = scene.now_ns;
    return;
  }
  const std::optional<Quality> resting = resting_quality(base::to_seconds(scene.now_ns - still_since_ns_));
  const bool whole = painted_.resolution == 1.0;
  const bool as_good = whole && resting && painted_.samples >= resting->samples;
  if (as_good || (!resting && (whole || !recording_))) {
    painting_ = Painting::repeated;
    job.quality = painted_;
  } else if (resting) {
    painting_ = Painting::at_rest;
    job.quality = *resting;
  }
}

// What one eye sees, in its part of the window.
bool CameraWindow::draw_eye(const Scene& scene, const EyeView& eye, int height, std::string& why) {
  WindowMoment now = moment(scene);
  now.camera = eye.camera;
  const int width = now.sizes.picture_width = static_cast<int>(eye.width);
  WorldShapes debug;
  for (const auto& part : shared_.parts) part->draw_debug(now, debug);
  TextDrawing text(letters_, width, height);
  draw_labels(lay_out(debug.texts(), now.camera, width, height, *letters_), text);
  PictureJob job;
  job.structure = scene.frame.structure.get();
  job.poses = &scene.poses;
  job.camera = now.camera;
  job.width = width;
  job.height = height;
  job.quality = scene.quality;
  job.extras = {scene.outlined, &debug, &text, looks.by_slot(*job.structure, layers.shows(LayerId::no_visuals))};
  job.line_px = 2.0 * window_->scale();
  job.normal_maps = scene.normal_maps;
  job.multipass = view_->multipass();
  choose_quality(scene, job);
  if (painting_ != Painting::repeated && !painter_->paint(job, why)) return false;
  painted_ = job.quality;
  if (recording_) record(static_cast<int>(eye.left));
  const Canvas::Place place{static_cast<int>(eye.left), 0, width, height};
  if (gestures_.mirrored) {
    painter_->canvas().resolve_mirrored_to(0, place);
  } else {
    painter_->canvas().resolve_to(0, place);
  }
  if (painted_.resolution < 1.0) {
    shared_.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    shared_.gl.Viewport(place.left, place.bottom, place.width, place.height);
    painter_->draw_over(text);
  }
  return true;
}

// Copies what was just painted into the picture for the recorder.
void CameraWindow::record(int left) {
  const Image eye = painter_->canvas().read();
  const auto row_bytes = 3 * static_cast<std::size_t>(picture_.width);
  const int columns = std::min(eye.width, picture_.width - left), rows = std::min(eye.height, picture_.height);
  for (int y = 0; y < rows; ++y) {
    const std::uint8_t* from = eye.rgba.data() + 4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(eye.width);
    std::uint8_t* to =
        picture_.rgb.data() + static_cast<std::size_t>(y) * row_bytes + 3 * static_cast<std::size_t>(left);
    for (int x = 0; x < columns; ++x, from += 4, to += 3) std::copy(from, from + 3, to);
  }
}

bool CameraWindow::draw(const Scene& scene, std::string& why) {
  const auto [window_width, height] = window_->picture();
  if (window_width <= 0 || height <= 0) return true;
  recording_ = recorder_.wants(scene.frame.sim_time);
  whole_ = recording_ || recorder_.filming();
  const int width = sizes().picture_width;
  if (wanted_.valid() && state::find(*scene.frame.structure, wanted_) == state::kNone) wanted_ = camera_;  // gone
  if (wanted_ != view_->object()) look_through(wanted_);
  const double aspect = static_cast<double>(width) / height;
  view_->follow(scene.frame, scene.poses, scene.things, aspect, scene.now_ns);
  const WindowMoment now = moment(scene);
  if (letters_ == nullptr || letters_->scale() != now.sizes.scale)
    letters_ = std::make_shared<const Lettering>(now.sizes.scale);
  if (picker_.update(scene.frame, scene.poses, now.camera)) {
    shared_.picked = picker_.last();
    const state::Structure& structure = *scene.frame.structure;
    const std::string& name = structure.objects[state::find(structure, shared_.picked)].name;
    shared_.messages->add("picked " + name +
                          (picker_.holds() ? "" : ", which is part of the room: the panel's arrows move it"));
  }

  window_->make_current();
  if (recording_) {
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    picture_ = {width, height, std::vector<std::uint8_t>(3 * pixels)};
  }
  for (const EyeView& eye : eyes_of(now.camera, view_->lens(), width)) {
    if (eye.width >= 1.0 && !draw_eye(scene, eye, height, why)) return false;
  }
  if (recording_) recorder_.take(std::move(picture_), scene.frame.sim_time);

  shared_.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  if (width < window_width) {  // what a part covers it draws itself, but may have moved since the last picture
    shared_.gl.Enable(GL_SCISSOR_TEST);
    shared_.gl.Scissor(width, 0, window_width - width, height);
    shared_.gl.ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    shared_.gl.Clear(GL_COLOR_BUFFER_BIT);
    shared_.gl.Disable(GL_SCISSOR_TEST);
  }
  shared_.gl.Viewport(0, 0, width, height);
  TextDrawing over(letters_, width, height);
  std::vector<std::string> messages = shared_.messages->shown(scene.now_ns);
  if (measure.on()) messages.push_back(measure.hint());
  OverlayText text{std::move(messages), {}};
  if (!help.shown()) text.labels = scene.labels;
  if (!help.shown()) text.tasks = state::task_lines(scene.frame);
  const state::DeviceAbility* devices = shared_.simulation.devices;
  if (devices != nullptr && !text.labels.empty()) text.devices = device_lines(*devices, view_->object());
  draw_overlay(text, over);
  painter_->draw_over(over);
  if (const TextDrawing* card = help.drawing(width, height, now.sizes.scale)) painter_->draw_over(*card);
  shared_.gl.Viewport(0, 0, window_width, height);
  for (auto part = shared_.parts.rbegin(); part != shared_.parts.rend(); ++part) (*part)->draw_over(now);
  return true;
}

}  // namespace ambf::render
