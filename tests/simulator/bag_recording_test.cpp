// The panel's recordings: a program beside the simulator that must be started, heard and ended. A small shell script
// stands in for ambf-cli.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <thread>

#include "ambf_simulator/ambf_cli.h"
#include "ambf_simulator/bag_recording.h"

namespace ambf::simulator {
namespace {

namespace fs = std::filesystem;
using State = render::DataRecording::State;

bool eventually(const std::function<bool()>& good) {
  for (int i = 0; i < 6000; ++i) {
    if (good()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

// Says and does what `ambf-cli record --output=FILE` does; leaves its process id beside.
constexpr const char* kGood = R"(#!/bin/sh
file="${2#--output=}"
trap 'echo bag > "$file"; echo "$file: 12 messages of 3 topics in 1.0 s, 4 kB, 0 lost; ended by the user"; exit 0' INT
echo $$ > "$file.pid"
echo "recording into $file; Ctrl-C ends it" >&2
while true; do sleep 0.05; done
)";
constexpr const char* kDiskFull = R"(#!/bin/sh
echo "recording into ${2#--output=}; Ctrl-C ends it" >&2
echo "${2#--output=}: 12 messages of 3 topics in 1.0 s, 4 kB, 3 lost; the disk is full"
echo "ambf-cli: messages were lost" >&2
exit 1
)";
constexpr const char* kNoSpace = R"(#!/bin/sh
echo "something before" >&2
echo "ambf-cli: /data has 3 MB free, less than the 1 GB asked for" >&2
exit 1
)";
constexpr const char* kDeaf = R"(#!/bin/sh
trap '' INT
echo $$ > "${2#--output=}.pid"
echo "recording into ${2#--output=}; Ctrl-C ends it" >&2
while true; do sleep 0.05; done
)";

class BagRecordingTest : public ::testing::Test {
 protected:
  BagRecordingTest() { fs::create_directories(folder); }
  ~BagRecordingTest() override { fs::remove_all(folder); }

  BagRecorderOptions with(const char* script, double patience_s = 20.0) const {
    const fs::path program = folder / "ambf-cli";
    std::ofstream(program) << script;
    fs::permissions(program, fs::perms::owner_all);
    return {"", {(folder / "nothing_here").string(), program.string()}, patience_s};
  }
  bool told(render::DataRecording& recording, const std::string& text) {
    return eventually([&] {
      for (std::string& line : recording.take_messages()) all_told.push_back(line);
      return std::any_of(all_told.begin(), all_told.end(), [&](const auto& l) { return l.find(text) != l.npos; });
    });
  }
  pid_t pid() const {
    pid_t found = 0;
    eventually([&] { return static_cast<bool>(std::ifstream(file + ".pid") >> found); });
    return found;
  }
  // A zombie would still be there.
  static bool gone(pid_t pid) { return kill(pid, 0) != 0 && errno == ESRCH; }

