// A window of GLFW's on the display, with an OpenGL 3.3 context. Collects inputs; draws nothing itself. Main thread.
// When the display server dies the process goes on: Display::lost() reports it, and then no window may be used or
// closed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/log.h"
#include "render/window/detail/window_place.h"
#include "render/window/input.h"

struct GLFWwindow;

namespace ambf::render {

// The connection to the display. One at a time in a process.
class Display {
 public:
  ~Display();
  static std::unique_ptr<Display> open(std::string& why);

  bool lost() const;                     // the server is gone
  void poll();                           // windows collect inputs; never waits
  std::vector<Area> work_areas() const;  // of all monitors; at least one

 private:
  Display() = default;
};

// What a window's callbacks have heard since it was last asked.
struct Heard {
  std::vector<Input> inputs;
  MotionInput pointer;  // the last one
  bool pointed = false;
};

class GlfwWindow {
 public:
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  // Null with the reason in `why`. Its context is current afterwards and shares meshes, textures and programs with that
  // of `share`.
  static std::unique_ptr<GlfwWindow> open(Display& display, const std::string& title, const Area& place,
                                          const GlfwWindow& share, std::string& why);
  // Hidden: only a context, which keeps shared objects alive when windows close. With `checks` the driver checks
  // what it is asked, in this context and those that share with it, and reports its errors there.
  static std::unique_ptr<GlfwWindow> open_hidden(Display& display, base::Log* checks, std::string& why);

  void make_current();
  std::vector<Input> take_inputs();  // since the last call
  bool close_asked() const;
  bool hidden() const;  // minimised
  void set_title(const std::string& title);
  void show_picture();               // swaps buffers; its context is current
  void wait_for_display(bool wait);  // in show_picture(); its context is current

  // All of the monitor that shows its middle, or one of several equal parts of it.
  void fill_monitor(unsigned part, unsigned parts);
  void leave_full_screen();
  unsigned monitor() const;  // that shows its middle

  struct Size {
    int width = 0, height = 0;
  };
  Size size() const;     // window units, as inputs count
  Size picture() const;  // pixels
  double scale() const;  // of text: 2 on a high-density screen
  static void* address_of(const char* function);
  void set_clipboard(const std::string& text);
  std::string clipboard() const;

 private:
  explicit GlfwWindow(Display& display) : display_(display) {}
  static std::unique_ptr<GlfwWindow> create(Display& display, const std::string& title, int width, int height,
                                            const GlfwWindow* share, base::Log* checks, std::string& why);
  void listen();

  Display& display_;
  GLFWwindow* window_ = nullptr;
  base::Log* checks_ = nullptr;
  Heard heard_;
  bool full_screen_ = false;
  Area before_;  // full screen
};

}  // namespace ambf::render
