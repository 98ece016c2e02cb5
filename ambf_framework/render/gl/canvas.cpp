#include "render/gl/canvas.h"

#include <algorithm>
#include <cstring>

namespace ambf::render {

bool Canvas::attach(GlFramebuffer& framebuffer, GlRenderbuffer& color, GlRenderbuffer* depth, int samples,
                    std::string& why) {
  framebuffer = GlFramebuffer(gl_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  color = GlRenderbuffer(gl_);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, color.name());
  gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width_, height_);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color.name());
  if (depth != nullptr) {
    *depth = GlRenderbuffer(gl_);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, depth->name());
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width_, height_);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth->name());
  }
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return true;
  why = "a picture of " + std::to_string(width_) + " x " + std::to_string(height_) + " cannot be drawn";
  return false;
}

bool Canvas::resize(int width, int height, int samples, std::string& why) {
  if (width == width_ && height == height_ && samples == wanted_samples_) return true;
  width_ = width;
  height_ = height;
  wanted_samples_ = samples;
  GLint most = 0;
  gl_.GetIntegerv(GL_MAX_SAMPLES, &most);
  samples_ = samples > 1 ? std::min(samples, most) : 0;
  depth_texture_ = GlTexture();
  return attach(framebuffer_, color_, &depth_, samples_, why) &&
         attach(single_framebuffer_, single_color_, nullptr, 0, why);
}

void Canvas::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl_.Viewport(0, 0, width_, height_);
}

void Canvas::resolve_to(GLuint target, const Place& place) const {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  const bool same = place.width == width_ && place.height == height_;
  gl_.BlitFramebuffer(0, 0, width_, height_, place.left, place.bottom, place.left + place.width,
                      place.bottom + place.height, GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
}

void Canvas::resolve_mirrored_to(GLuint target, const Place& place) {
  show_to_read();  // a picture with several samples a pixel may not be turned while it is resolved
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  const bool same = place.width == width_ && place.height == height_;
  gl_.BlitFramebuffer(0, 0, width_, height_, place.left, place.bottom + place.height, place.left + place.width,
                      place.bottom, GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
}

void Canvas::show_to_read() {
  resolve_to(single_framebuffer_.name(), {0, 0, width_, height_});
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, single_framebuffer_.name());
}

GLuint Canvas::depth_texture() {
  if (!depth_texture_) {
    depth_texture_ = GlTexture(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, depth_texture_.name());
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, width_, height_, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                   nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
      gl_.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    }
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
      gl_.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    }
    depth_framebuffer_ = GlFramebuffer(gl_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, depth_framebuffer_.name());
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_texture_.name(), 0);
    gl_.DrawBuffer(GL_NONE);
    gl_.ReadBuffer(GL_NONE);
  }
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, depth_framebuffer_.name());
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  bind();
  return depth_texture_.name();
}

Image Canvas::read() {
  Image image{width_, height_, {}};
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(width_);
  std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height_));
  show_to_read();
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.data());
  image.rgba.resize(upside_down.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height_); ++y) {
    const std::size_t from = (static_cast<std::size_t>(height_) - 1 - y) * row;
    std::copy_n(upside_down.begin() + static_cast<std::ptrdiff_t>(from), row,
                image.rgba.begin() + static_cast<std::ptrdiff_t>(y * row));
  }
  return image;
}

}  // namespace ambf::render
