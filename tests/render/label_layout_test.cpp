#include "render/marks/label_layout.h"

#include <gtest/gtest.h>

namespace ambf::render {
namespace {

constexpr int kWidth = 640, kHeight = 480;

class LabelLayout : public ::testing::Test {
 protected:
  LabelLayout() { camera_.T_world_camera = {{3, 0, 0}, {}}; }  // looks along -x, y to the right
  std::vector<Label> lay(const std::vector<DebugText>& texts) {
    return lay_out(texts, camera_, kWidth, kHeight, letters_);
  }
  static bool overlap(const Label& a, const Label& b) {
    return a.left_px < b.left_px + b.width_px && b.left_px < a.left_px + a.width_px &&
           a.top_px < b.top_px + b.height_px && b.top_px < a.top_px + a.height_px;
  }
  Camera camera_;
  const Lettering letters_{1.0};
};

TEST_F(LabelLayout, StandAboveTheirPoint) {
  const std::vector<DebugText> texts = {{{0, 0, 0}, "middle"}};
  const auto labels = lay(texts);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_NEAR(labels[0].left_px + labels[0].width_px / 2, kWidth / 2.0, 1.0);
  EXPECT_LT(labels[0].top_px + labels[0].height_px, kHeight / 2.0);
  EXPECT_GT(labels[0].top_px + labels[0].height_px, kHeight / 2.0 - 30.0);
}

TEST_F(LabelLayout, KeepClearOfWhatIsDrawnAboutThePoint) {
  const std::vector<DebugText> texts = {{{0, 0, 0}, "middle", {1, 1, 1, 1}, 0.3, 0.3}};
  const auto labels = lay(texts);
  ASSERT_EQ(labels.size(), 1U);
  const double radius_px = 0.3 / 3.0 / std::tan(0.35) * kHeight / 2;
  EXPECT_LT(labels[0].top_px + labels[0].height_px, kHeight / 2.0 - radius_px);
}

TEST_F(LabelLayout, NoneCoversAnotherAndTheNearComeFirst) {
  std::vector<DebugText> texts;
  for (int i = 0; i < 40; ++i) texts.push_back({{-0.05 * i, 0, 0}, "body " + std::to_string(i), {1, 1, 1, 1}, 0.5});
  const auto labels = lay(texts);
  EXPECT_GE(labels.size(), 4U);
  EXPECT_LT(labels.size(), texts.size());
  EXPECT_EQ(labels[0].text->text, "body 0");
  for (std::size_t a = 0; a < labels.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(overlap(labels[a], labels[b])) << a << " " << b;
  }
}

TEST_F(LabelLayout, WhatMustBeReadIsNeverLeftOut) {
  std::vector<DebugText> texts;
  for (int i = 0; i < 10; ++i) texts.push_back({{0.5, 0, 0}, "near", {1, 1, 1, 1}, 0.5});
  texts.push_back({{-0.5, 0, 0}, "12 N"});
  const auto labels = lay(texts);
  ASSERT_FALSE(labels.empty());
  EXPECT_EQ(labels[0].text->text, "12 N");
}

TEST_F(LabelLayout, OfSmallAndFarThingsFade) {
  const std::vector<DebugText> texts = {{{0, -0.5, 0}, "large", {1, 1, 1, 1}, 0.2},
                                        {{0, 0, 0}, "small", {1, 1, 1, 1}, 0.05},
                                        {{0, 0.5, 0}, "tiny", {1, 1, 1, 1}, 0.001}};
  const auto labels = lay(texts);
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0].alpha, 1.0F);
  EXPECT_LT(labels[1].alpha, 1.0F);
}

TEST_F(LabelLayout, WhatIsBehindOrAsideIsNotNamed) {
  EXPECT_TRUE(lay({{{5, 0, 0}, "behind"}, {{0, 30, 0}, "aside"}}).empty());
}

TEST_F(LabelLayout, StayInThePicture) {
  const std::vector<DebugText> texts = {{{0, 1.4, 0.05}, "a long name at the right edge"}};
  const auto labels = lay(texts);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_LE(labels[0].left_px + labels[0].width_px, kWidth);
  EXPECT_GE(labels[0].left_px, 0.0);
}

}  // namespace
}  // namespace ambf::render
