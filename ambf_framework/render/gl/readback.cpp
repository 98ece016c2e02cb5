#include "render/gl/readback.h"

namespace ambf::render {

namespace {

constexpr GLuint64 kLongestWait_ns = 2'000'000'000;  // a card that takes longer is lost

}  // namespace

Readback::~Readback() { drop_fence(); }

void Readback::drop_fence() {
  if (fence_ != nullptr) gl_.DeleteSync(fence_);
  fence_ = nullptr;
}

void Readback::start(int width, int height, GLenum format, GLenum type, std::size_t bytes_a_pixel) {
  height_ = height;
  row_bytes_ = static_cast<std::size_t>(width) * bytes_a_pixel;
  const std::size_t bytes = row_bytes_ * static_cast<std::size_t>(height);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  if (!asynchronous_) {
    pixels_.resize(bytes);
    gl_.ReadPixels(0, 0, width, height, format, type, pixels_.data());
    return;
  }
  if (!buffer_) buffer_ = GlBuffer(gl_);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.name());
  if (bytes != buffer_bytes_) {
    gl_.BufferData(GL_PIXEL_PACK_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
    buffer_bytes_ = bytes;
  }
  gl_.ReadPixels(0, 0, width, height, format, type, nullptr);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  drop_fence();
  fence_ = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

bool Readback::finish(const std::function<void(int y, const void* row)>& take) {
  const std::uint8_t* pixels = pixels_.data();
  if (asynchronous_) {
    if (fence_ == nullptr) return false;
    const GLenum answer = gl_.ClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, kLongestWait_ns);
    drop_fence();
    if (answer != GL_ALREADY_SIGNALED && answer != GL_CONDITION_SATISFIED) return false;
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.name());
    pixels = static_cast<const std::uint8_t*>(
        gl_.MapBufferRange(GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(buffer_bytes_), GL_MAP_READ_BIT));
  }
  const bool there = pixels != nullptr;
  // OpenGL's rows go from bottom to top.
  for (int y = 0; there && y < height_; ++y) {
    take(y, pixels + static_cast<std::size_t>(height_ - 1 - y) * row_bytes_);
  }
  if (asynchronous_) {
    if (there) gl_.UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  }
  return there;
}

}  // namespace ambf::render
