// The same inputs give the same simulation, bit for bit: repeated runs, and continuations of snapshots (promises PR5
// and PR6).
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <vector>

#include "simulation_rig.h"

namespace ambf::runtime {
namespace {

using test::Rig;

// Contacts, a closed loop, and commands at given steps; the hash of every step's frame.
std::vector<std::uint64_t> hashes_of(Rig& rig, int blocks, int first_block = 0) {
  std::vector<std::uint64_t> hashes;
  for (int block = first_block; block < first_block + blocks; ++block) {
    std::vector<state::AddressedCommand> commands;
    commands.push_back(test::crank_command(rig, state::JointCommandType::velocity, block % 2 == 0 ? 3.0 : -2.0));
    if (block % 3 == 0) commands.push_back(test::push(rig, "BODY box", {2.0, 1.0 * block, 0.0}));
    EXPECT_TRUE(rig.step(1, std::move(commands)).success);
    hashes.push_back(state::state_hash(rig.frame()));
    for (int i = 1; i < 60; ++i) {
      EXPECT_TRUE(rig.step(1).success);
      hashes.push_back(state::state_hash(rig.frame()));
    }
  }
  return hashes;
}

std::vector<std::uint64_t> run(int blocks) {
  Rig rig;
  EXPECT_TRUE(rig.loaded.success) << rig.loaded.message;
  rig.simulation.set_paused(true);
  rig.simulation.begin();
  return hashes_of(rig, blocks);
}

TEST(Determinism, ThreeRunsAreBitIdenticalInEveryFrame) {
  const std::vector<std::uint64_t> first = run(12);
  EXPECT_EQ(run(12), first);
  EXPECT_EQ(run(12), first);
  EXPECT_NE(first.front(), first.back());
}

TEST(Determinism, ContinuingAfterARestoreEqualsContinuingAfterTheSnapshot) {
  const std::string file = testing::TempDir() + "determinism_test.ambfstate";
  std::vector<std::uint64_t> after_snapshot;
  {
    Rig rig;
    rig.simulation.set_paused(true);
    rig.simulation.begin();
    hashes_of(rig, 5);
    const state::Outcome taken =
        rig.wait_for([&](state::Completion done) { rig.simulation.snapshot("a", file, std::move(done)); });
    ASSERT_TRUE(taken.success) << taken.message;
    after_snapshot = hashes_of(rig, 5, 5);
    const state::Outcome restored =
        rig.wait_for([&](state::Completion done) { rig.simulation.restore("a", "", std::move(done)); });
    ASSERT_TRUE(restored.success) << restored.message;
    EXPECT_EQ(restored.sim_step, taken.sim_step);
    EXPECT_EQ(hashes_of(rig, 5, 5), after_snapshot) << "in the same simulation";
  }
  Rig fresh;
  fresh.simulation.set_paused(true);
  fresh.simulation.begin();
  const state::Outcome restored =
      fresh.wait_for([&](state::Completion done) { fresh.simulation.restore("", file, std::move(done)); });
  ASSERT_TRUE(restored.success) << restored.message;
  EXPECT_EQ(hashes_of(fresh, 5, 5), after_snapshot) << "in a fresh simulation";
  std::filesystem::remove(file);
}

TEST(Determinism, ASnapshotOfAnotherSceneIsRefused) {
  Rig rig;
  rig.simulation.begin();
  rig.wait_for([&](state::Completion done) { rig.simulation.snapshot("here", "", std::move(done)); });
  ASSERT_TRUE(rig.load(test::kScene).success);
  const state::Outcome outcome =
      rig.wait_for([&](state::Completion done) { rig.simulation.restore("here", "", std::move(done)); });
  EXPECT_FALSE(outcome.success);
  EXPECT_FALSE(outcome.message.empty());
}

}  // namespace
}  // namespace ambf::runtime
