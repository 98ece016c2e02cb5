#include "render/text/fonts.h"

#include <cmath>

namespace ambf::render {

// Made by the build (CMakeLists.txt); a single byte where there is no such font.
extern const unsigned char kPanelFont[];
extern const unsigned long kPanelFontSize;
extern const unsigned char kPanelStrongFont[];
extern const unsigned long kPanelStrongFontSize;

namespace {

constexpr unsigned long kMinBytes = 16;  // of a font

// Latin with accents, Greek, superscripts and dashes.
constexpr ImWchar kGlyphs[] = {0x0020, 0x017F, 0x0370, 0x03FF, 0x2010, 0x2027, 0x2070, 0x209F, 0};

}  // namespace

ImFont* add_font(ImFontAtlas& fonts, FontWeight weight, float size_px) {
  const bool strong = weight == FontWeight::strong;
  const unsigned char* bytes = strong ? kPanelStrongFont : kPanelFont;
  const unsigned long size = strong ? kPanelStrongFontSize : kPanelFontSize;
  ImFontConfig config;
  if (size < kMinBytes) {
    if (strong) return nullptr;
    config.SizePixels = std::round(size_px * 0.9F);
    return fonts.AddFontDefault(&config);
  }
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.RasterizerMultiply = 1.1F;
  // The atlas only reads them.
  return fonts.AddFontFromMemoryTTF(const_cast<unsigned char*>(bytes), static_cast<int>(size), std::round(size_px),
                                    &config, kGlyphs);
}

}  // namespace ambf::render
