#include "render/gl/full_screen.h"

namespace ambf::render {

FullScreenTriangle::FullScreenTriangle(const Gl& gl) : gl_(gl), vertex_array_(gl), corners_(gl) {
  const float corners[] = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
  gl_.BindVertexArray(vertex_array_.name());
  gl_.BindBuffer(GL_ARRAY_BUFFER, corners_.name());
  gl_.BufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
  gl_.EnableVertexAttribArray(0);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 3 * sizeof(float), nullptr);
  gl_.BindVertexArray(0);
}

void FullScreenTriangle::draw() const {
  gl_.BindVertexArray(vertex_array_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.BindVertexArray(0);
}

void Layer::resize(int width, int height, bool with_depth) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  framebuffer_ = GlFramebuffer(gl_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  const auto attach = [&](GlTexture& texture, GLenum point, GLint inner, GLenum format, GLenum type) {
    texture = GlTexture(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, texture.name());
    gl_.TexImage2D(GL_TEXTURE_2D, 0, inner, width, height, 0, format, type, nullptr);
    const GLint filter = point == GL_COLOR_ATTACHMENT0 ? GL_LINEAR : GL_NEAREST;
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture.name(), 0);
  };
  attach(color_, GL_COLOR_ATTACHMENT0, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
  if (with_depth) attach(depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT);
}

void Layer::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl_.Viewport(0, 0, width_, height_);
}

}  // namespace ambf::render
