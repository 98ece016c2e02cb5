// A window on the display with an OpenGL 3.3 context (GLFW). Collects what the user does; draws nothing itself. Main thread. When the
// display server dies the process goes on: display_lost() says so, and then no window may be touched any more, nor closed.
// Private to render/.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/input.h"

struct GLFWwindow;

namespace ambf::render {

// The connection to the display. One at a time in a process.
class Display {
 public:
  ~Display();
  static std::unique_ptr<Display> open(std::string& why);
  bool lost() const;  // the server is gone

 private:
  Display() = default;
};

class Window {
 public:
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // On monitor number `monitor` (the first when there are fewer). Its context is current afterwards. Null with the reason in `why`.
  static std::unique_ptr<Window> open(Display& display, const std::string& title, unsigned monitor, std::string& why);

  std::vector<Input> take_inputs();  // since the last call; asks the display first
  bool close_asked() const;
  bool hidden() const;  // minimised
  void set_title(const std::string& title);
  void toggle_full_screen();
  void show_picture();  // swaps buffers
  void wait_for_display(bool wait);

  struct Size {
    int width = 0, height = 0;
  };
  Size size() const;     // window units, as inputs count
  Size picture() const;  // pixels
  static void* address_of(const char* function);

 private:
  explicit Window(Display& display) : display_(display) {}
  void listen();

  Display& display_;
  GLFWwindow* window_ = nullptr;
  std::vector<Input> inputs_;
  bool full_screen_ = false;
  int x_ = 0, y_ = 0, width_ = 0, height_ = 0;  // before full screen
};

}  // namespace ambf::render
