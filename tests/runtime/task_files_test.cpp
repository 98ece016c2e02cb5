// Task blocks of files: what is wrong with one is said with its line and column, the task is left out, and the rest
// runs.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "adf/adf.h"
#include "model/dry_load.h"
#include "runtime/local_simulation.h"
#include "state/tasks.h"
#include "tests/runtime/simulation_rig.h"

namespace ambf::runtime {
namespace {

const std::string kScene = R"(bodies: [BODY board, BODY piece, BODY hand, BODY second]
tasks: [TASK good, TASK bad]
namespace: /test/
BODY board: {name: board, mass: 0}
BODY piece: {name: piece, mass: 0}
BODY hand: {name: hand, mass: 0}
BODY second: {name: second, mass: 0}
TASK good: {name: good, goals: [{piece: BODY piece, position tolerance: 0.01}]}
TASK bad:
  name: bad
)";

struct Wrong {
  const char* task;
  int line;
  const char* key;
  const char* message;
};

// The first line of a task is 11.
constexpr Wrong kWrong[] = {
    {"  goals: [{piece: BODY peice, position tolerance: 0.01}]\n", 11, "goals[0]/piece",
     "there is no body \"BODY peice\""},
    {"  goals:\n  - {piece: BODY piece, place: BODY bord, position tolerance: 0.01}\n", 12, "goals[0]/place",
     "there is no object \"BODY bord\""},
    {"  goals:\n  - {piece: BODY piece, position tolerance: 0.01}\n  - {piece: BODY piece, sensor: SENSOR x}\n", 13,
     "goals[1]/sensor", "there is no sensor \"SENSOR x\""},
    {"  parent: BODY nothing\n  goals: [{piece: BODY piece, position tolerance: 0.01}]\n", 11, "parent",
     "there is no object \"BODY nothing\""},
    {"  holders: [BODY hand, BODY hand]\n  goals: [{piece: BODY piece, position tolerance: 0.01}]\n", 11, "holders",
     "'BODY hand' is listed twice"},
    {"  holders: [BODY hand, hand]\n  goals: [{piece: BODY piece, position tolerance: 0.01}]\n", 11, "holders",
     "\"hand\" is there twice"},
    {"  holders: [BODY gone]\n  goals: [{piece: BODY piece, position tolerance: 0.01}]\n", 11, "holders",
     "there is no body \"BODY gone\""},
    {"  avoid: [BODY gone]\n  goals: [{piece: BODY piece, position tolerance: 0.01}]\n", 11, "avoid",
     "there is no body \"BODY gone\""},
    {"  goals:\n  - {piece: BODY piece, position tolerance: 0.01, hold: -1}\n", 12, "goals[0]/hold",
     "expected a number of at least 0, found the number -1"},
    {"  goals:\n  - {piece: BODY piece, position tolerance: -0.01}\n", 12, "goals[0]/position tolerance",
     "expected a number of at least 0, found the number -0.01"},
    {"  goals:\n  - {name: a, piece: BODY piece, position tolerance: 0.01}\n"
     "  - {name: a, piece: BODY board, position tolerance: 0.01}\n",
     13, "goals[1]/name", "another goal is called 'a', too"},
    {"  goals:\n  - {piece: BODY piece}\n", 12, "goals[0]/position tolerance", "missing, and so is `sensor`"},
    {"  goals:\n  - {position tolerance: 0.01}\n", 12, "goals[0]/piece", "missing"},
    {"  goals:\n  - {piece: BODY piece, pieces: [BODY board], position tolerance: 0.01}\n", 12, "goals[0]/piece",
     "given, and so are `pieces`"},
    {"  goals: []\n", 11, "goals", "expected 1 to 64, found 0"},
    {"  holders: [BODY hand]\n  goals:\n  - {piece: BODY hand, position tolerance: 0.01}\n", 13, "goals[0]/piece",
     "'BODY hand' is a holder"},
    {"  goals:\n  - {piece: BODY piece, position tolerance: 0.01, held by: BODY hand}\n", 12, "goals[0]/held by",
     "'BODY hand' is no holder of this task"},
    {"  holders: [BODY hand]\n  goals:\n  - {piece: BODY piece, position tolerance: 0.01, hand over: true}\n", 13,
     "goals[0]/hand over", "there are fewer than two `holders`"},
    {"  goals:\n  - {piece: BODY piece, position tolerance: 0.01, axis: {x: 0, y: 0, z: 1}}\n", 12, "goals[0]/axis",
     "there is no `angle tolerance`"},
    {"  order: backwards\n  goals: [{piece: BODY piece, position tolerance: 0.01}]\n", 11, "order", "backwards"},
    {"  drop height: 0\n  goals: [{piece: BODY piece, position tolerance: 0.01}]\n", 11, "drop height",
     "expected a number above 0"},
};

TEST(TaskFiles, WhatIsWrongIsSaidWithItsPlaceAndTheRestRuns) {
  for (const Wrong& wrong : kWrong) {
    JudgedLog log;
    LocalSimulation simulation(test::free_running(), test::empty_world(), {}, log);
    state::LoadRequest request;
    request.text = kScene + wrong.task;
    const state::Outcome outcome = simulation.load(request);
    ASSERT_TRUE(outcome.success) << wrong.task;
    std::string all;
    bool found = false;
    for (const base::Diagnostic& each : outcome.diagnostics) {
      all += base::to_string(each) + "\n";
      found |= each.severity == base::Severity::error && each.line == wrong.line && each.column > 0 &&
               each.block == "TASK bad" && each.key == wrong.key &&
               each.message.find(wrong.message) != std::string::npos;
    }
    EXPECT_TRUE(found) << wrong.task << "found:\n" << all;
    const auto& tasks = state::tasks(*simulation.structure());
    ASSERT_EQ(tasks.size(), 1U) << wrong.task;
    EXPECT_TRUE(simulation.step(3));
    EXPECT_TRUE(state::rows(simulation.frame(), state::task_kind().column)[0].success) << "the good one goes on";
    while (true) {
      base::LogRecord record;
      if (!log.take(record)) break;
    }
  }
}

TEST(TaskFiles, ACheckKnowsMissingBodiesAndLeavesFilesOfTasksAloneInPeace) {
  const auto errors = [](const std::string& text) {
    const adf::ModelResult result = adf::parse_model(text, "tasks.yaml", {});
    EXPECT_TRUE(result.model.has_value());
    int count = 0;
    if (result.model)
      for (const base::Diagnostic& each : model::dry_load(*result.model))
        count += each.severity == base::Severity::information ? 0 : 1;
    return count;
  };
  EXPECT_EQ(errors(kScene + "  goals: [{piece: BODY piece, position tolerance: 0.01}]\n"), 0);
  EXPECT_EQ(errors(kScene + "  goals: [{piece: BODY absent, position tolerance: 0.01}]\n"), 1);
  EXPECT_EQ(errors("tasks: [TASK t]\nnamespace: /test/\n"
                   "TASK t: {name: t, goals: [{piece: BODY elsewhere, position tolerance: 0.01}]}\n"),
            0)
      << "its scene is in another file";
}

TEST(TaskFiles, ATaskOfAFileOfItsOwnFindsTheScene) {
  JudgedLog log;
  LocalSimulation simulation(test::free_running(), test::empty_world(), {}, log);
  state::LoadRequest scene, task;
  scene.text = kScene + "  goals: [{piece: BODY piece, position tolerance: 0.01}]\n";
  ASSERT_TRUE(simulation.load(scene).success);
  task.text =
      "tasks: [TASK t]\nnamespace: /test/\nTASK t: {name: t, goals: [{piece: BODY second, position "
      "tolerance: 0.01}]}\n";
  const state::Outcome outcome = simulation.load(task);
  ASSERT_TRUE(outcome.success);
  ASSERT_EQ(state::tasks(*simulation.structure()).size(), 3U);
  ASSERT_TRUE(simulation.step(2));
  EXPECT_EQ(state::task_lines(simulation.frame())[2], "t: done in 0:00");
  ASSERT_TRUE(simulation.unload(outcome.model).success);
  EXPECT_EQ(state::tasks(*simulation.structure()).size(), 2U);
}

TEST(TaskFiles, OursLoadAfterTheirScenesAndBeginUndone) {
  const std::string models = std::string(AMBF_SOURCE_DIR) + "/ambf_models/", tasks = models + "descriptions/tasks/";
  const std::string ours = models + "descriptions/multi-bodies/", suturing = models + "suturing/";
  const std::vector<std::pair<std::string, std::vector<std::string>>> scenes = {
      {"any_peg.yaml", {ours + "puzzles/peg_transfer.yaml"}},
      {"needle_board.yaml", {ours + "puzzles/peg_transfer.yaml"}},
      {"peg_transfer.yaml", {ours + "puzzles/peg_transfer.yaml"}},
      {"screwdriver.yaml", {ours + "touch/screwdriver.yaml"}},
      {"ring_wire.yaml", {}},
      {"tissue_retract.yaml", {}},
      {"puzzle1.yaml", {models + "studies/puzzle1.yaml"}},
      {"puzzle2.yaml", {models + "studies/puzzle2.yaml"}},
      {"four_hands.yaml", {models + "studies/puzzle1.yaml", models + "studies/four_hands.yaml"}},
      {"screwdriver_env.yaml", {models + "studies/screwdriver_env.yaml"}},
      {"needle_drive.yaml", {ours + "robots/psm.yaml"}},
      {"puzzle4.yaml", {models + "studies/puzzle4.yaml"}},
      {"puzzle5.yaml", {models + "studies/puzzle5.yaml"}},
      {"needle.yaml", {suturing + "phantom.yaml", suturing + "psm1.yaml", suturing + "psm2.yaml"}},
  };
  for (const auto& [file, before] : scenes) {
    JudgedLog log;
    log.allow("");  // what the scenes say is theirs
    LocalSimulation simulation(test::free_running(), test::empty_world(), {}, log);
    for (const std::string& scene : before) {
      state::LoadRequest request;
      request.path = scene;
      ASSERT_TRUE(simulation.load(request).success) << scene;
    }
    state::LoadRequest request;
    request.path = tasks + file;
    const state::Outcome outcome = simulation.load(request);
    EXPECT_TRUE(outcome.success) << file;
    for (const base::Diagnostic& each : outcome.diagnostics)
      if (each.block.starts_with("TASK")) ADD_FAILURE() << base::to_string(each);
    ASSERT_TRUE(simulation.step(20));
    const auto& states = state::rows(simulation.frame(), state::task_kind().column);
    EXPECT_GE(states.size(), 1U) << file;
    for (const state::TaskState& task : states) EXPECT_EQ(task.goals_done, 0U) << file;
  }
}

}  // namespace
}  // namespace ambf::runtime
