// What the panel remembers, and files of it that are broken or cannot be written.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "panel_rig.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

class PanelSettingsFile : public ::testing::Test {
 protected:
  PanelSettingsFile() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  ~PanelSettingsFile() override { std::filesystem::remove_all(folder); }

  PanelSettings read() { return read_settings(path, problem); }
  void write(const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("ambf_panel_settings" + std::to_string(getpid()));
  const std::string path = (folder / "panel.conf").string();
  std::string problem;
};

// What the log says of the settings while `act` runs on a panel that keeps them in `path`.
int complaints(const std::string& path, const std::function<void(PanelRig&)>& act) {
  PanelRig rig(path);
  act(rig);
  int count = 0;
  base::LogDrain drain(rig.rig.log, [&](const base::LogLine& line) {
    if (line.text.find("panel's settings") != std::string::npos) ++count;
  });
  drain.flush();  // repetitions included
  return count;
}

TEST_F(PanelSettingsFile, IsReadAsItWasWritten) {
  PanelSettings settings;
  settings.dark = false;
  settings.degrees = true;
  settings.width_points = 512.5;
  settings.tab = 3;
  settings.picture_folder = "/my pictures";
  settings.recent_files = {"/a b/\u00fc.yaml", "c.yaml"};
  settings.watched = {"/test/box position x"};
  const std::string deeper = (folder / "deeper" / "panel.conf").string();
  ASSERT_TRUE(write_settings(deeper, settings));
  EXPECT_TRUE(read_settings(deeper, problem) == settings);
  EXPECT_EQ(problem, "");
  EXPECT_TRUE(read_settings("/nowhere/at/all", problem) == PanelSettings{});
  EXPECT_EQ(problem, "") << "the first start is no problem";
}

TEST_F(PanelSettingsFile, KeepsWhatMakesSenseAndSaysWhatDoesNot) {
  write("width nonsense\nwidth -5\ntab 9999999999\nunknown thing\n\ntheme light\nunits furlongs\n");
  EXPECT_EQ(read().width_points, 0.0);
  EXPECT_FALSE(read().dark);
  EXPECT_FALSE(read().degrees);
  EXPECT_EQ(problem, "5 lines make no sense and are ignored, the first is line 1");
  write("theme light\nwidth 1e999\n");
  read();
  EXPECT_EQ(problem, "line 2 makes no sense and is ignored");
}

TEST_F(PanelSettingsFile, EverySceneHasItsLayoutAndANewOneTheLast) {
  const auto of = [&](const std::string& scene) {
    return std::make_unique<PanelRig>(path, 1600, 2600, 2.0, nullptr, scene);
  };
  {
    const auto arm = of("/models/arm.yaml");
    arm->model.settings.width_points = 500.0;
    arm->pictures(2);
    arm->model.plots.watch("/test/box position x", true);
    arm->tab("Joints");
  }
  {
    const auto cart = of("/models/cart.yaml");
    EXPECT_EQ(cart->model.settings.tab, 1) << "of the user, where the scene is new";
    EXPECT_EQ(cart->model.settings.width_points, 500.0);
    cart->model.settings.width_points = 350.0;
    cart->model.settings.picture_folder = "/study";
    cart->pictures(2);
    cart->model.plots.watch("/test/box position x", false);
    cart->tab("Plots");
  }
  const auto arm = of("/models/arm.yaml");
  EXPECT_EQ(arm->model.settings.tab, 1);
  EXPECT_EQ(arm->model.settings.width_points, 500.0);
  EXPECT_TRUE(arm->model.plots.watched("/test/box position x"));
  EXPECT_EQ(arm->model.settings.picture_folder, "/study") << "the user's, in all scenes";
  EXPECT_FALSE(of("/models/cart.yaml")->model.plots.watched("/test/box position x")) << "also that nothing is";
}

TEST_F(PanelSettingsFile, ScenesOfOneNameAreTwoScenes) {
  EXPECT_NE(layout_path(path, "/a/arm.yaml"), layout_path(path, "/b/arm.yaml"));
  EXPECT_NE(layout_path(path, "/a/arm.yaml"), layout_path(path, "/a/arm.yaml\n/a/cart.yaml"));
  EXPECT_EQ(std::filesystem::path(layout_path(path, "/a/arm.yaml")).parent_path(), folder / "scenes");
}

TEST_F(PanelSettingsFile, ABrokenLayoutIsSaidAndTheRestIsKept) {
  const std::string layout = layout_path(path, "/a/arm.yaml");
  ASSERT_TRUE(write_layout(layout, "/a/arm.yaml", {}));
  std::ofstream(layout, std::ios::app) << "width nonsense\ntab 4\n";
  PanelSettings settings;
  settings.dark = false;
  read_layout(layout, settings, problem);
  EXPECT_EQ(problem, "line 4 makes no sense and is ignored");
  EXPECT_EQ(settings.tab, 4);
  EXPECT_FALSE(settings.dark);
}

TEST_F(PanelSettingsFile, OfNoiseIsIgnoredWithAMessageAndReplaced) {
  std::string noise;
  for (unsigned i = 0; i < 100'000U; ++i) noise += static_cast<char>((i * 7919U) >> 3U);
  write(noise);
  const int told = complaints(path, [](PanelRig& rig) {
    EXPECT_TRUE(rig.model.settings == PanelSettings{});
    rig.tab("Files");
    rig.click("panel/light", 0.1);
  });
  EXPECT_EQ(told, 1);
  EXPECT_FALSE(read().dark);
  EXPECT_EQ(problem, "");
}

TEST_F(PanelSettingsFile, ThatIsAFolderIsSaid) {
  std::filesystem::create_directories(path);
  EXPECT_TRUE(read() == PanelSettings{});
  EXPECT_EQ(problem, "it cannot be read");
}

TEST_F(PanelSettingsFile, ThatCannotBeWrittenIsSaidOnceAndNothingElseHappens) {
  EXPECT_FALSE(write_settings("/proc/nowhere/panel.conf", {}));
  const int told = complaints("/proc/nowhere/panel.conf", [](PanelRig& rig) {
    rig.tab("Files");
    for (int i = 0; i < 4; ++i) {
      rig.click("panel/light", 0.1);
      rig.pictures(200);  // four seconds: it would be saved
    }
  });
  EXPECT_EQ(told, 1);
}

}  // namespace
}  // namespace ambf::render
