// Text over a scene: what it measures, where help, messages and labels are, and what a window tells its user.
#include <gtest/gtest.h>
#include <imgui/imgui.h>

#include <algorithm>

#include "render/text/text_drawing.h"
#include "render/window/help_card.h"
#include "render/window/messages.h"
#include "render/window/overlay.h"

namespace ambf::render {
namespace {

std::shared_ptr<const Lettering> letters(double scale) { return std::make_shared<const Lettering>(scale); }

TEST(Labels, TextBeyondAsciiIsAGlyphACharacter) {
  TextDrawing drawing(letters(1.0), 100, 100);
  drawing.text(0, 0, "\xc3\xbcx", {1, 1, 1, 1}, 1.0);
  ASSERT_EQ(drawing.lists().size(), 1U);
  EXPECT_EQ(drawing.lists()[0]->IdxBuffer.Size, 12);
  const Lettering& all = *drawing.letters();
  EXPECT_NEAR(all.width("\xe2\x82\xac", 1.0), all.width("?", 1.0), 1e-9);  // the font has no euro sign here
  for (const char* text : {"\xc3\xbc", "\xce\xb1", "\xc2\xb0", "%"}) {
    EXPECT_GT(all.width(text, 1.0), 3.0) << text;
    EXPECT_NE(all.width(text, 1.0), all.width("?", 1.0)) << text;
  }
}

TEST(Labels, OnADenseScreenLettersAreTwiceAsLarge) {
  const std::string text = "Phx (1000 Hz)";
  EXPECT_NEAR(letters(2.0)->width(text, 2.0) / letters(1.0)->width(text, 1.0), 2.0, 0.1);
  EXPECT_NEAR(letters(1.0)->width(text, 2.0) / letters(1.0)->width(text, 1.0), 2.0, 1e-3);  // magnified
  EXPECT_NEAR(Lettering::line_height(2.0) / Lettering::line_height(1.0), 2.0, 0.15);
}

// Dear ImGui's indices have 16 bits.
TEST(Labels, ManyMoreThanOneListHoldsAreAllDrawn) {
  constexpr int kTexts = 4000;
  TextDrawing drawing(letters(1.0), 800, 600);
  for (int i = 0; i < kTexts; ++i) drawing.text(10, 10 + i % 500, "twelve_chars", {1, 1, 1, 1}, 1.0);
  int indices = 0;
  for (const auto& list : drawing.lists()) {
    EXPECT_LT(list->VtxBuffer.Size, 65536);
    indices += list->IdxBuffer.Size;
  }
  EXPECT_EQ(indices, kTexts * 12 * 6);
}

// Corners of what is drawn, in pixels.
struct Extent {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
};
// `from`: of the vertices of its only list, the first that counts.
Extent extent(const TextDrawing& drawing, int from = 0) {
  Extent all;
  EXPECT_EQ(drawing.lists().size(), 1U);
  const ImVector<ImDrawVert>& vertices = drawing.lists()[0]->VtxBuffer;
  for (int i = from; i < vertices.Size; ++i) {
    const double x = static_cast<double>(vertices[i].pos.x), y = static_cast<double>(vertices[i].pos.y);
    all = {std::min(all.left, x), std::min(all.top, y), std::max(all.right, x), std::max(all.bottom, y)};
  }
  return all;
}

TEST(Overlay, HelpStaysInsideAWindowOfTheUsualSizeAtEveryDensity) {
  for (const double scale : {1.0, 1.5, 2.0}) {
    const int width = 1536, height = 540;  // small for a dense screen
    HelpCard help;
    help.turn();
    const Extent all = extent(*help.drawing(width, height, scale));
    EXPECT_GE(all.left, 0.0);
    EXPECT_LE(all.right, width) << scale;
    EXPECT_LE(all.bottom, height) << scale;
  }
}

TEST(Overlay, HelpTurnsPagesInASmallWindowAndItsLettersStayReadable) {
  const HelpLayout small = help_layout(help_table(), 400, 480, 1.0), large = help_layout(help_table(), 1536, 864, 1.0);
  EXPECT_EQ(large.pages, 1U);
  EXPECT_EQ(large.scale, 1.0);
  EXPECT_GT(small.pages, 1U);
  EXPECT_GE(Lettering::line_height(small.scale), 10.0);
  HelpCard help;
  for (std::size_t page = 0; page < small.pages; ++page) {
    help.turn();
    ASSERT_TRUE(help.shown()) << page;
    const Extent all = extent(*help.drawing(400, 480, 1.0));
    EXPECT_LE(all.right, 400.0) << page;
    EXPECT_LE(all.bottom, 480.0) << page;
  }
  help.turn();
  EXPECT_FALSE(help.shown());
}

TEST(Overlay, LongMessagesAreWrapped) {
  TextDrawing messages(letters(1.0), 300, 300);
  draw_overlay({{"a message that is rather long, about a file that could not be loaded"}, {}}, messages);
  const Extent all = extent(messages);
  EXPECT_LE(all.right, 300.0);
  EXPECT_GT(all.bottom - all.top, 2 * Lettering::line_height(1.0));
}

TEST(Overlay, LabelsAreInTheMiddleOfTheLowerEdgeAndMessagesDoNotCoverThem) {
  const auto all = letters(1.0);
  TextDrawing labels(all, 800, 300), messages(all, 800, 300);
  const std::vector<std::string> lines = {"Wall Time: 12.34 s / Sim Time: 12.34 s", "Gfx (60 Hz) / Phx (1000 Hz)"};
  draw_overlay({{}, lines}, labels);
  const Extent low = extent(labels);
  EXPECT_NEAR((low.left + low.right) / 2, 400.0, 1.0);
  EXPECT_GT(low.top, 220.0);
  EXPECT_LE(low.bottom, 300.0);
  draw_overlay({{"a message that is rather long, about a file that could not be loaded"}, lines}, messages);
  EXPECT_LT(extent(messages, labels.lists()[0]->VtxBuffer.Size).bottom, low.top);
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
