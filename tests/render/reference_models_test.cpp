// Models written by others, as they stand when loaded, compared with committed pictures of ours
// (tests/render/reference).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reference_picture.h"
#include "still_picture.h"
#include "tests/support/compat_models.h"

namespace ambf::render {
namespace {

class ReferenceModels : public ::testing::Test {
 protected:
  void SetUp() override { AMBF_NEEDS_COMPAT(); }
  static Image take(std::vector<std::string> models) {
    const adf::LaunchResult launch = adf::load_launch((compat::descriptions() / "launch.yaml").string());
    EXPECT_TRUE(launch.launch);
    if (!launch.launch) return {};
    for (std::string& model : models) model = compat::model(model);
    return testing::still_picture(launch, launch.launch->world_file, models, 384, 192);
  }
};

TEST_F(ReferenceModels, PsmEcmMtm) {
  testing::Tolerance small_things;
  small_things.share = 0.002;  // the robots are less than 1 % of the picture, which the usual tolerance would let go
  EXPECT_TRUE(testing::matches_reference(
      take({"robots/blender-psm.yaml", "robots/blender-ecm.yaml", "robots/blender-mtm.yaml"}), "psm_ecm_mtm",
      small_things));
}

TEST_F(ReferenceModels, Puzzle2) { EXPECT_TRUE(testing::matches_reference(take({"puzzles/puzzle2.yaml"}), "puzzle2")); }

TEST_F(ReferenceModels, TexturedGround) {
  EXPECT_TRUE(testing::matches_reference(take({"environments/TexturedGround/env.yaml"}), "textured_ground"));
}

}  // namespace
}  // namespace ambf::render
