// Owners of OpenGL names: freed with their owner, which must not outlive the context or the table. Main thread.
// Private to render/.
#pragma once

#include <utility>

#include "render/gl/detail/functions.h"

namespace ambf::render {

enum class GlKind { buffer, texture, sampler, vertex_array, framebuffer, renderbuffer };

template <GlKind kKind>
class GlHandle {
 public:
  GlHandle() = default;
  explicit GlHandle(const Gl& gl) : gl_(&gl) {
    if constexpr (kKind == GlKind::buffer) gl.GenBuffers(1, &name_);
    if constexpr (kKind == GlKind::texture) gl.GenTextures(1, &name_);
    if constexpr (kKind == GlKind::sampler) gl.GenSamplers(1, &name_);
    if constexpr (kKind == GlKind::vertex_array) gl.GenVertexArrays(1, &name_);
    if constexpr (kKind == GlKind::framebuffer) gl.GenFramebuffers(1, &name_);
    if constexpr (kKind == GlKind::renderbuffer) gl.GenRenderbuffers(1, &name_);
  }
  ~GlHandle() { reset(); }
  GlHandle(GlHandle&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  GlHandle& operator=(GlHandle&& other) noexcept {
    if (this != &other) {
      reset();
      gl_ = other.gl_;
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GlHandle(const GlHandle&) = delete;
  GlHandle& operator=(const GlHandle&) = delete;

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  void reset() {
    if (name_ == 0) return;
    if constexpr (kKind == GlKind::buffer) gl_->DeleteBuffers(1, &name_);
    if constexpr (kKind == GlKind::texture) gl_->DeleteTextures(1, &name_);
    if constexpr (kKind == GlKind::sampler) gl_->DeleteSamplers(1, &name_);
    if constexpr (kKind == GlKind::vertex_array) gl_->DeleteVertexArrays(1, &name_);
    if constexpr (kKind == GlKind::framebuffer) gl_->DeleteFramebuffers(1, &name_);
    if constexpr (kKind == GlKind::renderbuffer) gl_->DeleteRenderbuffers(1, &name_);
    name_ = 0;
  }

  const Gl* gl_ = nullptr;
  GLuint name_ = 0;
};

using GlBuffer = GlHandle<GlKind::buffer>;
using GlTexture = GlHandle<GlKind::texture>;
using GlSampler = GlHandle<GlKind::sampler>;
using GlVertexArray = GlHandle<GlKind::vertex_array>;
using GlFramebuffer = GlHandle<GlKind::framebuffer>;
using GlRenderbuffer = GlHandle<GlKind::renderbuffer>;

}  // namespace ambf::render
