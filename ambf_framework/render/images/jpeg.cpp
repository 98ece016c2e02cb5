#include "render/images/jpeg.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

namespace ambf::render {

namespace {

// libjpeg reports errors by a call that must not return.
struct Errors {
  jpeg_error_mgr manager;
  std::jmp_buf back;
};

void leave(j_common_ptr info) { std::longjmp(reinterpret_cast<Errors*>(info->err)->back, 1); }

// Nothing in here has a destructor that longjmp would skip.
bool compress(jpeg_compress_struct& info, Errors& errors, const std::uint8_t* rgb, int width, int height,
              unsigned char*& bytes, unsigned long& count) {
  if (setjmp(errors.back) != 0) return false;
  jpeg_mem_dest(&info, &bytes, &count);
  info.image_width = static_cast<JDIMENSION>(width);
  info.image_height = static_cast<JDIMENSION>(height);
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, kJpegQuality, TRUE);
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    // libjpeg does not write to rows it compresses.
    JSAMPROW row = const_cast<JSAMPROW>(rgb + std::size_t{3} * info.image_width * info.next_scanline);
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_jpeg(const std::vector<std::uint8_t>& rgb, int width, int height) {
  if (width <= 0 || height <= 0) return {};
  if (rgb.size() != std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) return {};
  jpeg_compress_struct info{};
  Errors errors{};
  info.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = leave;
  errors.manager.output_message = [](j_common_ptr) {};
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long count = 0;
  std::vector<std::uint8_t> out;
  if (compress(info, errors, rgb.data(), width, height, bytes, count)) out.assign(bytes, bytes + count);
  jpeg_destroy_compress(&info);
  std::free(bytes);
  return out;
}

}  // namespace ambf::render