  const fs::path folder = fs::temp_directory_path() / ("ambf_bag_recording" + std::to_string(getpid()));
  const std::string file = (folder / "a bag.bag").string();
  base::Log log;
  std::vector<std::string> all_told;
};

TEST_F(BagRecordingTest, IsInterruptedAndItsResultIsTold) {
  BagRecording recording(with(kGood), log);
  EXPECT_EQ(recording.state(), State::idle);
  EXPECT_EQ(recording.running_s(), 0.0);
  recording.start(file);
  ASSERT_TRUE(told(recording, "recording into " + file));
  EXPECT_EQ(recording.state(), State::running);
  EXPECT_GT(recording.running_s(), 0.0);
  const pid_t program = pid();
  recording.start(file + "2");  // one at a time
  EXPECT_EQ(recording.file(), file);
  recording.stop();
  EXPECT_EQ(recording.state(), State::ending);
  ASSERT_TRUE(told(recording, "recorded: " + file + ": 12 messages of 3 topics"));
  ASSERT_TRUE(eventually([&] { return recording.state() == State::idle; }));
  EXPECT_TRUE(fs::exists(file));
  EXPECT_TRUE(gone(program));
}

TEST_F(BagRecordingTest, OneFollowsTheOther) {
  BagRecording recording(with(kGood), log);
  for (const std::string& name : {file, file + "2.bag"}) {
    recording.start(name);
    ASSERT_TRUE(told(recording, "recording into " + name));
    recording.stop();
    ASSERT_TRUE(told(recording, "recorded: " + name));
    ASSERT_TRUE(eventually([&] { return recording.state() == State::idle; }));
  }
}

TEST_F(BagRecordingTest, NobodyWaitsForAProgramThatDoesNotEnd) {
  BagRecording recording(with(kDeaf, 1.0), log);
  recording.start(file);
  recording.stop();
  EXPECT_EQ(recording.state(), State::ending) << "asked, and back here while it runs on";
  EXPECT_FALSE(gone(pid()));
}

TEST_F(BagRecordingTest, ABagWithLossesIsToldWithItsReason) {
  BagRecording recording(with(kDiskFull), log);
  recording.start(file);
  EXPECT_TRUE(told(recording, "3 lost; the disk is full (ambf-cli: messages were lost)"));
  EXPECT_TRUE(eventually([&] { return recording.state() == State::idle; })) << "it ended by itself";
}

TEST_F(BagRecordingTest, WhatCannotBeginIsToldByItsLastLine) {
  BagRecording recording(with(kNoSpace), log);
  recording.start(file);
  EXPECT_TRUE(told(recording, "no recording: ambf-cli: /data has 3 MB free"));
}

TEST_F(BagRecordingTest, AMissingProgramIsToldWithWhatToDo) {
  BagRecording recording({"", {(folder / "tree/.venv/bin/ambf-cli").string()}}, log);
  recording.start(file);
  EXPECT_TRUE(told(recording, "no recording: there is no ambf-cli on the PATH, nor as " + folder.string()));
  EXPECT_NE(all_told.back().find("./dev deps"), std::string::npos);
}

TEST_F(BagRecordingTest, WithoutRosThereIsNone) {
  BagRecorderOptions options = with(kGood);
  options.unavailable = "no ROS here";
  BagRecording recording(options, log);
  EXPECT_EQ(recording.unavailable(), "no ROS here");
  recording.start(file);
  EXPECT_EQ(recording.state(), State::idle);
  EXPECT_TRUE(told(recording, "no recording: no ROS here"));
}

TEST_F(BagRecordingTest, TheEndOfTheSimulatorCompletesTheBag) {
  pid_t program = 0;
  {
    BagRecording recording(with(kGood), log);
    recording.start(file);
    program = pid();
  }
  EXPECT_TRUE(fs::exists(file));
  EXPECT_TRUE(gone(program));
}

TEST_F(BagRecordingTest, AProgramThatDoesNotEndIsKilledAtTheEnd) {
  pid_t program = 0;
  {
    BagRecording recording(with(kDeaf, 1.0), log);
    recording.start(file);
    program = pid();
  }
  EXPECT_TRUE(gone(program));
}

TEST_F(BagRecordingTest, ASimulatorThatIsKilledEndsItToo) {
  const BagRecorderOptions options = with(kGood);
  const pid_t simulator = fork();
  if (simulator == 0) {
    BagRecording recording(options, log);
    recording.start(file);
    for (;;) pause();
  }
  const pid_t program = pid();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until its trap is set
  ASSERT_EQ(kill(simulator, SIGKILL), 0);
  waitpid(simulator, nullptr, 0);
  EXPECT_TRUE(eventually([&] { return fs::exists(file); })) << "interrupted, its bag is complete";
  kill(program, SIGKILL);
}

TEST(AmbfCli, IsLookedForOnThePathThenInTheTree) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/first:/second", 1);
  setenv("AMBF_ROOT_PATH", "/tree", 1);
  const std::vector<std::string> wanted = {"/first/ambf-cli", "/second/ambf-cli", "/tree/.venv/bin/ambf-cli"};
  EXPECT_EQ(ambf_cli_places(), wanted);
  setenv("PATH", path.c_str(), 1);
  unsetenv("AMBF_ROOT_PATH");
}

}  // namespace
}  // namespace ambf::simulator
