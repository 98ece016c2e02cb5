#include "render/panel/detail/font.h"

#include <cmath>

namespace ambf::render {

// Made by the build (CMakeLists.txt); no bytes when there is no such font.
extern const unsigned char kPanelFont[];
extern const unsigned long kPanelFontSize;
extern const unsigned char kPanelStrongFont[];
extern const unsigned long kPanelStrongFontSize;

namespace {

// Latin with accents, Greek, superscripts and dashes.
constexpr ImWchar kGlyphs[] = {0x0020, 0x017F, 0x0370, 0x03FF, 0x2010, 0x2027, 0x2070, 0x209F, 0};

ImFont* add(ImFontAtlas& fonts, const unsigned char* bytes, unsigned long size, float size_px) {
  ImFontConfig config;
  if (size < 16) {
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

}  // namespace

void load_fonts(ImFontAtlas& fonts, float size_px, float strong_size_px, Ui& ui) {
  fonts.Clear();
  fonts.Flags |= ImFontAtlasFlags_NoMouseCursors;
  add(fonts, kPanelFont, kPanelFontSize, size_px);
  ui.strong = kPanelStrongFontSize < 16 ? nullptr : add(fonts, kPanelStrongFont, kPanelStrongFontSize, strong_size_px);
  fonts.Build();
}

}  // namespace ambf::render
