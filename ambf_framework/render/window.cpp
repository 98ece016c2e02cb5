#include "render/window.h"

#include <GL/glcorearb.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <dlfcn.h>

#include <atomic>
#include <cctype>
#include <cstdlib>
#include <utility>

namespace ambf::render {

namespace {

// GLFW itself is global, so what it tells is too: its last complaint, and whether the display server is gone.
std::string& last_complaint() {
  static std::string text;
  return text;
}
std::atomic<bool>& server_gone() {
  static std::atomic<bool> gone{false};
  return gone;
}

// When the X server dies, Xlib complains by one handler, which ends the process by default, and then calls another, which does so too.
// Ours return. GLFW may run on Wayland, without Xlib: hence looked up by name.
void survive_the_x_server() {
  using GetDisplay = void* (*)();
  using ErrorHandler = int (*)(void* display);
  using SetErrorHandler = ErrorHandler (*)(ErrorHandler);
  using ExitHandler = void (*)(void* display, void* user);
  using SetExitHandler = void (*)(void* display, ExitHandler, void* user);
  const auto get = reinterpret_cast<GetDisplay>(dlsym(RTLD_DEFAULT, "glfwGetX11Display"));
  const auto set_error = reinterpret_cast<SetErrorHandler>(dlsym(RTLD_DEFAULT, "XSetIOErrorHandler"));
  const auto set_exit = reinterpret_cast<SetExitHandler>(dlsym(RTLD_DEFAULT, "XSetIOErrorExitHandler"));
  void* display = get != nullptr ? get() : nullptr;
  if (display == nullptr || set_error == nullptr || set_exit == nullptr) return;
  set_error([](void*) {
    server_gone() = true;
    return 0;
  });
  set_exit(
      display, [](void*, void*) { server_gone() = true; }, nullptr);
}

Modifiers modifiers_of(int mods) {
  return {(mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0, (mods & GLFW_MOD_SHIFT) != 0};
}

// What is printed on the key in the user's layout; digits by their place, since some layouts print other signs there.
std::string name_of_key(int key, int scancode) {
  if (key == GLFW_KEY_ESCAPE) return "Esc";
  if (key == GLFW_KEY_SPACE) return "Space";
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return std::string(1, static_cast<char>('0' + key - GLFW_KEY_0));
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return std::string(1, static_cast<char>('0' + key - GLFW_KEY_KP_0));
  const char* printed = glfwGetKeyName(key, scancode);
  if (printed != nullptr && printed[0] != 0 && printed[1] == 0) {
    return std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(printed[0]))));
  }
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return std::string(1, static_cast<char>('A' + key - GLFW_KEY_A));
  return {};
}

std::vector<Input>& inputs_of(GLFWwindow* window) {
  return *static_cast<std::vector<Input>*>(glfwGetWindowUserPointer(window));
}

bool left_shift(GLFWwindow* window) { return glfwGetKey(window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS; }

}  // namespace

std::unique_ptr<Display> Display::open(std::string& why) {
  server_gone() = false;
  last_complaint().clear();
  glfwSetErrorCallback([](int, const char* text) { last_complaint() = text; });
  if (glfwInit() != GLFW_TRUE) {
    why = "no display";
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) {
      why += " (DISPLAY is not set)";
    } else if (!last_complaint().empty()) {
      why += " (" + last_complaint() + ")";
    }
    return nullptr;
  }
  survive_the_x_server();
  return std::unique_ptr<Display>(new Display);
}

// The connection stays until the process ends: drivers do not unload cleanly, and after the server's death every call would wait for it
// or end the process. Opening again finds it as it is.
Display::~Display() = default;

bool Display::lost() const { return server_gone(); }

std::unique_ptr<Window> Window::open(Display& display, const std::string& title, unsigned monitor, std::string& why) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  int left = 0, top = 0, wide = 1280, high = 1024;
  if (count > 0) {
    const unsigned index = monitor < static_cast<unsigned>(count) ? monitor : 0;
    glfwGetMonitorWorkarea(monitors[index], &left, &top, &wide, &high);
  }
  // The reference's size and place: 80 % by 50 % of the monitor, in its middle.
  const int width = wide * 8 / 10, height = high / 2;
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // pictures are drawn elsewhere (canvas.h)
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  std::unique_ptr<Window> window(new Window(display));
  window->window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window->window_ == nullptr) {
    why = "no window with OpenGL 3.3 (" + last_complaint() + ")";
    return nullptr;
  }
  glfwSetWindowPos(window->window_, left + (wide - width) / 2, top + (high - height) / 2);
  window->listen();
  glfwMakeContextCurrent(window->window_);
  glfwShowWindow(window->window_);
  return window;
}

Window::~Window() {
  if (window_ != nullptr && !display_.lost()) glfwDestroyWindow(window_);
}

void Window::listen() {
  glfwSetWindowUserPointer(window_, &inputs_);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int mods) {
    if (action == GLFW_RELEASE) return;
    std::string name = name_of_key(key, scancode);
    if (!name.empty())
      inputs_of(window).push_back(KeyInput{std::move(name), modifiers_of(mods), action == GLFW_REPEAT});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    ButtonInput input;
    input.button = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::left
                   : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::right
                                                       : MouseButton::middle;
    input.pressed = action == GLFW_PRESS;
    input.modifiers = modifiers_of(mods);
    glfwGetCursorPos(window, &input.x, &input.y);
    inputs_of(window).push_back(input);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    inputs_of(window).push_back(MotionInput{x, y, left_shift(window)});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double notches) {
    inputs_of(window).push_back(WheelInput{notches, left_shift(window)});
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    inputs_of(window).push_back(DropInput{std::vector<std::string>(paths, paths + count)});
  });
}

std::vector<Input> Window::take_inputs() {
  glfwPollEvents();
  return std::exchange(inputs_, {});
}

bool Window::close_asked() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

bool Window::hidden() const { return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE; }

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

void Window::toggle_full_screen() {
  full_screen_ = !full_screen_;
  if (!full_screen_) {
    glfwSetWindowMonitor(window_, nullptr, x_, y_, width_, height_, GLFW_DONT_CARE);
    return;
  }
  glfwGetWindowPos(window_, &x_, &y_);
  glfwGetWindowSize(window_, &width_, &height_);
  // The monitor that shows the window's middle.
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    int left = 0, top = 0;
    glfwGetMonitorPos(monitors[i], &left, &top);
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    const int middle_x = x_ + width_ / 2 - left, middle_y = y_ + height_ / 2 - top;
    const bool here = middle_x >= 0 && middle_y >= 0 && middle_x < mode->width && middle_y < mode->height;
    if (!here && i + 1 < count) continue;
    glfwSetWindowMonitor(window_, monitors[i], 0, 0, mode->width, mode->height, mode->refreshRate);
    return;
  }
  full_screen_ = false;
}

void Window::show_picture() { glfwSwapBuffers(window_); }

void Window::wait_for_display(bool wait) { glfwSwapInterval(wait ? 1 : 0); }

Window::Size Window::size() const {
  Size size;
  glfwGetWindowSize(window_, &size.width, &size.height);
  return server_gone() ? Size() : size;  // a server that dies while it is asked leaves anything in them
}

Window::Size Window::picture() const {
  Size size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return server_gone() ? Size() : size;
}

void* Window::address_of(const char* function) { return reinterpret_cast<void*>(glfwGetProcAddress(function)); }

}  // namespace ambf::render
