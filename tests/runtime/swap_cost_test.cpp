// Models come and go while the world runs, and the physics thread hardly notices: what a change takes of its CPU time,
// and how late its turns are meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <thread>

#include "tests/runtime/model_rig.h"

namespace ambf::runtime {
namespace {

using namespace test;

constexpr double kSwapBar_s = 1e-3 * kTestSlowness;
constexpr const char* kRobots[] = {"robots/blender-psm.yaml", "robots/blender-ecm.yaml", "robots/blender-mtm.yaml",
                                   "robots/blender-pr2.yaml"};

SimulationOptions real_time() {
  SimulationOptions options;
  options.physics_rate_hz = 1000.0;
  return options;
}

TEST(Swap, LoadingRobotsIntoARunningSceneCostsThePhysicsThreadLessThanAMillisecondEach) {
  AMBF_NEEDS_COMPAT();
  ModelRig rig(own_world(), real_time());
  rig.log.expect_warning("gains cannot be stable");  // of the PR2's wrists
  ASSERT_TRUE(rig.load(own_model("puzzles/peg_transfer.yaml")).success);

  // Lateness is measured over the last second: wait until it knows nothing of loading, then look for a while.
  const auto look = [&](double seconds, double& p999, auto&& meanwhile) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    do {
      meanwhile();
      p999 = std::max(p999, rig.frame().run.lateness_p999);
    } while (std::chrono::steady_clock::now() < end);
  };
  const auto idle = [] { std::this_thread::sleep_for(std::chrono::milliseconds(100)); };
  double ignored = 0.0, quiet = 0.0, loading = std::numeric_limits<double>::infinity();
  look(2.5, ignored, idle);
  look(4.0, quiet, idle);

  // Of each the cheapest of some rounds: what other programs take of processors and caches is not the world's.
  std::map<std::string, double> loads, removals;
  const auto note = [](std::map<std::string, double>& of, const std::string& what, double seconds) {
    const auto [at, is_new] = of.emplace(what, seconds);
    if (!is_new) at->second = std::min(at->second, seconds);
  };
  for (int round = 0; round < 3; ++round) {
    std::vector<std::string> models;
    look(1.2, ignored, idle);  // what is seen of the round before
    double latest = 0.0;
    for (const char* file : kRobots) {
      state::Outcome outcome;
      state::LoadRequest request;
      request.path = compat::model(file);
      request.T_world_model.position = {3.0 * static_cast<double>(models.size() + 1), 0.0, 1.0};  // touching nothing
      look(0.0, latest, [&] { outcome = rig.simulation.load_and_wait(request); });
      ASSERT_TRUE(outcome.success) << outcome.message;
      models.push_back(outcome.model);
      ASSERT_GT(outcome.physics_cpu_s, 0.0);
      note(loads, file, outcome.physics_cpu_s);
      std::printf("%-26s in: %.3f ms of the physics thread\n", file, outcome.physics_cpu_s * 1e3);
      look(0.3, latest, idle);
    }
    for (std::size_t i = 0; i < models.size(); ++i) {
      const state::Outcome outcome =
          rig.wait_for([&](state::Completion done) { rig.simulation.unload(models[i], std::move(done)); });
      ASSERT_TRUE(outcome.success) << outcome.message;
      note(removals, kRobots[i], outcome.physics_cpu_s);
    }
    look(1.2, latest, idle);
    loading = std::min(loading, latest);
  }
  const auto dearest_of = [](const std::map<std::string, double>& of) {
    double most = 0.0;
    for (const auto& [what, seconds] : of) most = std::max(most, seconds);
    return most;
  };
  const double dearest = dearest_of(loads), dearest_removal = dearest_of(removals);
  std::printf(
      "dearest load %.3f ms, dearest removal %.3f ms; lateness p99.9 %.3f ms quiet, %.3f ms loading: ratio %.2f\n",
      dearest * 1e3, dearest_removal * 1e3, quiet * 1e3, loading * 1e3, loading / quiet);
  EXPECT_LT(dearest, kSwapBar_s);
  EXPECT_LT(dearest_removal, kSwapBar_s);
  // The bar is 1.5 on a quiet machine; on a shared one only what the loading itself would do can be told from the rest.
  EXPECT_LT(loading, std::max(10.0 * quiet, 20e-3 * kTestSlowness));
  EXPECT_FALSE(rig.frame().run.diverged);
}

// What `ambf-cli tool` and the CRTK's set_tool_type do: the instrument's model goes, another comes.
TEST(Swap, AnExchangeOfAnInstrumentCostsThePhysicsThreadLessThanAMillisecond) {
  ModelRig rig(bare_world(), real_time());
  for (const char* robot : {"robots/psm.yaml", "robots/ecm.yaml"}) ASSERT_TRUE(rig.load(own_model(robot)).success);
  for (const char* part : {"toolgripper1link", "toolgripper2link", "toolpitchlink", "toolrolllink"})
    ASSERT_TRUE(rig.remove(std::string("/ambf/env/psm/") + part).success) << part;
  const std::string folder = std::string(AMBF_SOURCE_DIR) + "/ambf_models/instruments/";
  // Of each the cheapest of some rounds, as above.
  std::map<std::string, double> cost;
  for (int round = 0; round < 2; ++round) {
    for (const char* instrument : {"lnd.yaml", "prograsp.yaml", "maryland.yaml", "scissors.yaml"}) {
      const state::Outcome in = rig.load(folder + instrument);
      ASSERT_TRUE(in.success) << in.message;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      const state::Outcome out =
          rig.wait_for([&](state::Completion done) { rig.simulation.unload(in.model, std::move(done)); });
      ASSERT_TRUE(out.success) << out.message;
      const double spent = in.physics_cpu_s + out.physics_cpu_s;
      const auto [at, is_new] = cost.emplace(instrument, spent);
      at->second = std::min(at->second, spent);
    }
  }
  for (const auto& [instrument, seconds] : cost) {
    std::printf("%-14s out and in: %.3f ms of the physics thread\n", instrument.c_str(), seconds * 1e3);
    EXPECT_LT(seconds, kSwapBar_s) << instrument;
  }
  EXPECT_FALSE(rig.frame().run.diverged);
}

}  // namespace
}  // namespace ambf::runtime
