// The one font of labels: printable ASCII and Latin-1, proportional, in three sizes, so that text is sharp on screens of usual and of high
// density. The texels are in font_atlas.png. Pure data and functions, any thread. Private to render/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ambf::render {

struct Glyph {
  std::int16_t x, y, width, height;  // in the atlas, texels
  std::int16_t left, top;            // from the pen, which stands at the upper edge of the line
  std::int16_t advance;              // of the pen, in 64ths of a pixel
};

inline constexpr int kFontFaceCount = 3, kFontGlyphCount = 191;
inline constexpr int kDisc = kFontGlyphCount;  // after the characters: a disc, for round corners

struct FontFace {
  int size, line_height;  // px
  Glyph glyphs[kFontGlyphCount + 1];
};

extern const FontFace kFontFaces[kFontFaceCount];
extern const int kFontAtlasWidth, kFontAtlasHeight;
extern const unsigned char kFontAtlasPng[];  // embedded by CMake
extern const std::size_t kFontAtlasBytes;

// The face that is sharpest at this scale (1: a screen of usual density), and what is left to magnify.
struct Lettering {
  const FontFace* face;
  double zoom;
};
Lettering lettering(double scale);

// Reads one character of UTF-8 text at `at`, which moves on. The glyph of '?' for what the font lacks.
const Glyph& next_glyph(const FontFace& face, const std::string& text, std::size_t& at);

double text_width(const std::string& line, double scale);  // px
double line_height(double scale);                          // px

}  // namespace ambf::render
