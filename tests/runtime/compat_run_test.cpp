// Models written by others run: each loads with what is promised for it, has all its bodies and joints, and is finite
// and bounded after 20 s. The models are found by AMBF_COMPAT_DIR (default ../shared/compat); absent, the tests are
// skipped visibly (in CI they fail).
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "adf/adf.h"
#include "simulation_rig.h"
#include "tests/support/compat_models.h"

namespace ambf::runtime {
namespace {

namespace fs = std::filesystem;

// Files that are wrong on purpose, or are no models: tested elsewhere.
bool is_runnable_model(const fs::path& file) {
  if (file.extension() != ".yaml") return false;
  const std::string path = file.string();
  for (const char* other : {"/world/", "/color/", "/input_devices/", "launch.yaml", "compound_example.yaml"}) {
    if (path.find(other) != std::string::npos) return false;
  }
  return true;
}

std::vector<fs::path> models() {
  std::vector<fs::path> files;
  std::error_code absent;
  for (const auto& entry : fs::recursive_directory_iterator(compat::folder(), absent)) {
    if (is_runnable_model(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) files.emplace_back("absent");
  return files;
}

class CompatModel : public testing::TestWithParam<fs::path> {
 protected:
  void SetUp() override { AMBF_NEEDS_COMPAT(); }
};

TEST_P(CompatModel, RunsForTwentySecondsFiniteAndBounded) {
  const std::string path = GetParam().string();
  const adf::ModelResult parsed = adf::load_model(path);
  ASSERT_TRUE(parsed.model.has_value());

  const adf::WorldResult world = adf::load_world((compat::descriptions() / "world/world.yaml").string());
  ASSERT_TRUE(world.world.has_value());
  base::Log log;
  Simulation simulation(test::free_running(), *world.world, {}, log);
  const std::size_t bodies_before = simulation.structure()->bodies.size();
  const std::size_t joints_before = simulation.structure()->joints.size();
  state::LoadRequest request;
  request.path = path;
  const state::Outcome outcome = simulation.load_and_wait(request);
  ASSERT_TRUE(outcome.success) << outcome.message;
  const auto structure = simulation.structure();
  EXPECT_EQ(structure->bodies.size() - bodies_before, parsed.model->bodies.size());
  EXPECT_EQ(structure->joints.size() - joints_before, parsed.model->joints.size());

  const std::unique_ptr<state::FrameReader> reader = simulation.make_reader();
  simulation.set_paused(true);  // only the steps asked for
  simulation.begin();
  const auto ticket = simulation.step(20'000, {}, false);
  while (!ticket->wait(std::chrono::seconds(1))) continue;
  const state::Outcome& stepped = ticket->outcome();
  EXPECT_TRUE(stepped.success) << stepped.message;
  const state::Frame& frame = *reader->latest();
  EXPECT_EQ(frame.sim_step, 20'000u);
  EXPECT_FALSE(frame.run.diverged);
  for (std::size_t slot = 0; slot < frame.bodies.size(); ++slot) {
    const std::string& name = structure->objects[structure->bodies[slot].object].name;
    const state::BodyState& body = frame.bodies[slot];
    ASSERT_TRUE(math::is_finite(body.T_world_body)) << name;
    // What falls past the floor falls 2 km in 20 s; nothing is thrown.
    EXPECT_LT(math::norm(body.T_world_body.position), 2100.0) << name;
    EXPECT_LT(math::norm(body.twist_world.linear), 250.0) << name;
    EXPECT_LT(math::norm(body.twist_world.angular), 500.0) << name;
  }
  // Nothing that a real world holds is taken for damage.
  const auto outcome_of = [](auto start) {
    std::promise<state::Outcome> promise;
    start([&](const state::Outcome& o) { promise.set_value(o); });
    return promise.get_future().get();
  };
  const auto kept = outcome_of([&](auto answered) { simulation.snapshot("end", "", answered); });
  EXPECT_TRUE(kept.success) << kept.message;
  const auto restored = outcome_of([&](auto answered) { simulation.restore("end", "", answered); });
  EXPECT_TRUE(restored.success) << restored.message;
}

INSTANTIATE_TEST_SUITE_P(Files, CompatModel, testing::ValuesIn(models()),
                         [](const testing::TestParamInfo<fs::path>& parameter) {
                           std::string name = parameter.param.parent_path().filename().string() + "_" +
                                              parameter.param.stem().string();
                           std::replace_if(
                               name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace ambf::runtime
