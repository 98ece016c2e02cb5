// OSMesa: Mesa's software renderer as a library without any window system.
#include <dlfcn.h>

#include <array>

#include "render/gl/detail/library.h"
#include "render/gl/offscreen_context.h"

namespace ambf::render {

namespace {

constexpr const char* kLibrary = "libOSMesa.so.8";

// From <GL/osmesa.h>, which cannot be included beside <GL/glcorearb.h>.
using ContextHandle = void*;
using CreateContext = ContextHandle (*)(const int* attributes, ContextHandle share);
using MakeCurrent = unsigned char (*)(ContextHandle context, void* pixels, unsigned type, int width, int height);
using DestroyContext = void (*)(ContextHandle context);
using GetProcAddress = void (*(*)(const char* name))();
constexpr int kFormat = 0x22, kRgba = 0x1908, kProfile = 0x33, kCoreProfile = 0x34, kMajor = 0x36, kMinor = 0x37;
constexpr unsigned kUnsignedByte = 0x1401;

class OsmesaContext final : public OffscreenContext {
 public:
  ~OsmesaContext() override {
    if (context_ != nullptr) destroy_(context_);
  }

  bool open(std::string& why) {
    // Never unloaded: Mesa leaves memory and threads behind.
    library_ = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (library_ == nullptr) {
      why = library_problem(kLibrary, "libosmesa6");
      return false;
    }
    CreateContext create = nullptr;
    if (!find(create, "OSMesaCreateContextAttribs") || !find(address_, "OSMesaGetProcAddress") ||
        !find(make_current_, "OSMesaMakeCurrent") || !find(destroy_, "OSMesaDestroyContext")) {
      why = std::string(kLibrary) + " is too old";
      return false;
    }
    const int attributes[] = {kFormat, kRgba, kProfile, kCoreProfile, kMajor, 3, kMinor, 3, 0};
    context_ = create(attributes, nullptr);
    if (context_ != nullptr && make_current()) return true;
    why = std::string(kLibrary) + " offers no OpenGL 3.3";
    return false;
  }

  bool make_current() override { return make_current_(context_, pixel_.data(), kUnsignedByte, 1, 1) != 0; }
  void* address_of(const char* function) override { return reinterpret_cast<void*>(address_(function)); }

 private:
  template <class T>
  bool find(T& function, const char* name) {
    function = reinterpret_cast<T>(dlsym(library_, name));
    return function != nullptr;
  }

  void* library_ = nullptr;
  ContextHandle context_ = nullptr;
  MakeCurrent make_current_ = nullptr;
  DestroyContext destroy_ = nullptr;
  GetProcAddress address_ = nullptr;
  std::array<unsigned char, 4> pixel_{};  // a context needs a buffer of its own; we draw into a canvas instead
};

}  // namespace

std::unique_ptr<OffscreenContext> open_osmesa(std::string& why) {
  auto context = std::make_unique<OsmesaContext>();
  if (!context->open(why)) return nullptr;
  return context;
}

}  // namespace ambf::render
