// The one font of labels: printable ASCII, 16 glyphs a row, fixed width. Private to render/.
#pragma once

namespace ambf::render {

inline constexpr int kGlyphWidth = 9, kGlyphHeight = 18;  // px
inline constexpr int kGlyphsPerRow = 16, kGlyphRows = 6;
inline constexpr int kFontAtlasWidth = kGlyphsPerRow * kGlyphWidth, kFontAtlasHeight = kGlyphRows * kGlyphHeight;

// One character a texel, ten levels: " .:-=+*%#@". Rows from top to bottom.
extern const char* const kFontRows[kFontAtlasHeight];

}  // namespace ambf::render
