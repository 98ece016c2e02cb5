#include "render/gl/detail/functions.h"

#include <cstring>
#include <string_view>

namespace ambf::render {

bool Gl::load(const std::function<void*(const char*)>& address_of, std::string& missing) {
  const auto find = [&](auto& function, const char* name) {
    void* address = address_of(name);
    static_assert(sizeof address == sizeof function);
    std::memcpy(&function, &address, sizeof address);  // a data pointer cast to a function pointer, as POSIX allows
    if (address == nullptr) missing = name;
    return address != nullptr;
  };
#define AMBF_GL_LOAD(member, name) \
  if (!find(member, "gl" #member)) return false;
  AMBF_GL_FUNCTIONS(AMBF_GL_LOAD)
#undef AMBF_GL_LOAD
  return true;
}

bool draws_in_software(const Gl& gl) {
  const auto* renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
  const std::string_view name = renderer == nullptr ? "" : renderer;
  for (const char* software : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"}) {
    if (name.find(software) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace ambf::render
