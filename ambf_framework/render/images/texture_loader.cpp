#include "render/images/texture_loader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/realtime.h"
#include "render/images/srgb.h"

namespace ambf::render {

namespace {

constexpr int kNice = 10;

std::size_t texel(const Image& image, int x, int y) {
  return std::size_t{4} *
         (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}

std::uint8_t srgb_from_linear(float value) {
  const float v = value <= 0.0031308F ? 12.92F * value : 1.055F * std::pow(value, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(v, 0.0F, 1.0F)));
}

struct Curve {
  std::array<float, 256> to_linear{};
  std::array<std::uint8_t, 4096> to_srgb{};
  Curve() {
    for (std::size_t i = 0; i < 256; ++i) to_linear[i] = linear_from_srgb(static_cast<float>(i) / 255.0F);
    for (std::size_t i = 0; i < 4096; ++i) to_srgb[i] = srgb_from_linear(static_cast<float>(i) / 4095.0F);
  }
};

// Half as large. Colours are averaged as light: a black and white check becomes the grey that a distant viewer sees.
Image halved(const Image& image, bool color, const Curve& curve) {
  Image half{std::max(image.width / 2, 1), std::max(image.height / 2, 1), {}};
  half.rgba.resize(std::size_t{4} * static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const int x0 = std::min(2 * x, image.width - 1), x1 = std::min(2 * x + 1, image.width - 1);
      const int y0 = std::min(2 * y, image.height - 1), y1 = std::min(2 * y + 1, image.height - 1);
      const std::uint8_t* from[4] = {&image.rgba[texel(image, x0, y0)], &image.rgba[texel(image, x1, y0)],
                                     &image.rgba[texel(image, x0, y1)], &image.rgba[texel(image, x1, y1)]};
      std::uint8_t* to = &half.rgba[texel(half, x, y)];
      for (int c = 0; c < 4; ++c) {
        if (color && c < 3) {
          float sum = 0.0F;
          for (const std::uint8_t* texel : from) sum += curve.to_linear[texel[c]];
          to[c] = curve.to_srgb[static_cast<std::size_t>(0.25F * sum * 4095.0F + 0.5F)];
        } else {
          to[c] = static_cast<std::uint8_t>((from[0][c] + from[1][c] + from[2][c] + from[3][c] + 2) / 4);
        }
      }
    }
  }
  return half;
}

bool is_grey(const Image& image) {
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    if (std::abs(image.rgba[i] - image.rgba[i + 1]) > 6 || std::abs(image.rgba[i] - image.rgba[i + 2]) > 6)
      return false;
  }
  return true;
}

// MTL's `bump` may name heights instead of normals: then the normals are those of the slope (Sobel), the picture
// being repeated.
void normals_from_heights(Image& image) {
  constexpr float kSlope = 2.0F;  // full white beside full black, a texel away
  const Image heights = image;
  const auto height = [&](int x, int y) {
    const int u = (x + heights.width) % heights.width, v = (y + heights.height) % heights.height;
    return static_cast<float>(heights.rgba[texel(heights, u, v)]) / 255.0F;
  };
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float du = height(x + 1, y - 1) + 2 * height(x + 1, y) + height(x + 1, y + 1) - height(x - 1, y - 1) -
                       2 * height(x - 1, y) - height(x - 1, y + 1);
      const float dv = height(x - 1, y + 1) + 2 * height(x, y + 1) + height(x + 1, y + 1) - height(x - 1, y - 1) -
                       2 * height(x, y - 1) - height(x + 1, y - 1);
      const float nx = -kSlope * du / 4.0F, ny = -kSlope * dv / 4.0F;
      const float length = std::sqrt(nx * nx + ny * ny + 1.0F);
      std::uint8_t* to = &image.rgba[texel(image, x, y)];
      to[0] = static_cast<std::uint8_t>(std::lround(127.5F * (1.0F + nx / length)));
      to[1] = static_cast<std::uint8_t>(std::lround(127.5F * (1.0F + ny / length)));
      to[2] = static_cast<std::uint8_t>(std::lround(127.5F * (1.0F + 1.0F / length)));
    }
  }
}

}  // namespace

void flip_rows(Image& image) {
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(image.width);
  for (int top = 0, bottom = image.height - 1; top < bottom; ++top, --bottom) {
    const auto first = image.rgba.begin() + static_cast<std::ptrdiff_t>(texel(image, 0, top));
    std::swap_ranges(first, first + static_cast<std::ptrdiff_t>(row),
                     image.rgba.begin() + static_cast<std::ptrdiff_t>(texel(image, 0, bottom)));
  }
}

Decoded decode(const TextureKey& key, int largest_side, const std::string* bytes) {
  static const Curve curve;
  Decoded decoded{key, {}, false, {}};
  Image image;
  const bool good =
      bytes != nullptr ? read_image_bytes(*bytes, image, decoded.why) : read_image(key.file, image, decoded.why);
  if (!good) return decoded;
  if (key.use != TextureUse::sky) flip_rows(image);
  if (key.use == TextureUse::normal && is_grey(image)) normals_from_heights(image);
  const bool color = key.use == TextureUse::color || key.use == TextureUse::sky;
  while (image.width > largest_side || image.height > largest_side) image = halved(image, color, curve);
  for (std::size_t i = 3; i < image.rgba.size() && !decoded.has_alpha; i += 4) decoded.has_alpha = image.rgba[i] < 250;
  decoded.levels.push_back(std::move(image));
  while (decoded.levels.back().width > 1 || decoded.levels.back().height > 1) {
    decoded.levels.push_back(halved(decoded.levels.back(), color, curve));
  }
  return decoded;
}

TextureLoader::~TextureLoader() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    asked_.clear();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void TextureLoader::ask(TextureKey key, std::shared_ptr<const std::string> bytes) {
  {
    const std::lock_guard lock(mutex_);
    asked_.push_back({std::move(key), std::move(bytes)});
  }
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  changed_.notify_all();
}

std::vector<Decoded> TextureLoader::take_finished() {
  const std::lock_guard lock(mutex_);
  return std::exchange(finished_, {});
}

bool TextureLoader::busy() const {
  const std::lock_guard lock(mutex_);
  return working_ || !asked_.empty();
}

void TextureLoader::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !working_ && asked_.empty(); });
}

void TextureLoader::work() {
  base::lower_priority(kNice);
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || !asked_.empty(); });
    if (ending_) return;
    const Asked asked = std::move(asked_.front());
    asked_.pop_front();
    working_ = true;
    lock.unlock();
    Decoded decoded = decode(asked.key, largest_side_, asked.bytes.get());
    lock.lock();
    working_ = false;
    finished_.push_back(std::move(decoded));
    changed_.notify_all();
  }
}

}  // namespace ambf::render
