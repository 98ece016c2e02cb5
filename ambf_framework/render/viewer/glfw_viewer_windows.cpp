// Which windows there are: one a visible camera.
#include <algorithm>

#include "render/marks/device_text.h"
#include "render/viewer/detail/glfw_viewer.h"

namespace ambf::render {

namespace {

struct Wanted {
  state::ObjectId camera;
  unsigned monitor = 0;
};

}  // namespace

bool GlfwViewer::match_windows(const state::Structure& structure, std::string& why) {
  matched_version_ = structure.version;
  const std::size_t monitors = display_->work_areas().size();
  std::vector<Wanted> wanted;
  for (const state::CameraInfo& camera : structure.cameras) {
    const state::ObjectId id = structure.objects[camera.object].id;
    const bool closed = std::find(closed_.begin(), closed_.end(), id) != closed_.end();
    if (camera.visible && !closed) wanted.push_back({id, camera.monitor < monitors ? camera.monitor : 0});
  }
  const auto shows_one_of_them = [&](const std::unique_ptr<CameraWindow>& window) {
    return std::any_of(wanted.begin(), wanted.end(),
                       [&](const Wanted& camera) { return camera.camera == window->camera(); });
  };
  // Windows without a camera (any more) serve the next one that has no window, or go. The last one stays, with a view
  // of its own.
  std::vector<CameraWindow*> free;
  for (const auto& window : windows_) {
    if (!shows_one_of_them(window)) free.push_back(window.get());
  }
  for (const Wanted& camera : wanted) {
    const bool shown = std::any_of(windows_.begin(), windows_.end(),
                                   [&](const auto& window) { return window->camera() == camera.camera; });
    if (shown) continue;
    if (!free.empty()) {
      free.front()->serve(camera.camera);
      free.erase(free.begin());
      continue;
    }
    const auto on_monitor = std::count_if(wanted.begin(), wanted.end(),
                                          [&](const Wanted& other) { return other.monitor == camera.monitor; });
    if (!open_window(camera.camera, camera.monitor, static_cast<unsigned>(on_monitor), why)) {
      log_.error("camera '%s' gets no window: %s",
                 structure.objects[state::find(structure, camera.camera)].name.c_str(), why.c_str());
      closed_.push_back(camera.camera);
    }
  }
  if (windows_.size() == free.size()) {  // none shows a camera
    if (free.empty() && !open_window({}, 0, 1, why)) return false;
    if (!free.empty()) {
      if (free.front()->camera().valid()) free.front()->serve({});
      free.erase(free.begin());
    }
  }
  std::erase_if(windows_,
                [&](const auto& window) { return std::find(free.begin(), free.end(), window.get()) != free.end(); });
  pace_maker_ = nullptr;
  return true;
}

bool GlfwViewer::open_window(state::ObjectId camera, unsigned monitor, unsigned expected, std::string& why) {
  unsigned number = 1;
  for (const auto& window : windows_) number = std::max(number, window->number() + 1);
  const CameraWindow::Shared shared{simulation_, *display_, *root_, gl_, *store_, picked_, log_, messages_, parts_};
  auto window = CameraWindow::open(shared, number, camera, place_on(monitor, expected), why);
  if (window == nullptr) return false;
  windows_.push_back(std::move(window));
  return true;
}

// The first place there that no window has yet.
Area GlfwViewer::place_on(unsigned monitor, unsigned expected) const {
  const std::vector<Area> areas = display_->work_areas();
  if (monitor >= areas.size()) monitor = 0;  // a monitor may go any time
  unsigned taken = 0;
  for (const auto& window : windows_) taken += window->window().monitor() == monitor ? 1 : 0;
  return place_window(taken, std::max(expected, taken + 1), areas[monitor]);
}

void GlfwViewer::close_windows() {
  const auto closed = std::erase_if(windows_, [&](const auto& window) {
    if (!window->window().close_asked()) return false;
    if (window->camera().valid()) closed_.push_back(window->camera());
    return true;
  });
  if (closed > 0) pace_maker_ = nullptr;
}

std::string GlfwViewer::title_of(const CameraWindow& window) const {
  std::string title = "AMBF Simulator Window " + std::to_string(window.number());
  for (const std::string& device : devices_of(window)) title += " - " + device;
  if (frame_->run.diverged) return title + " | diverged";
  return frame_->run.paused ? title + " | paused" : title;
}

// Those that the camera's block names, and those that see through it.
std::vector<std::string> GlfwViewer::devices_of(const CameraWindow& window) const {
  std::vector<std::string> names = window.view().info().controlling_devices;
  for (unsigned device = 0; simulation_.devices != nullptr && device < simulation_.devices->count(); ++device) {
    const std::shared_ptr<const state::DeviceInfo> info = simulation_.devices->info(device);
    const bool named = std::find(names.begin(), names.end(), info->name) != names.end();
    state::DeviceStatus status;
    simulation_.devices->status(device, status);
    if (!named && !is_left(*info, status) && pairs_with(*info, window.view().object())) names.push_back(info->name);
  }
  return names;
}

void GlfwViewer::toggle_full_screen() {
  full_screen_ = !full_screen_;
  if (!full_screen_) {
    for (const auto& window : windows_) window->window().leave_full_screen();
    return;
  }
  std::vector<unsigned> monitors;
  for (const auto& window : windows_) monitors.push_back(window->window().monitor());
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    const auto parts = std::count(monitors.begin(), monitors.end(), monitors[i]);
    const auto part = std::count(monitors.begin(), monitors.begin() + static_cast<std::ptrdiff_t>(i), monitors[i]);
    windows_[i]->window().fill_monitor(static_cast<unsigned>(part), static_cast<unsigned>(parts));
  }
}

}  // namespace ambf::render
