#include "render/window/detail/glfw_window.h"

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

// GLFW itself is global, so what it reports is too: its last error, and whether the display server is gone.
std::string& last_complaint() {
  static std::string text;
  return text;
}
std::atomic<bool>& server_gone() {
  static std::atomic<bool> gone{false};
  return gone;
}

// When the X server dies, Xlib complains by one handler, which ends the process by default, and then calls another,
// which does so too. Ours return. GLFW may run on Wayland, without Xlib: hence looked up by name.
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

struct NamedKey {
  int key;
  const char* name;
};
constexpr NamedKey kNamedKeys[] = {
    {GLFW_KEY_ESCAPE, "Esc"},
    {GLFW_KEY_SPACE, "Space"},
    {GLFW_KEY_TAB, "Tab"},
    {GLFW_KEY_ENTER, "Enter"},
    {GLFW_KEY_KP_ENTER, "Enter"},
    {GLFW_KEY_BACKSPACE, "Backspace"},
    {GLFW_KEY_INSERT, "Insert"},
    {GLFW_KEY_DELETE, "Delete"},
    {GLFW_KEY_LEFT, "Left"},
    {GLFW_KEY_RIGHT, "Right"},
    {GLFW_KEY_UP, "Up"},
    {GLFW_KEY_DOWN, "Down"},
    {GLFW_KEY_PAGE_UP, "PgUp"},
    {GLFW_KEY_PAGE_DOWN, "PgDn"},
    {GLFW_KEY_HOME, "Home"},
    {GLFW_KEY_END, "End"},
    {GLFW_KEY_LEFT_SHIFT, "Shift"},
    {GLFW_KEY_RIGHT_SHIFT, "Shift"},
    {GLFW_KEY_LEFT_CONTROL, "Ctrl"},
    {GLFW_KEY_RIGHT_CONTROL, "Ctrl"},
    {GLFW_KEY_LEFT_ALT, "Alt"},
    {GLFW_KEY_RIGHT_ALT, "Alt"},
};

// What is printed on the key in the user's layout; digits by their place, since some layouts print other signs there.
std::string name_of_key(int key, int scancode) {
  for (const NamedKey& named : kNamedKeys) {
    if (named.key == key) return named.name;
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return std::string(1, static_cast<char>('0' + key - GLFW_KEY_0));
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return std::string(1, static_cast<char>('0' + key - GLFW_KEY_KP_0));
  const char* printed = glfwGetKeyName(key, scancode);
  if (printed != nullptr && printed[0] != 0 && printed[1] == 0) {
    return std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(printed[0]))));
  }
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return std::string(1, static_cast<char>('A' + key - GLFW_KEY_A));
  return {};
}

// KHR_debug, in core since OpenGL 4.3; without it there are no checks, which is said.
void report_errors(base::Log& log) {
  const auto set_callback =
      reinterpret_cast<PFNGLDEBUGMESSAGECALLBACKPROC>(glfwGetProcAddress("glDebugMessageCallback"));
  const auto enable = reinterpret_cast<PFNGLENABLEPROC>(glfwGetProcAddress("glEnable"));
  if (set_callback == nullptr || enable == nullptr) {
    log.warning("this graphics driver cannot check calls");
    return;
  }
  enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  set_callback(
      [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text, const void* user) {
        if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
        static_cast<base::Log*>(const_cast<void*>(user))->error("OpenGL: %s", text);
      },
      &log);
}

Heard& heard_of(GLFWwindow* window) { return *static_cast<Heard*>(glfwGetWindowUserPointer(window)); }

std::vector<Input>& inputs_of(GLFWwindow* window) { return heard_of(window).inputs; }

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

// The connection stays until the process ends: drivers do not unload cleanly, and after the server's death every call
// would wait for it or end the process. Opening again finds it as it is.
Display::~Display() = default;

bool Display::lost() const { return server_gone(); }

void Display::poll() { glfwPollEvents(); }

std::vector<Area> Display::work_areas() const {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  std::vector<Area> areas;
  for (int i = 0; i < count; ++i) {
    Area area;
    glfwGetMonitorWorkarea(monitors[i], &area.left, &area.top, &area.width, &area.height);
    areas.push_back(area);
  }
  if (areas.empty()) areas.push_back({0, 0, 1280, 1024});
  return areas;
}

std::unique_ptr<GlfwWindow> GlfwWindow::create(Display& display, const std::string& title, int width, int height,
                                               const GlfwWindow* share, base::Log* checks, std::string& why) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, checks != nullptr ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // pictures are drawn elsewhere (canvas.h)
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // full screen on one monitor, while another window is used
  std::unique_ptr<GlfwWindow> window(new GlfwWindow(display));
  window->window_ =
      glfwCreateWindow(width, height, title.c_str(), nullptr, share != nullptr ? share->window_ : nullptr);
  if (window->window_ == nullptr) {
    why = "no window with OpenGL 3.3 (" + last_complaint() + ")";
    return nullptr;
  }
  window->make_current();
  window->checks_ = checks;
  if (checks != nullptr) report_errors(*checks);
  return window;
}

std::unique_ptr<GlfwWindow> GlfwWindow::open_hidden(Display& display, base::Log* checks, std::string& why) {
  return create(display, "AMBF", 16, 16, nullptr, checks, why);
}

