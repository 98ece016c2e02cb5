// Kept states are bounded, and their files are ordinary ones.
#include "runtime/detail/snapshots.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "base/bounds.h"

namespace ambf::runtime {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string anything(const Bytes&) { return {}; }

class StateFiles : public ::testing::Test {
 protected:
  StateFiles() { std::filesystem::create_directories(folder_); }
  ~StateFiles() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }

 private:
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("ambf_state_files_" + std::to_string(getpid()));
};

TEST(Snapshots, NamesAreShortAndPrintable) {
  const Snapshots snapshots;
  EXPECT_EQ(snapshots.refusal(""), "");
  EXPECT_EQ(snapshots.refusal("before the grasp, Grüße"), "");
  EXPECT_NE(snapshots.refusal(std::string(256, 'a')).find("at most 255 bytes, this one 256"), std::string::npos);
  EXPECT_NE(snapshots.refusal(std::string("a\0b", 3)), "");
  EXPECT_NE(snapshots.refusal("a\nb"), "");
}

TEST(Snapshots, AreRefusedBeyondTheirNumberUntilOneIsForgotten) {
  Snapshots snapshots;
  for (std::size_t i = 0; i < base::kMaxSnapshots; ++i) snapshots.keep("", Bytes(1));
  EXPECT_NE(snapshots.refusal("one more").find("4096 snapshots"), std::string::npos);
  EXPECT_EQ(snapshots.refusal("snapshot7"), "");  // replaces that one
  EXPECT_TRUE(snapshots.forget("snapshot7"));
  EXPECT_FALSE(snapshots.forget("snapshot7"));
  EXPECT_EQ(snapshots.refusal("one more"), "");
}

TEST(Snapshots, AreRefusedBeyondTheirMemoryUntilOneIsForgottenOrReplaced) {
  Snapshots snapshots;
  snapshots.keep("large", Bytes(base::kMaxSnapshotBytes));
  EXPECT_NE(snapshots.refusal("next").find("256 MB"), std::string::npos);
  EXPECT_EQ(snapshots.refusal("large"), "");
  snapshots.keep("large", Bytes(1));
  EXPECT_EQ(snapshots.refusal("next"), "");
}

TEST_F(StateFiles, ComeBackAsTheyWereWritten) {
  const Bytes written{1, 2, 3};
  for (int i = 0; i < 2; ++i) EXPECT_EQ(write_state_file(path("state"), written), "");  // replaces
  Bytes read;
  EXPECT_EQ(read_state_file(path("state"), anything, read), "");
  EXPECT_EQ(read, written);
  EXPECT_EQ(files(), 1u);
}

TEST_F(StateFiles, APipeOrDeviceIsNeitherWrittenNorRead) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  Bytes read;
  for (const std::string& odd : {path("pipe"), std::string("/dev/zero"), path("")}) {
    EXPECT_NE(write_state_file(odd, {1}).find("not an ordinary file"), std::string::npos) << odd;
    EXPECT_NE(read_state_file(odd, anything, read).find("not an ordinary file"), std::string::npos) << odd;
  }
  EXPECT_EQ(files(), 1u);
}

// Somebody else's file beside ours once was written over, and a pipe of that name waited for a reader for ever.
TEST_F(StateFiles, WhatLiesBesideIsLeftAlone) {
  ASSERT_EQ(mkfifo(path("state.part").c_str(), 0600), 0);
  EXPECT_EQ(write_state_file(path("state"), {1}), "");
  struct stat there {};
  ASSERT_EQ(stat(path("state.part").c_str(), &there), 0);
  EXPECT_TRUE(S_ISFIFO(there.st_mode));
}

TEST_F(StateFiles, AreJudgedByTheirFirstBytesAndTheirSize) {
  std::ofstream(path("sparse")).put('x');
  ASSERT_EQ(truncate(path("sparse").c_str(), 1 << 30), 0);
  Bytes read;
  const auto refuses = [](const Bytes& head) { return head.size() < 100 ? "no state" : "read too much"; };
  EXPECT_EQ(read_state_file(path("sparse"), refuses, read), "no state");
  EXPECT_NE(read_state_file(path("sparse"), anything, read).find("1024 MB; state files have at most 256 MB"),
            std::string::npos);
  EXPECT_LT(read.size(), 100u);
}

}  // namespace
}  // namespace ambf::runtime
