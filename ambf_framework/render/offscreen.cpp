#include "render/offscreen.h"

#include <dlfcn.h>

#include <array>

#include "render/painter.h"

namespace ambf::render {

namespace {

constexpr const char* kLibrary = "libOSMesa.so.8";

// From <GL/osmesa.h>, which cannot be included beside <GL/glcorearb.h>.
using OSMesaContext = void*;
using CreateContext = OSMesaContext (*)(const int* attributes, OSMesaContext share);
using MakeCurrent = unsigned char (*)(OSMesaContext context, void* pixels, unsigned type, int width, int height);
using DestroyContext = void (*)(OSMesaContext context);
using GetProcAddress = void (*(*)(const char* name))();
constexpr int kFormat = 0x22, kRgba = 0x1908, kProfile = 0x33, kCoreProfile = 0x34, kMajor = 0x36, kMinor = 0x37;

}  // namespace

struct Offscreen::Impl {
  void* library = nullptr;  // never unloaded: Mesa leaves memory and threads behind
  OSMesaContext context = nullptr;
  MakeCurrent make_current = nullptr;
  DestroyContext destroy = nullptr;
  std::array<unsigned char, 4> pixel{};  // a context needs a buffer of its own; we draw into a canvas instead
  Gl gl;
  std::unique_ptr<SharedStore> shared;
  std::unique_ptr<Painter> painter;

  ~Impl() {
    if (context == nullptr) return;
    make_current(context, pixel.data(), GL_UNSIGNED_BYTE, 1, 1);
    painter.reset();
    shared.reset();
    destroy(context);
  }
  template <class T>
  bool find(T& function, const char* name) {
    function = reinterpret_cast<T>(dlsym(library, name));
    return function != nullptr;
  }
};

Offscreen::Offscreen(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Offscreen::~Offscreen() = default;

std::unique_ptr<Offscreen> Offscreen::open(std::string& why) {
  auto impl = std::make_unique<Impl>();
  impl->library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (impl->library == nullptr) {
    why = std::string(kLibrary) + " is not installed (Debian: libosmesa6)";
    return nullptr;
  }
  CreateContext create = nullptr;
  GetProcAddress address_of = nullptr;
  if (!impl->find(create, "OSMesaCreateContextAttribs") || !impl->find(address_of, "OSMesaGetProcAddress") ||
      !impl->find(impl->make_current, "OSMesaMakeCurrent") || !impl->find(impl->destroy, "OSMesaDestroyContext")) {
    why = std::string(kLibrary) + " is too old";
    return nullptr;
  }
  const int attributes[] = {kFormat, kRgba, kProfile, kCoreProfile, kMajor, 3, kMinor, 3, 0};
  impl->context = create(attributes, nullptr);
  if (impl->context == nullptr ||
      impl->make_current(impl->context, impl->pixel.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
    why = std::string(kLibrary) + " offers no OpenGL 3.3";
    return nullptr;
  }
  std::string missing;
  if (!impl->gl.load([&](const char* name) { return reinterpret_cast<void*>(address_of(name)); }, missing)) {
    why = std::string(kLibrary) + " lacks " + missing;
    return nullptr;
  }
  impl->shared = std::make_unique<SharedStore>(impl->gl);
  impl->painter = std::make_unique<Painter>(impl->gl, *impl->shared);
  if (!impl->shared->build(why) || !impl->painter->build(why)) return nullptr;
  return std::unique_ptr<Offscreen>(new Offscreen(std::move(impl)));
}

Camera Offscreen::camera_of(const state::Frame& frame, std::size_t slot) {
  const state::CameraInfo& info = frame.structure->cameras.at(slot);
  return {frame.cameras.at(slot).T_world_camera, info.near_plane_m, info.far_plane_m, info.field_of_view_rad,
          info.orthographic_width_m};
}

bool Offscreen::picture(const state::Frame& frame, const Camera& camera, int width, int height, Image& image,
                        base::Diagnostics& diagnostics, std::string& why, const Quality& quality) {
  Impl& impl = *impl_;
  impl.make_current(impl.context, impl.pixel.data(), GL_UNSIGNED_BYTE, 1, 1);
  for (base::Diagnostic& finding : impl.shared->take(*frame.structure)) diagnostics.push_back(std::move(finding));
  Motion now;
  now.take(frame);
  PaintJob job;
  job.structure = frame.structure.get();
  job.poses = &now.at(frame.steady_ns);
  job.camera = camera;
  job.width = width;
  job.height = height;
  job.quality = quality;
  if (!impl.painter->paint(job, why)) return false;
  image = impl.painter->canvas().read();
  return true;
}

Offscreen::Counts Offscreen::counts() {
  Impl& impl = *impl_;
  impl.make_current(impl.context, impl.pixel.data(), GL_UNSIGNED_BYTE, 1, 1);
  Counts counts{impl.shared->gpu().mesh_count(), impl.shared->gpu().texture_count(),
                impl.shared->scene().batches.size(), impl.painter->instances_drawn(), 0};
  while (impl.gl.GetError() != GL_NO_ERROR) ++counts.gl_errors;
  return counts;
}

}  // namespace ambf::render
