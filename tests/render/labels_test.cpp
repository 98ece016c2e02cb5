#include <gtest/gtest.h>

#include <cstring>

#include "render/camera.h"
#include "render/flat_drawing.h"
#include "render/font.h"
#include "render/messages.h"

namespace ambf::render {
namespace {

TEST(Labels, TheFontHasAllItsRowsAndDrawsLetters) {
  for (const char* row : kFontRows) ASSERT_EQ(std::strlen(row), static_cast<std::size_t>(kFontAtlasWidth));
  const auto darkness = [](char c) {
    const int index = c - 32, x = index % kGlyphsPerRow * kGlyphWidth, y = index / kGlyphsPerRow * kGlyphHeight;
    int sum = 0;
    for (int row = 0; row < kGlyphHeight; ++row) {
      for (int column = 0; column < kGlyphWidth; ++column) sum += kFontRows[y + row][x + column] != ' ' ? 1 : 0;
    }
    return sum;
  };
  EXPECT_EQ(darkness(' '), 0);
  for (char c = '!'; c <= '~'; ++c) EXPECT_GT(darkness(c), 2) << c;
  EXPECT_GT(darkness('M'), darkness('.'));
}

TEST(Labels, CharactersBeyondAsciiTakeOnePlaceEach) {
  EXPECT_EQ(glyph_count("abc"), 3U);
  EXPECT_EQ(glyph_count("\xc3\xbcml\xc3\xa4ut"), 6U);
  FlatDrawing drawing(100, 100);
  drawing.text(0, 0, "\xc3\xbcx", {1, 1, 1, 1});
  EXPECT_EQ(drawing.triangles().size(), 12U);
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
