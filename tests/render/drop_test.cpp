#include "render/window/drop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace ambf::render {
namespace {

namespace fs = std::filesystem;

class Drop : public ::testing::Test {
 protected:
  Drop() : folder_(fs::temp_directory_path() / ("ambf drop " + std::to_string(getpid()))) {
    fs::create_directory(folder_);
  }
  ~Drop() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) {
    std::ofstream(folder_ / name) << "bodies: []\n";
    return (folder_ / name).string();
  }
  fs::path folder_;
};

TEST_F(Drop, AdfAndUrdfFilesAreWelcomeWhateverTheirName) {
  for (const char* name :
       {"a.yaml", "b.YAML", "c.ambf", "d.AMBF", "e.URDF", "with space ümläut.yaml", "two.dots.yml"}) {
    EXPECT_EQ(refusal_of_drop(file(name)), "") << name;
  }
}

TEST_F(Drop, EverythingElseIsRefusedByName) {
  for (const char* name : {"picture.png", "yaml", "noending", "model.stl", "robot.xacro"}) {
    const std::string refusal = refusal_of_drop(file(name));
    EXPECT_NE(refusal.find(std::string("'") + name + "'"), std::string::npos) << refusal;
  }
  EXPECT_NE(refusal_of_drop(file("robot.xacro")).find("xacro"), std::string::npos);
}

TEST_F(Drop, FoldersAndMissingFilesAreRefused) {
  fs::create_directory(folder_ / "folder.yaml");
  EXPECT_NE(refusal_of_drop((folder_ / "folder.yaml").string()).find("is a folder"), std::string::npos);
  EXPECT_NE(refusal_of_drop((folder_ / "gone.yaml").string()).find("cannot be found"), std::string::npos);
  EXPECT_NE(refusal_of_drop("/dev/null"), "");
  EXPECT_NE(refusal_of_drop(""), "");
}

}  // namespace
}  // namespace ambf::render
