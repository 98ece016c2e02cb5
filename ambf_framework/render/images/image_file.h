// Pictures for textures: reads PNG and JPEG (Debian's libpng and libjpeg-turbo), whatever the file's ending says, and
// writes both. Never throws or prints; any byte sequence gives a picture or a message. Any thread but the physics
// thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ambf::render {

// 8 bits a channel, red green blue alpha, rows from top to bottom, no padding.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

inline constexpr int kMaxImageSide = 8192;

// False with the reason in `why`.
bool read_image(const std::string& path, Image& image, std::string& why);
bool read_image_bytes(const std::string& bytes, Image& image, std::string& why);  // of a whole file
bool read_png(const std::string& bytes, Image& image, std::string& why);          // of a whole file
bool write_png(const std::string& path, const Image& image, std::string& why);
// As the path's ending says: .png, .jpg or .jpeg.
bool write_image(const std::string& path, const Image& image, std::string& why);
bool is_image_path(const std::string& path);

}  // namespace ambf::render
