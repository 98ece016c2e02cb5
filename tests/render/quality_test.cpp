#include "render/scene/quality.h"

#include <gtest/gtest.h>

namespace ambf::render {
namespace {

// Draws for `seconds` at `seconds_per_picture(level)`; returns how often the level changed.
template <class Cost>
int run(QualityGovernor& governor, std::int64_t& now_ns, double seconds, Cost seconds_per_picture) {
  int changes = 0;
  for (const std::int64_t end = now_ns + static_cast<std::int64_t>(seconds * 1e9); now_ns < end;) {
    const int before = governor.level();
    const double cost = seconds_per_picture(before);
    now_ns += static_cast<std::int64_t>(std::max(cost, 1.0 / 60.0) * 1e9);
    governor.picture_done(now_ns, cost);
    changes += governor.level() != before ? 1 : 0;
  }
  return changes;
}

TEST(Quality, FastMachinesGetTheBest) {
  QualityGovernor governor(true);
  std::int64_t now = 1;
  EXPECT_EQ(governor.level(), 1);  // to begin with
  EXPECT_EQ(run(governor, now, 10.0, [](int) { return 0.005; }), 1);
  EXPECT_EQ(governor.quality().samples, 4);
  EXPECT_TRUE(governor.quality().occlusion);
  EXPECT_EQ(governor.quality().shadow_interval, 1U);
}

TEST(Quality, SlowOnesGiveUpSamplesPixelsAndNewShadowsStepByStep) {
  QualityGovernor governor(true);
  std::int64_t now = 1;
  run(governor, now, 1.5, [](int) { return 0.08; });
  EXPECT_EQ(governor.level(), 2);
  run(governor, now, 10.0, [](int) { return 0.08; });
  EXPECT_EQ(governor.quality().samples, 1);
  EXPECT_EQ(governor.quality().shadow_interval, 6U) << "what stands on a table does not float";
  EXPECT_LT(governor.quality().resolution, 1.0);
}

TEST(Quality, WhatRestsGetsAllPixelsAndThenAllSamples) {
  EXPECT_FALSE(resting_quality(0.1));
  ASSERT_TRUE(resting_quality(0.5));
  EXPECT_EQ(resting_quality(0.5)->resolution, 1.0);
  EXPECT_EQ(resting_quality(0.5)->samples, 1);
  EXPECT_EQ(resting_quality(2.0)->samples, 4);
}

TEST(Quality, RecoversWhenTheMachineIsFreeAgain) {
  QualityGovernor governor(true);
  std::int64_t now = 1;
  run(governor, now, 10.0, [](int) { return 0.08; });
  run(governor, now, 400.0, [](int) { return 0.004; });
  EXPECT_EQ(governor.level(), 0);
}

TEST(Quality, DoesNotFlickerBetweenTwoLevels) {
  QualityGovernor governor(true);
  std::int64_t now = 1;
  const auto cost = [](int level) { return level == 0 ? 0.05 : 0.008; };  // each level tempts to the other
  run(governor, now, 60.0, cost);
  EXPECT_LE(run(governor, now, 300.0, cost), 10);
}

TEST(Quality, StaysTheBestWhereTheGraphicsCardDraws) {
  QualityGovernor governor(false);
  std::int64_t now = 1;
  EXPECT_EQ(run(governor, now, 10.0, [](int) { return 0.2; }), 0);
}

TEST(Quality, VideosOfTheProcessorSaveSharpnessAtASlantOnlyAndStreamsMuchMore) {
  const Quality best, video = video_quality(true), stream = stream_quality(true);
  EXPECT_FALSE(video.sharp_textures);
  EXPECT_EQ(video.samples, best.samples);
  EXPECT_EQ(video.occlusion, best.occlusion);
  EXPECT_EQ(video.shadow_filter, best.shadow_filter);
  EXPECT_EQ(video.shadow_interval, 1U);
  EXPECT_EQ(stream.samples, 1);
  EXPECT_EQ(stream.shadow_interval, 1U);  // shadows where things are, in each picture
  EXPECT_TRUE(video_quality(false).sharp_textures);
  EXPECT_EQ(stream_quality(false).samples, best.samples);
}

}  // namespace
}  // namespace ambf::render
