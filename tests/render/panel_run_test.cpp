// Running, resetting, loading and remembering from the panel, and what the simulation makes of it.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "panel_rig.h"
#include "render/panel/relations.h"
#include "render/panel/start_options.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

// --- 1: run control.

TEST(Panel, PausesAndRuns) {
  PanelRig rig;
  ASSERT_TRUE(rig.rig.frame().run.paused);
  rig.click("run/pause");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return !frame.run.paused; }));
  rig.click("run/pause");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.run.paused; }));
}

TEST(Panel, StepsOnceAndManyTimesAndBack) {
  PanelRig rig;
  const std::uint32_t start = rig.rig.frame().sim_step;
  rig.click("run/step");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == start + 1; }));
  const math::Pose before = rig.rig.body("BODY lower").T_world_body;
  rig.enter("run/steps", "25");
  rig.click("run/step_n");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == start + 26; }));
  rig.click("run/back");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == start + 1; }));
  EXPECT_TRUE(rig.rig.body("BODY lower").T_world_body == before);
  rig.click("run/back");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == start; }));
  EXPECT_FALSE(rig.model.run.can_step_back());
}

TEST(Panel, SetsTheSpeed) {
  PanelRig rig;
  rig.enter("run/speed", "0.5");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.run.speed_factor == 0.5; }));
}

// --- 2: resets and snapshots.

TEST(Panel, ResetsTheWorldAndWhatWasHeld) {
  PanelRig rig;
  rig.tab("Joints");
  rig.drag("joint/shoulder", 0.5, 0.9);
  rig.run(100);
  ASSERT_TRUE(rig.model.held.any());
  rig.click("run/reset");
  EXPECT_TRUE(rig.until([](const state::Frame& frame) { return frame.sim_step == 0; }));
  EXPECT_FALSE(rig.model.held.any());
}

TEST(Panel, ResetsOneBodyWithItsMechanism) {
  PanelRig rig;
  state::Push push;
  push.force_world = {3, 0, 0};
  push.seconds = 0.2;
  rig.model.run.push(rig.rig.id("BODY box"), push);
  rig.model.run.push(rig.rig.id("BODY lower"), push);
  rig.run(400);
  const double box = rig.rig.body("BODY box").T_world_body.position.x;
  rig.model.selection.select(rig.rig.id("BODY lower"));
  EXPECT_EQ(mechanism_of(rig.model.structure(), rig.rig.id("BODY lower")).size(), 2u)
      << "upper and lower; the base is static";
  rig.pictures(2);
  rig.click("object/reset");
  EXPECT_TRUE(rig.until([&](const state::Frame& frame) {
    return frame.joints[rig.slot("elbow", state::ObjectKind::joint)].velocity == 0.0;
  }));
  EXPECT_NEAR(rig.rig.body("BODY lower").T_world_body.position.x, 0.0, 1e-9);
  EXPECT_EQ(rig.rig.body("BODY box").T_world_body.position.x, box);
}

TEST(Panel, TakesAndRestoresSnapshots) {
  PanelRig rig;
  rig.tab("Files");
  rig.click("snapshot/name");
  rig.type("here");
  rig.click("snapshot/take");
  ASSERT_TRUE(rig.rig.wait_until([&](const state::Frame&) { return !rig.model.run.snapshots().empty(); }));
  EXPECT_EQ(rig.model.run.snapshots(), std::vector<std::string>{"here"});
  const std::uint32_t step = rig.rig.frame().sim_step;
  rig.run(60);
  ASSERT_GT(rig.rig.frame().sim_step, step);
  rig.click("snapshot/restore/here");
  EXPECT_TRUE(rig.until([&](const state::Frame& frame) { return frame.sim_step == step; }));
  rig.click("snapshot/forget/here");
  EXPECT_TRUE(rig.until([&](const state::Frame&) { return rig.model.run.snapshots().empty(); }));
}

// --- 24: loading.

