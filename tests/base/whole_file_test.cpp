// Files that are written whole or not at all: what was there survives every failure.
#include "base/whole_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace ambf::base {
namespace {

namespace fs = std::filesystem;

class WholeFile : public testing::Test {
 protected:
  WholeFile() { fs::create_directories(folder_); }
  ~WholeFile() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }
  static std::string text_of(const std::string& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const fs::path folder_ = testing::TempDir() + "ambf_whole_file_" + std::to_string(getpid());
};

TEST_F(WholeFile, IsWrittenAndReplacedOnlyWhenAsked) {
  EXPECT_EQ(write_whole_file(path("a"), "new", IfExists::refuse), "");
  EXPECT_NE(write_whole_file(path("a"), "newer", IfExists::refuse).find("exists"), std::string::npos);
  EXPECT_EQ(text_of(path("a")), "new");
  fs::permissions(path("a"), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(write_whole_file(path("a"), "newer", IfExists::replace), "");
  EXPECT_EQ(text_of(path("a")), "newer");
  struct stat now {};
  ASSERT_EQ(stat(path("a").c_str(), &now), 0);
  EXPECT_EQ(now.st_mode & 0777U, 0600U) << "permissions stay";
  EXPECT_EQ(files(), 1U) << "nothing is left beside it";
}

TEST_F(WholeFile, ALinkStaysAndItsFileIsReplaced) {
  put(path("file"), "old");
  fs::create_symlink("file", path("link"));
  EXPECT_EQ(write_whole_file(path("link"), "new", IfExists::replace), "");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(text_of(path("file")), "new");
}

TEST_F(WholeFile, WhatIsNoFileIsRefused) {
  fs::create_directory(path("folder"));
  EXPECT_NE(write_whole_file(path("folder"), "x", IfExists::replace).find("not an ordinary file"), std::string::npos);
  EXPECT_NE(write_whole_file(path("absent/a"), "x", IfExists::replace).find("No such file"), std::string::npos);
}

// A limit on the size of files fails as a full disk does: in the middle of writing.
TEST_F(WholeFile, AFullDiskCostsNothing) {
  put(path("a"), "old");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto ignore_before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string problem = write_whole_file(path("a"), std::string(5000, 'x'), IfExists::replace);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignore_before);
  EXPECT_NE(problem.find("cannot write"), std::string::npos);
  EXPECT_EQ(text_of(path("a")), "old");
  EXPECT_EQ(files(), 1U);
}

}  // namespace
}  // namespace ambf::base
