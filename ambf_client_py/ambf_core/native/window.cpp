#include "window.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "frame_capsule.h"
#include "render/window/viewer.h"
#include "shown_world.h"

namespace nb = nanobind;

namespace ambf::python {

namespace {

constexpr std::chrono::milliseconds kBetweenSignals{50};  // Ctrl-C is seen after so long
std::atomic<bool> one_is_open{false};                     // the connection to the display is one of the process

class ShownWindow {
 public:
  explicit ShownWindow(const state::Frame& frame) : world_(frame, log_) {
    if (one_is_open.exchange(true)) throw std::runtime_error("no window: this process has one; close() it first");
    std::promise<std::string> opened;
    std::future<std::string> why = opened.get_future();
    thread_ = std::thread([this, &opened] { run(opened); });
    if (const std::string reason = why.get(); !reason.empty()) {
      close();
      throw std::runtime_error("no window: " + reason);
    }
  }
  ~ShownWindow() { close(); }
  ShownWindow(const ShownWindow&) = delete;
  ShownWindow& operator=(const ShownWindow&) = delete;

  void close() {
    if (!thread_.joinable()) return;
    stop_ = true;
    thread_.join();
    one_is_open = false;
  }
  ShownWorld& world() { return world_; }
  std::vector<std::tuple<int, std::string>> take_log() {
    std::vector<std::tuple<int, std::string>> lines;
    base::LogRecord record;
    while (log_.take(record)) lines.emplace_back(static_cast<int>(record.severity), record.text);
    return lines;
  }

 private:
  void run(std::promise<std::string>& opened) {
    std::string why;
    render::ViewerOptions options;
    options.only_watches = true;
    std::unique_ptr<render::Viewer> viewer = render::Viewer::open(world_.abilities(), log_, options, why);
    opened.set_value(viewer != nullptr ? "" : why.empty() ? "it cannot be opened" : why);
    while (viewer != nullptr && !stop_ && viewer->draw()) {
    }
    viewer.reset();
    world_.end();
  }

  base::Log log_;
  ShownWorld world_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// Of the process that made it: a forked one has no such thread.
class PythonWindow {
 public:
  explicit PythonWindow(const nb::capsule& frame) {
    const state::Frame& first = frame_in(frame);
    const nb::gil_scoped_release release;
    window_ = std::make_unique<ShownWindow>(first);
  }
  ~PythonWindow() {
    if (process_ != getpid()) {
      (void)window_.release();
    } else {
      close();
    }
  }
  PythonWindow(const PythonWindow&) = delete;
  PythonWindow& operator=(const PythonWindow&) = delete;

  void close() {
    if (window_ == nullptr) return;
    ShownWindow& window = here();
    const nb::gil_scoped_release release;
    window.close();
  }
  bool closed() { return window_ == nullptr || here().world().ended(); }
  bool take_reset() { return here().world().take_reset(); }
  std::vector<std::tuple<int, std::string>> take_log() { return here().take_log(); }
  void show(const nb::capsule& frame, double seconds) {
    const state::Frame& next = frame_in(frame);
    ShownWorld& world = here().world();
    const nb::gil_scoped_release release;
    world.show(next, seconds);
  }
  void wait() {
    ShownWorld& world = here().world();
    for (;;) {
      {
        const nb::gil_scoped_release release;
        if (world.wait_until_over(kBetweenSignals)) return;
      }
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
    }
  }

 private:
  ShownWindow& here() {
    if (process_ != getpid()) throw std::runtime_error("the window belongs to the process that forked this one");
    return *window_;
  }

  std::unique_ptr<ShownWindow> window_;
  const pid_t process_ = getpid();
};

}  // namespace

void bind_window(nb::module_& m) {
  nb::class_<PythonWindow>(m, "Window")
      .def(nb::init<const nb::capsule&>())
      .def("show", &PythonWindow::show)
      .def("wait", &PythonWindow::wait)
      .def("closed", &PythonWindow::closed)
      .def("take_reset", &PythonWindow::take_reset)
      .def("take_log", &PythonWindow::take_log)
      .def("close", &PythonWindow::close);
}

}  // namespace ambf::python
