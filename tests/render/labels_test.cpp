#include <gtest/gtest.h>

#include <algorithm>

#include "render/camera/camera.h"
#include "render/marks/detail/font.h"
#include "render/marks/flat_drawing.h"
#include "render/marks/overlay.h"
#include "render/pictures/image_file.h"
#include "render/window/messages.h"

namespace ambf::render {
namespace {

TEST(Labels, EveryCharacterOfTheFontHasAPlaceInItsPicture) {
  Image atlas;
  std::string why;
  ASSERT_TRUE(read_png({reinterpret_cast<const char*>(kFontAtlasPng), kFontAtlasBytes}, atlas, why)) << why;
  ASSERT_EQ(atlas.width, kFontAtlasWidth);
  ASSERT_EQ(atlas.height, kFontAtlasHeight);
  for (const FontFace& face : kFontFaces) {
    for (int i = 0; i <= kFontGlyphCount; ++i) {
      const Glyph& glyph = face.glyphs[i];
      int ink = 0;
      for (int y = glyph.y; y < glyph.y + glyph.height; ++y) {
        for (int x = glyph.x; x < glyph.x + glyph.width; ++x) {
          ink += atlas.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) +
                                 static_cast<std::size_t>(x))];
        }
      }
      const bool blank = i == 0 || i == 95 || i == 108;  // two spaces and the soft hyphen, which some fonts draw
      EXPECT_TRUE(ink > 0 || blank) << "glyph " << i << " of size " << face.size;
    }
  }
}

TEST(Labels, TextBeyondAsciiTakesOnePlaceACharacter) {
  FlatDrawing drawing(100, 100);
  drawing.text(0, 0, "\xc3\xbcx", {1, 1, 1, 1});
  EXPECT_EQ(drawing.triangles().size(), 12U);
  EXPECT_NEAR(text_width("\xe2\x82\xac", 1.0), text_width("?", 1.0), 1e-9);  // the font has no euro sign
  EXPECT_GT(text_width("\xc3\xbc", 1.0), 4.0);
}

TEST(Labels, OnADenseScreenLettersAreTwiceAsLarge) {
  EXPECT_NEAR(text_width("Phx (1000 Hz)", 2.0) / text_width("Phx (1000 Hz)", 1.0), 2.0, 0.1);
  EXPECT_NEAR(line_height(2.0) / line_height(1.0), 2.0, 0.15);
  EXPECT_NEAR(line_height(4.0) / line_height(1.0), 4.0, 0.3);  // beyond the largest face: magnified
}

// Corners of what is drawn, in pixels.
struct Extent {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
};
Extent extent(const FlatDrawing& drawing, int width, int height) {
  Extent all;
  for (const FlatVertex& v : drawing.triangles()) {
    const double x = (static_cast<double>(v.position[0]) + 1.0) / 2.0 * width;
    const double y = (1.0 - static_cast<double>(v.position[1])) / 2.0 * height;
    all = {std::min(all.left, x), std::min(all.top, y), std::max(all.right, x), std::max(all.bottom, y)};
  }
  return all;
}

TEST(Overlay, HelpStaysInsideAWindowOfTheUsualSizeAtEveryDensity) {
  for (const double scale : {1.0, 1.5, 2.0}) {
    const int width = 1536, height = 540;  // small for a dense screen
    FlatDrawing drawing(width, height);
    draw_overlay({help_table(), {}, {}}, width, height, scale, drawing);
    const Extent all = extent(drawing, width, height);
    EXPECT_GE(all.left, 0.0);
    EXPECT_LE(all.right, width) << scale;
    EXPECT_LE(all.bottom, height) << scale;
  }
}

TEST(Overlay, LabelsAreInTheMiddleOfTheLowerEdgeAndMessagesDoNotCoverThem) {
  FlatDrawing labels(800, 300), messages(800, 300);
  const std::vector<std::string> lines = {"Wall Time: 12.34 s / Sim Time: 12.34 s", "Gfx (60 Hz) / Phx (1000 Hz)"};
  draw_overlay({{}, {}, lines}, 800, 300, 1.0, labels);
  const Extent low = extent(labels, 800, 300);
  EXPECT_NEAR((low.left + low.right) / 2, 400.0, 1.0);
  EXPECT_GT(low.top, 220.0);
  draw_overlay({{}, {"a message that is rather long, about a file that could not be loaded"}, lines}, 800, 300, 1.0,
               messages);
  FlatDrawing alone(800, 300);
  draw_overlay({{}, {}, lines}, 800, 300, 1.0, alone);
  const auto first = static_cast<std::ptrdiff_t>(alone.triangles().size());
  double lowest = 0.0;
  for (auto v = messages.triangles().begin() + first; v != messages.triangles().end(); ++v) {
    lowest = std::max(lowest, (1.0 - static_cast<double>(v->position[1])) / 2.0 * 300);
  }
  EXPECT_LT(lowest, low.top);
}

TEST(Labels, LinesBehindTheViewerAreCutAway) {
  const Mat4 m = projection_matrix({}, 1.0) * view_matrix({});
  FlatDrawing drawing(100, 100);
  drawing.line(m, {1, 0, 0}, {2, 1, 0}, 2.0, {});  // all of it behind
  EXPECT_TRUE(drawing.empty());
  drawing.line(m, {-1, 0, 0}, {2, 1, 0}, 2.0, {});  // from in front to behind
  ASSERT_EQ(drawing.triangles().size(), 6U);
  for (const FlatVertex& v : drawing.triangles()) EXPECT_GT(v.position[3], 0.0F);
}

TEST(Messages, AreShownForAWhileNewestLastAndOnlyAFew) {
  Messages messages;
  for (int i = 0; i < 10; ++i) messages.add(std::to_string(i));
  const std::vector<std::string> shown = messages.shown(1'000'000'000);
  ASSERT_EQ(shown.size(), 6U);
  EXPECT_EQ(shown.back(), "9");
  EXPECT_EQ(messages.shown(5'000'000'000).size(), 6U);
  EXPECT_TRUE(messages.shown(8'000'000'000).empty());
}

}  // namespace
}  // namespace ambf::render
