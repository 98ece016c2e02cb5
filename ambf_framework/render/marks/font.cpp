#include "render/marks/detail/font.h"

#include <cmath>

namespace ambf::render {

namespace {

constexpr unsigned kFirst = 32, kLastAscii = 126, kFirstLatin = 160, kLast = 255;

int index_of(unsigned character) {
  if (character >= kFirst && character <= kLastAscii) return static_cast<int>(character - kFirst);
  if (character >= kFirstLatin && character <= kLast) {
    return static_cast<int>(character - kFirstLatin + kLastAscii - kFirst + 1);
  }
  return '?' - static_cast<int>(kFirst);
}

}  // namespace

Lettering lettering(double scale) {
  const double wanted = kFontFaces[0].size * scale;
  const FontFace* best = &kFontFaces[0];
  for (const FontFace& face : kFontFaces) {
    if (std::abs(face.size - wanted) < std::abs(best->size - wanted)) best = &face;
  }
  // Nearly right is better sharp than exact.
  const double zoom = wanted / best->size;
  return {best, zoom > 0.85 && zoom < 1.2 ? 1.0 : zoom};
}

const Glyph& next_glyph(const FontFace& face, const std::string& text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
  unsigned character = byte(at++);
  if (character >= 0xC0U) {
    const bool two_bytes = character < 0xE0U && at < text.size();
    character = two_bytes ? (character & 0x1FU) << 6U | (byte(at) & 0x3FU) : 0U;
    while (at < text.size() && (byte(at) & 0xC0U) == 0x80U) ++at;
  }
  return face.glyphs[index_of(character)];
}

double text_width(const std::string& line, double scale) {
  const auto [face, zoom] = lettering(scale);
  double width = 0.0;
  for (std::size_t at = 0; at < line.size();) width += next_glyph(*face, line, at).advance / 64.0;
  return width * zoom;
}

double line_height(double scale) {
  const auto [face, zoom] = lettering(scale);
  return std::round(face->line_height * zoom);
}

}  // namespace ambf::render
