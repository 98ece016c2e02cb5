// EGL without a display server: every graphics card is a device of its own, and Mesa's software renderer may be one, too.
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "render/gl/functions.h"
#include "render/offscreen_context.h"

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
constexpr Int kMostDevices = 16;

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
      why = std::string(kLibrary) + " is not installed (Debian: libegl1)";
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

  // Cards only: a device that is the processor says so.
  std::vector<Handle> cards() const {
    std::array<Handle, kMostDevices> devices{};
    Int count = 0;
    if (query_devices == nullptr || query_device_string == nullptr ||
        query_devices(kMostDevices, devices.data(), &count) == 0) {
      return {};
    }
    std::vector<Handle> cards;
    for (Int i = 0; i < count; ++i) {
      const char* extensions = query_device_string(devices[static_cast<std::size_t>(i)], kExtensions);
      if (extensions == nullptr || std::string_view(extensions).find("_software") != std::string_view::npos) continue;
      cards.push_back(devices[static_cast<std::size_t>(i)]);
    }
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

std::unique_ptr<OffscreenContext> open_egl(bool software, std::string& why) {
  Egl egl;
  if (!egl.load(why)) return nullptr;
  for (const Handle card : egl.cards()) {
    auto context = std::make_unique<EglContext>(egl);
    if (context->open(kPlatformDevice, card) && !context->in_software()) return context;
  }
  if (software) {
    auto context = std::make_unique<EglContext>(egl);
    if (context->open(kPlatformSurfaceless, nullptr)) return context;
  }
  why = software ? "EGL offers no OpenGL 3.3 without a display" : "EGL offers no graphics card";
  return nullptr;
}

}  // namespace ambf::render
