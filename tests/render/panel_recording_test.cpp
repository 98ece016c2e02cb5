// The button that records data: what it asks of the program around the windows, and what it shows of it.
#include <gtest/gtest.h>

#include <utility>

#include "panel_rig.h"
#include "render/window/data_recording.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

class FakeRecording final : public DataRecording {
 public:
  std::string unavailable() const override { return missing; }
  void start(const std::string& file) override { started.push_back(file), now = State::running; }
  void stop() override { ++stopped, now = State::ending; }
  State state() const override { return now; }
  double running_s() const override { return 12.3; }
  const std::string& file() const override { return started.back(); }
  std::vector<std::string> take_messages() override { return std::exchange(messages, {}); }

  std::string missing;
  std::vector<std::string> started, messages;
  int stopped = 0;
  State now = State::idle;
};

struct PanelRecording : ::testing::Test {
  FakeRecording recording;
  PanelRig rig{"", 1600, 2600, 2.0, &recording};
};

TEST_F(PanelRecording, IsStartedAndEndedByTheButton) {
  rig.model.settings.picture_folder = "/data/study";
  rig.tab("View");
  EXPECT_FALSE(rig.shown("record/time"));
  rig.click("record/data");
  ASSERT_EQ(recording.started.size(), 1u);
  EXPECT_EQ(recording.started[0].rfind("/data/study/ambf_20", 0), 0u) << recording.started[0];
  EXPECT_EQ(std::filesystem::path(recording.started[0]).extension(), ".bag");
  EXPECT_TRUE(rig.shown("record/time"));
  EXPECT_EQ(recording.stopped, 0);
  rig.click("record/data");
  EXPECT_EQ(recording.stopped, 1);
  rig.click("record/data");  // it is being completed: nothing to press
  EXPECT_EQ(recording.stopped, 1);
  EXPECT_EQ(recording.started.size(), 1u);
  EXPECT_TRUE(rig.shown("record/time"));
  recording.now = DataRecording::State::idle;
  rig.pictures(2);
  EXPECT_FALSE(rig.shown("record/time"));
  rig.click("record/data");
  EXPECT_EQ(recording.started.size(), 2u) << "once more";
}

TEST_F(PanelRecording, IsGreyWhereNothingCanBeRecorded) {
  recording.missing = "no ROS";
  rig.tab("View");
  rig.click("record/data");
  EXPECT_TRUE(recording.started.empty());
}

TEST_F(PanelRecording, AKeyThatCannotRecordSaysWhy) {
  recording.missing = "no ROS";
  rig.model.toggle_recording();
  ASSERT_FALSE(rig.said().empty());
  EXPECT_EQ(rig.said().back(), "no recording: no ROS");
  EXPECT_TRUE(recording.started.empty());
}

TEST_F(PanelRecording, WhatComesOfItIsSaidOverTheSceneAlsoWhileThePanelIsHidden) {
  rig.ui.set_open(false);
  recording.messages = {"no recording: the disk is full"};
  rig.pictures(2);
  ASSERT_FALSE(rig.said().empty());
  EXPECT_EQ(rig.said().back(), "no recording: the disk is full");
}

TEST(PanelWithoutRecorder, HasNoSuchButton) {
  PanelRig rig;
  rig.tab("View");
  EXPECT_FALSE(rig.shown("record/data"));
  EXPECT_TRUE(rig.shown("pictures/film"));
}

}  // namespace
}  // namespace ambf::render