std::unique_ptr<GlfwWindow> GlfwWindow::open(Display& display, const std::string& title, const Area& place,
                                             const GlfwWindow& share, std::string& why) {
  auto window = create(display, title, place.width, place.height, &share, share.checks_, why);
  if (window == nullptr) return nullptr;
  glfwSetWindowPos(window->window_, place.left, place.top);
  window->listen();
  glfwShowWindow(window->window_);
  return window;
}

void GlfwWindow::make_current() { glfwMakeContextCurrent(window_); }

GlfwWindow::~GlfwWindow() {
  if (window_ != nullptr && !display_.lost()) glfwDestroyWindow(window_);
}

void GlfwWindow::listen() {
  glfwSetWindowUserPointer(window_, &heard_);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int mods) {
    std::string name = name_of_key(key, scancode);
    if (name.empty()) return;
    inputs_of(window).emplace_back(
        KeyInput{std::move(name), modifiers_of(mods), action == GLFW_REPEAT, action == GLFW_RELEASE});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
    inputs_of(window).emplace_back(TextInput{static_cast<char32_t>(character)});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    ButtonInput input;
    input.button = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::left
                   : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::right
                                                       : MouseButton::middle;
    input.pressed = action == GLFW_PRESS;
    input.modifiers = modifiers_of(mods);
    // Where the pointer was then: GLFW is asked for where it is now, which between two slow pictures is far away.
    const Heard& heard = heard_of(window);
    input.x = heard.pointer.x;
    input.y = heard.pointer.y;
    if (!heard.pointed) glfwGetCursorPos(window, &input.x, &input.y);
    inputs_of(window).emplace_back(input);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    Heard& heard = heard_of(window);
    heard.pointer = MotionInput{x, y, left_shift(window)};
    heard.pointed = true;
    heard.inputs.emplace_back(heard.pointer);
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double notches) {
    inputs_of(window).emplace_back(WheelInput{notches, left_shift(window)});
  });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int focused) {
    inputs_of(window).emplace_back(FocusInput{focused == GLFW_TRUE});
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    inputs_of(window).emplace_back(DropInput{std::vector<std::string>(paths, paths + count)});
  });
}

std::vector<Input> GlfwWindow::take_inputs() { return std::exchange(heard_.inputs, {}); }

bool GlfwWindow::close_asked() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

bool GlfwWindow::hidden() const { return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE; }

void GlfwWindow::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

unsigned GlfwWindow::monitor() const {
  int count = 0, x = 0, y = 0, width = 0, height = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  glfwGetWindowPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  for (int i = 0; i < count; ++i) {
    int left = 0, top = 0;
    glfwGetMonitorPos(monitors[i], &left, &top);
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    if (mode == nullptr) continue;
    const int middle_x = x + width / 2 - left, middle_y = y + height / 2 - top;
    if (middle_x >= 0 && middle_y >= 0 && middle_x < mode->width && middle_y < mode->height)
      return static_cast<unsigned>(i);
  }
  return 0;
}

void GlfwWindow::fill_monitor(unsigned part, unsigned parts) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  const unsigned index = monitor();
  if (full_screen_ || index >= static_cast<unsigned>(count)) return;
  Area screen;
  glfwGetMonitorPos(monitors[index], &screen.left, &screen.top);
  const GLFWvidmode* mode = glfwGetVideoMode(monitors[index]);
  if (mode == nullptr) return;
  screen.width = mode->width;
  screen.height = mode->height;
  full_screen_ = true;
  glfwGetWindowPos(window_, &before_.left, &before_.top);
  glfwGetWindowSize(window_, &before_.width, &before_.height);
  if (parts <= 1) {
    glfwSetWindowMonitor(window_, monitors[index], 0, 0, mode->width, mode->height, mode->refreshRate);
    return;
  }
  const Area mine = tile(part, parts, screen);
  glfwSetWindowAttrib(window_, GLFW_DECORATED, GLFW_FALSE);
  glfwSetWindowPos(window_, mine.left, mine.top);
  glfwSetWindowSize(window_, mine.width, mine.height);
}

void GlfwWindow::leave_full_screen() {
  if (!full_screen_) return;
  full_screen_ = false;
  glfwSetWindowAttrib(window_, GLFW_DECORATED, GLFW_TRUE);
  glfwSetWindowMonitor(window_, nullptr, before_.left, before_.top, before_.width, before_.height, GLFW_DONT_CARE);
}

void GlfwWindow::show_picture() { glfwSwapBuffers(window_); }

void GlfwWindow::wait_for_display(bool wait) { glfwSwapInterval(wait ? 1 : 0); }

GlfwWindow::Size GlfwWindow::size() const {
  Size size;
  glfwGetWindowSize(window_, &size.width, &size.height);
  return server_gone() ? Size() : size;  // a server that dies while it is asked leaves anything in them
}

GlfwWindow::Size GlfwWindow::picture() const {
  Size size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return server_gone() ? Size() : size;
}

double GlfwWindow::scale() const {
  float x = 1.0F, y = 1.0F;
  glfwGetWindowContentScale(window_, &x, &y);
  return server_gone() || !(x > 0.0F) ? 1.0 : static_cast<double>(x);
}

void GlfwWindow::set_clipboard(const std::string& text) { glfwSetClipboardString(window_, text.c_str()); }
std::string GlfwWindow::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text == nullptr ? std::string() : std::string(text);
}

void* GlfwWindow::address_of(const char* function) { return reinterpret_cast<void*>(glfwGetProcAddress(function)); }

}  // namespace ambf::render
