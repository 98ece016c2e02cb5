// EGL without a display server: every graphics card is a device of its own, and Mesa's software renderer may be one,
// too.
#include <dlfcn.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "render/gl/detail/functions.h"
#include "render/gl/detail/library.h"
#include "render/gl/offscreen_context.h"

namespace ambf::render {

namespace {

constexpr const char* kLibrary = "libEGL.so.1";

// From <EGL/egl.h> and <EGL/eglext.h>: so little that building needs no package for it.
using Handle = void*;  // of displays, contexts, devices, configurations
using Int = std::int32_t;
using Boolean = unsigned;
constexpr unsigned kPlatformDevice = 0x313F, kPlatformSurfaceless = 0x31DD, kOpenGlApi = 0x30A2;
constexpr Int kNone = 0x3038, kExtensions = 0x3055, kSurfaceType = 0x3033, kRenderableType = 0x3040,
              kOpenGlBit = 0x0008;
constexpr Int kMajor = 0x3098, kMinor = 0x30FB, kProfileMask = 0x30FD, kCoreProfile = 0x1;

// Extensions are words in a string.
bool lists(const char* extensions, std::string_view wanted) {
  std::string_view rest = extensions == nullptr ? "" : extensions;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == wanted) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

struct Egl {
  void* library = nullptr;
  void* (*address)(const char*) = nullptr;
  const char* (*query_string)(Handle, Int) = nullptr;
  Boolean (*initialize)(Handle, Int*, Int*) = nullptr;
  Boolean (*bind_api)(unsigned) = nullptr;
  Boolean (*choose_config)(Handle, const Int*, Handle*, Int, Int*) = nullptr;
  Handle (*create_context)(Handle, Handle, Handle, const Int*) = nullptr;
  Boolean (*destroy_context)(Handle, Handle) = nullptr;
  Boolean (*make_current)(Handle, Handle, Handle, Handle) = nullptr;
  Handle (*get_platform_display)(unsigned, void*, const Int*) = nullptr;
  Boolean (*query_devices)(Int, Handle*, Int*) = nullptr;     // may be null
  const char* (*query_device_string)(Handle, Int) = nullptr;  // may be null

  bool load(std::string& why) {
    library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (library == nullptr) {
      why = library_problem(kLibrary, "libegl1");
      return false;
    }
    address = reinterpret_cast<void* (*)(const char*)>(dlsym(library, "eglGetProcAddress"));
    const auto symbol = [this](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      return function != nullptr;
    };
    const auto extension = [this](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(address(name));
      return function != nullptr;
    };
    if (address == nullptr || !symbol(query_string, "eglQueryString") || !symbol(initialize, "eglInitialize") ||
        !symbol(bind_api, "eglBindAPI") || !symbol(choose_config, "eglChooseConfig") ||
        !symbol(create_context, "eglCreateContext") || !symbol(destroy_context, "eglDestroyContext") ||
        !symbol(make_current, "eglMakeCurrent") || !extension(get_platform_display, "eglGetPlatformDisplayEXT")) {
      why = std::string(kLibrary) + " is too old";
      return false;
    }
    extension(query_devices, "eglQueryDevicesEXT");
    extension(query_device_string, "eglQueryDeviceStringEXT");
    return true;
  }

  // What the library itself can do, before any display. Its functions are not proof: a dispatching library hands out
  // addresses of functions that no driver behind it has.
  bool offers(std::string_view extension) const { return lists(query_string(nullptr, kExtensions), extension); }

  // Cards only: a device that is the processor says so. One card may be several devices, one for each driver that
  // claims it.
  std::vector<Handle> cards() const {
    const bool devices_offered =
        offers("EGL_EXT_platform_device") &&
        (offers("EGL_EXT_device_base") || (offers("EGL_EXT_device_enumeration") && offers("EGL_EXT_device_query")));
    Int count = 0;
    if (!devices_offered || query_devices == nullptr || query_device_string == nullptr ||
        query_devices(0, nullptr, &count) == 0 || count <= 0) {
      return {};
    }
    std::vector<Handle> cards(static_cast<std::size_t>(count));
    if (query_devices(count, cards.data(), &count) == 0) return {};
    cards.resize(static_cast<std::size_t>(count));
    std::erase_if(cards, [this](Handle device) {
      return lists(query_device_string(device, kExtensions), "EGL_MESA_device_software");
    });
    return cards;
  }
};

class EglContext final : public OffscreenContext {
 public:
  explicit EglContext(const Egl& egl) : egl_(egl) {}
  // The display stays: EGL gives every caller the same one.
  ~EglContext() override {
    if (context_ == nullptr) return;
    egl_.make_current(display_, nullptr, nullptr, nullptr);
    egl_.destroy_context(display_, context_);
  }

  bool open(unsigned platform, void* device) {
    display_ = egl_.get_platform_display(platform, device, nullptr);
    Int major = 0, minor = 0, configs = 0;
    if (display_ == nullptr || egl_.initialize(display_, &major, &minor) == 0 || egl_.bind_api(kOpenGlApi) == 0) {
      return false;
    }
    const Int config_wishes[] = {kSurfaceType, 0, kRenderableType, kOpenGlBit, kNone};
    const Int context_wishes[] = {kMajor, 3, kMinor, 3, kProfileMask, kCoreProfile, kNone};
    Handle config = nullptr;
    if (egl_.choose_config(display_, config_wishes, &config, 1, &configs) == 0 || configs == 0) return false;
    context_ = egl_.create_context(display_, config, nullptr, context_wishes);
    return context_ != nullptr && make_current();
  }

  bool make_current() override { return egl_.make_current(display_, nullptr, nullptr, context_) != 0; }
  void* address_of(const char* function) override { return egl_.address(function); }

  bool in_software() {
    Gl gl;
    std::string missing;
    return !gl.load([this](const char* name) { return address_of(name); }, missing) || draws_in_software(gl);
  }

 private:
  const Egl egl_;
  Handle display_ = nullptr, context_ = nullptr;
};

}  // namespace

EglAnswer open_egl(bool software) {
  Egl egl;
  EglAnswer answer;
  if (!egl.load(answer.why)) return answer;
  const std::vector<Handle> cards = egl.cards();
  for (const Handle card : cards) {
    auto context = std::make_unique<EglContext>(egl);
    if (context->open(kPlatformDevice, card) && !context->in_software()) {
      answer.context = std::move(context);
      return answer;
    }
  }
  answer.card_fails = !cards.empty();
  answer.why = answer.card_fails
                   ? "EGL finds a graphics card but gets no OpenGL 3.3 of it (may this user open its files below /dev?)"
                   : "EGL finds no graphics card";
  if (!software) return answer;
  auto context = std::make_unique<EglContext>(egl);
  if (egl.offers("EGL_MESA_platform_surfaceless") && context->open(kPlatformSurfaceless, nullptr)) {
    answer.context = std::move(context);
  } else {
    answer.why += ", nor a renderer of Mesa's";
  }
  return answer;
}

}  // namespace ambf::render
