#include "render/images/image_file.h"

#include <jpeglib.h>
#include <png.h>

#include <cctype>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>

#include "render/images/jpeg.h"

namespace ambf::render {

namespace {

constexpr const char* kTooLarge = "larger than 8192 pixels on a side";

// libjpeg reports errors by a call that must not return.
struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX];
};

void leave(j_common_ptr info) {
  auto* errors = reinterpret_cast<JpegErrors*>(info->err);
  info->err->format_message(info, errors->message);
  std::longjmp(errors->back, 1);
}

// Nothing in here has a destructor that longjmp would skip: `rgba` and `row` belong to the caller.
bool decode_jpeg(jpeg_decompress_struct& info, JpegErrors& errors, const std::string& bytes, Image& image,
                 std::vector<std::uint8_t>& row) {
  if (setjmp(errors.back) != 0) return false;
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&info, TRUE);
  if (info.image_width > kMaxImageSide || info.image_height > kMaxImageSide) {
    std::strcpy(errors.message, kTooLarge);
    return false;
  }
  info.out_color_space = info.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_start_decompress(&info);
  const int channels = info.output_components;
  image.width = static_cast<int>(info.output_width);
  image.height = static_cast<int>(info.output_height);
  image.rgba.resize(std::size_t{4} * info.output_width * info.output_height);
  row.resize(std::size_t(channels) * info.output_width);
  std::uint8_t* out = image.rgba.data();
  while (info.output_scanline < info.output_height) {
    JSAMPROW rows[1] = {row.data()};
    jpeg_read_scanlines(&info, rows, 1);
    const std::uint8_t* in = row.data();
    for (JDIMENSION x = 0; x < info.output_width; ++x, in += channels, out += 4) {
      out[0] = in[0];
      out[1] = in[channels == 1 ? 0 : 1];
      out[2] = in[channels == 1 ? 0 : 2];
      out[3] = 255;
    }
  }
  return true;
}

bool read_jpeg(const std::string& bytes, Image& image, std::string& why) {
  jpeg_decompress_struct info{};
  JpegErrors errors{};
  info.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = leave;
  errors.manager.output_message = [](j_common_ptr) {};
  jpeg_create_decompress(&info);
  std::vector<std::uint8_t> row;
  const bool good = decode_jpeg(info, errors, bytes, image, row);
  if (!good) why = errors.message;
  jpeg_destroy_decompress(&info);
  return good;
}

std::string ending_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  std::string ending = dot == std::string::npos ? "" : path.substr(dot);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

bool read_bytes(const std::string& path, std::string& bytes, std::string& why) {
  constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
  const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) {
    why = std::strerror(errno);
    return false;
  }
  char buffer[1 << 16];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file.get())) {
    bytes.append(buffer, count);
    if (bytes.size() > kMaxBytes) {
      why = "larger than 256 MiB";
      return false;
    }
  }
  return true;
}

}  // namespace

bool read_image(const std::string& path, Image& image, std::string& why) {
  std::string bytes;
  return read_bytes(path, bytes, why) && read_image_bytes(bytes, image, why);
}

bool read_image_bytes(const std::string& bytes, Image& image, std::string& why) {
  bool good = false;
  if (bytes.rfind("\x89PNG", 0) == 0) {
    good = read_png(bytes, image, why);
  } else if (bytes.rfind("\xff\xd8", 0) == 0) {
    good = read_jpeg(bytes, image, why);
  } else {
    why = "neither PNG nor JPEG";
  }
  if (!good) image = {};
  return good;
}

bool read_png(const std::string& bytes, Image& image, std::string& why) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    why = png.message;
    return false;
  }
  if (png.width > kMaxImageSide || png.height > kMaxImageSide) {
    png_image_free(&png);
    why = kTooLarge;
    return false;
  }
  png.format = PNG_FORMAT_RGBA;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.rgba.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) {
    why = png.message;
    return false;
  }
  return true;
}

bool write_png(const std::string& path, const Image& image, std::string& why) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGBA;
  if (png_image_write_to_file(&png, path.c_str(), 0, image.rgba.data(), 0, nullptr) != 0) return true;
  why = png.message;
  return false;
}

bool is_image_path(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

bool write_image(const std::string& path, const Image& image, std::string& why) {
  if (!is_image_path(path)) {
    why = "neither .png nor .jpg";
    return false;
  }
  if (ending_of(path) == ".png") return write_png(path, image, why);
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    rgb.insert(rgb.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  }
  const std::vector<std::uint8_t> bytes = encode_jpeg(rgb, image.width, image.height);
  std::FILE* file = bytes.empty() ? nullptr : std::fopen(path.c_str(), "wb");
  if (file == nullptr) {
    why = bytes.empty() ? "cannot be compressed" : std::strerror(errno);
    return false;
  }
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (std::fclose(file) == 0 && written) return true;
  why = std::strerror(errno);
  return false;
}

}  // namespace ambf::render
