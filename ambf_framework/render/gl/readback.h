// Brings what was drawn from the graphics card into memory. A card goes on drawing meanwhile: several pictures are
// started one after the other and finished afterwards. Where the processor draws there is nothing to overlap, and
// pixels are copied at once. One a picture under way. The context's thread. Private to render/.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/gl/handle.h"

namespace ambf::render {

class Readback {
 public:
  Readback(const Gl& gl, bool asynchronous) : gl_(gl), asynchronous_(asynchronous) {}
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  // Of the framebuffer bound for reading.
  void start(int width, int height, GLenum format, GLenum type, std::size_t bytes_a_pixel);
  // Waits for the pixels and calls take(y, row) for each row, y counting from the top. False when the card did not
  // answer.
  bool finish(const std::function<void(int y, const void* row)>& take);

 private:
  void drop_fence();

  const Gl& gl_;
  const bool asynchronous_;
  int height_ = 0;
  std::size_t row_bytes_ = 0;
  std::vector<std::uint8_t> pixels_;
  GlBuffer buffer_;
  std::size_t buffer_bytes_ = 0;
  GLsync fence_ = nullptr;
};

}  // namespace ambf::render
