// A public suite of scenes made for the third generation of the original: every body loads, and nothing of it is an
// error but a mesh that is in no folder.
#include <filesystem>

#include "adf/check.h"
#include "tests/adf/support.h"
#include "tests/support/compat_models.h"

namespace ambf::adf {
namespace {

class ThirdGeneration : public ::testing::Test {
 protected:
  void SetUp() override { AMBF_NEEDS_THIRD_GENERATION(); }
  std::string file(const std::string& name) const { return (compat::third_generation() / "ADF" / name).string(); }
};

TEST_F(ThirdGeneration, EveryBodyAndJointLoads) {
  const std::tuple<const char*, std::size_t, std::size_t> expected[] = {{"Phantoms/Simple/phantom.yaml", 53, 48},
                                                                        {"PSMs/LND_400006_SIMPLE/psm1.yaml", 10, 8},
                                                                        {"PSMs/LND_400006_SIMPLE/psm2.yaml", 10, 8}};
  for (const auto& [name, bodies, joints] : expected) {
    const ModelResult result = load_model(file(name));
    ASSERT_TRUE(result.model) << name;
    EXPECT_EQ(result.model->bodies.size(), bodies) << name;
    EXPECT_EQ(result.model->joints.size(), joints) << name;
    EXPECT_FALSE(base::has_errors(result.diagnostics)) << all_of(result.diagnostics);
  }
}

TEST_F(ThirdGeneration, OnlyABodyThatIsListedTwiceIsAWarningOfThePhantom) {
  const base::Diagnostics diagnostics = check_file(file("Phantoms/Simple/phantom.yaml"));
  EXPECT_EQ(count(diagnostics, base::Severity::warning), 1u) << all_of(diagnostics);
  EXPECT_TRUE(says(diagnostics, "phantom.yaml:58:3: warning: \\[BODY BlackGround\\] listed twice in `bodies`"));
}

TEST_F(ThirdGeneration, OfTheWorldOnlyTheMeshOfTheFloorIsMissing) {
  const base::Diagnostics diagnostics = check_file(file("world/world_stereo_test.yaml"));
  EXPECT_EQ(count(diagnostics, base::Severity::error), 1u) << all_of(diagnostics);
  EXPECT_EQ(count(diagnostics, base::Severity::warning), 0u) << all_of(diagnostics);
  EXPECT_TRUE(says(diagnostics, "error: \\[BODY Plane: mesh\\] visual mesh not found"));
}

TEST_F(ThirdGeneration, AllOtherFilesAreWithoutErrors) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(compat::third_generation())) {
    if (entry.path().extension() != ".yaml") continue;
    for (const base::Diagnostic& found : check_file(entry.path().string())) {
      const bool is_floor = found.file.ends_with("checkered_floor.yaml") && found.key == "mesh";
      EXPECT_TRUE(found.severity != base::Severity::error || is_floor) << base::to_string(found);
    }
  }
}

}  // namespace
}  // namespace ambf::adf