TEST(Panel, LoadsAFileAndRemembersIt) {
  const auto folder = std::filesystem::temp_directory_path() / "ambf_panel_test";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "ball.yaml").string(), settings = (folder / "panel.conf").string();
  std::filesystem::remove(settings);
  std::ofstream(file)
      << "bodies: [BODY ball]\nnamespace: /test/\nBODY ball: {name: ball, mass: 1, collision shape: SPHERE, "
         "collision geometry: {radius: 0.1}, location: {position: {x: 0, y: 0, z: 5}, orientation: {r: 0, p: 0, "
         "y: 0}}}\n";
  {
    PanelRig rig(settings);
    rig.tab("Files");
    rig.click("load/path");
    rig.type(file.substr(0, file.size() - 6));
    rig.pictures(2);
    ASSERT_TRUE(rig.shown("load/complete/" + file)) << "offers what begins so";
    rig.click("load/complete/" + file);
    rig.click("load/go");
    EXPECT_TRUE(rig.until([&](const state::Frame& frame) {
      return state::find(*frame.structure, "BODY ball", state::ObjectKind::rigid_body) != state::kNone;
    }));
    ASSERT_TRUE(rig.shown("models/unload/ball.yaml"));
    rig.click("models/unload/ball.yaml");
    EXPECT_TRUE(rig.until([&](const state::Frame& frame) {
      return state::find(*frame.structure, "BODY ball", state::ObjectKind::rigid_body) == state::kNone;
    }));
  }
  std::string problem;
  EXPECT_EQ(read_settings(settings, problem).recent_files, std::vector<std::string>{file});
  std::filesystem::remove_all(folder);
}

TEST(Panel, SavesTheSceneAndOneModel) {
  const auto folder = std::filesystem::temp_directory_path() / "ambf_panel_saving_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "ball.yaml").string();
  std::ofstream(file) << "bodies: [BODY ball]\nnamespace: /test/\nBODY ball: {name: ball, mass: 1}\n";
  PanelRig rig;
  rig.tab("Files");
  rig.model.edit.load(file, "");
  ASSERT_TRUE(rig.until([&](const state::Frame& frame) {
    return state::find(*frame.structure, "BODY ball", state::ObjectKind::rigid_body) != state::kNone;
  }));
  rig.click("models/save/ball.yaml");
  rig.click("save/path");
  rig.type((folder / "saved.yaml").string());
  rig.click("save/model");
  EXPECT_TRUE(rig.until([&](const state::Frame&) { return std::filesystem::exists(folder / "saved.yaml"); }));
  rig.click("save/folder");
  rig.type((folder / "scene").string());
  rig.click("save/now");  // as it was read
  rig.click("save/scene");
  EXPECT_TRUE(rig.until([&](const state::Frame&) {
    std::error_code not_yet;
    const std::filesystem::directory_iterator files(folder / "scene", not_yet);
    // Done once the folder in which it was made is gone.
    return std::filesystem::exists(folder / "scene/launch.yaml") && std::distance(begin(files), end(files)) == 3;
  }));
  EXPECT_TRUE(std::filesystem::exists(folder / "scene/models/ball.yaml"));
  std::filesystem::remove_all(folder);
}

// --- 18: what is not live is shown with how it is set.

TEST(Panel, ShowsWhatIsSetAtTheStartAndByWhat) {
  PanelRig rig;
  rig.tab("Physics");
  const std::vector<StartOption> options = start_options(rig.rig.frame().run);
  ASSERT_EQ(options.size(), 4u);
  for (const StartOption& option : options) {
    EXPECT_TRUE(rig.shown(std::string("start/") + option.label)) << option.label;
    EXPECT_FALSE(option.value.empty()) << option.label;
  }
  EXPECT_EQ(options[0].value, "1 ms");
  EXPECT_EQ(options[1].value, "bound to the clock");
  EXPECT_EQ(options[3].value, rig.rig.frame().run.solver);
  // The flags that it names are there.
  std::ifstream page(std::string(AMBF_SOURCE_DIR) + "/docs/cli.md");
  const std::string cli((std::istreambuf_iterator<char>(page)), std::istreambuf_iterator<char>());
  for (const std::string flag : {options[0].set_by, options[1].set_by, options[3].set_by}) {
    EXPECT_NE(cli.find("`" + flag), std::string::npos) << flag;
  }
}

}  // namespace
}  // namespace ambf::render
