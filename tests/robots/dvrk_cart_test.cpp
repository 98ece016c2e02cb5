// The patient cart: the original's names, remote centres where the published kinematics put them, arms that work on it.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "adf/adf.h"
#include "adf/arms.h"
#include "tests/robots/original.h"

namespace ambf::runtime {
namespace {

using namespace test;

TEST(DvrkCart, HasTheNamesOrderTypesAndHomeFramesOfTheOriginal) {
  AMBF_NEEDS_COMPAT();
  const adf::ModelResult own = adf::load_model(own_model("robots/suj.yaml"));
  const adf::ModelResult original = adf::load_model(compat::model("robots/blender-suj.yaml"));
  ASSERT_TRUE(own.model && original.model);
  expect_same_interface(*own.model, *original.model);
}

struct RemoteCentre {
  const char* arm;
  math::Pose T_cart_base;  // published, in the cart's own frame
};
const RemoteCentre kAtSimulated[] = {
    {"ecm", {{0.060079, 1.242143, 0.994177}, {-0.382529, 0.009143, -0.022076, 0.923635}}},
    {"psm1", {{-0.028794, 1.219771, 0.959059}, {-0.003665, -0.123579, -0.451049, 0.883894}}},
    {"psm2", {{0.184255, 1.187734, 0.974224}, {-0.02828, 0.213977, 0.16202, 0.962893}}},
    {"psm3", {{0.212814, 1.22536, 0.911495}, {-0.002784, 0.06794, 0.367142, 0.927676}}},
};
// The published frame of the cart in the original's world.
math::Pose T_world_cart() { return {{}, math::exp({0, 0, -kPi / 2.0})}; }

class DvrkScene : public testing::Test {
 protected:
  DvrkScene() : rig(nothing_else()) {
    const adf::LaunchResult launch = adf::load_launch(own_descriptions() + "launch_dvrk.yaml");
    for (const std::string& file : launch.launch->model_files) files.push_back(file);
  }
  void load(std::size_t first, std::size_t last) {
    for (std::size_t k = first; k <= last; ++k) {
      const state::Outcome loaded = rig.load(files[k]);
      ASSERT_TRUE(loaded.success) << loaded.message;
      ASSERT_TRUE(loaded.diagnostics.empty()) << base::to_string(loaded.diagnostics.front());
    }
  }
  math::Pose base_of(const std::string& arm) { return rig.body("/ambf/env/" + arm + "/BODY base link").T_world_body; }

  ModelRig rig;
  std::vector<std::string> files;
};

// The set-up joints, moved to the published positions, put the mounts where they are published.
TEST(DvrkCart, SetUpJointsMoveTheMountsAsThePublishedKinematicsSay) {
  ModelRig rig(nothing_else());
  ASSERT_TRUE(rig.load(own_model("robots/suj.yaml")).success);
  const std::map<std::string, std::vector<double>> positions = {
      {"ecm", {0.6647, 0.5782, -1.2662, 3.7818, 0.0, 0.0}},
      {"psm1", {0.0007, -0.5892, -0.8590, -0.6241, -0.2479, -0.4422}},
      {"psm2", {0.0628, 0.0913, 1.9073, -0.1297, 0.4351, 0.0353}},
      {"psm3", {-0.0261, -1.5892, 1.3076, 0.6994, 0.1361, 0.3359}}};
  std::vector<std::pair<std::string, double>> targets;
  for (const auto& [arm, q] : positions)
    for (std::size_t k = 0; k < q.size(); ++k) {
      const std::string child = "suj" + arm + "L" + std::to_string(k);
      targets.emplace_back((k == 0 ? "baselink" : "suj" + arm + "L" + std::to_string(k - 1)) + "-" + child, q[k]);
    }
  const auto command = rig.joint_command("BODY base link", state::JointCommandType::position, targets);
  for (int k = 0; k < 30; ++k) ASSERT_TRUE(rig.step(100, {command}).success);
  for (const RemoteCentre& centre : kAtSimulated) {
    const bool is_ecm = std::string(centre.arm) == "ecm";
    const math::Pose T_mount_base{is_ecm ? math::Vec3{0.6126, 0, 0.1016} : math::Vec3{0.4864, 0, 0.1524},
                                  math::exp({0, 0, -kPi / 2.0})};
    const math::Pose wanted = T_world_cart() * centre.T_cart_base;
    const math::Pose is = rig.body(std::string("BODY suj ") + centre.arm + " L5").T_world_body * T_mount_base;
    EXPECT_LT(norm(is.position - wanted.position), 0.05e-3) << centre.arm;
    EXPECT_LT(norm(math::log(math::inverse(is.orientation) * wanted.orientation)), 1e-4) << centre.arm;
  }
}

// PSM3 is turned aside there.
TEST_F(DvrkScene, RemoteCentresAreAndStayWhereThePublishedKinematicsPutThem) {
  load(0, 5);
  for (const double seconds : {0.001, 2.0}) {
    ASSERT_TRUE(rig.run(seconds).success);
    for (const RemoteCentre& centre : kAtSimulated) {
      if (std::string(centre.arm) == "psm3") continue;
      const math::Pose wanted = T_world_cart() * centre.T_cart_base, is = base_of(centre.arm);
      EXPECT_LT(norm(is.position - wanted.position), 0.02e-3) << centre.arm << " after " << seconds << " s";
      EXPECT_LT(norm(math::log(math::inverse(is.orientation) * wanted.orientation)), 1e-4) << centre.arm;
    }
  }
  EXPECT_LT(rig.largest_gap(), 0.02e-3);
}

// What moves on it neither opens a joint nor shakes the cart.
TEST_F(DvrkScene, ArmsMoveOnTheCart) {
  load(0, 9);
  struct Moved {
    math::Pose T_base;
    double yaw, pitch, insertion;
  };
  const std::map<std::string, Moved> arms = {{"psm1", {base_of("psm1"), 0.2, 0.2, 0.1}},
                                             {"psm2", {base_of("psm2"), 0.05, 0.05, 0.1}},
                                             {"psm3", {base_of("psm3"), -0.05, 0.05, 0.1}},
                                             {"ecm", {base_of("ecm"), 0.0, 0.0, 0.05}}};
  for (const auto& [arm, to] : arms) {
    const std::string base = "/ambf/env/" + arm + "/BODY base link";
    const auto command = rig.joint_command(base, state::JointCommandType::position,
                                           {{"baselink-yawlink", to.yaw},
                                            {"yawlink-pitchbacklink", to.pitch},
                                            {"pitchendlink-maininsertionlink", to.insertion}});
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(rig.step(100, {command}).success);
  }
  ASSERT_TRUE(rig.run(1.0).success);
  for (const auto& [arm, to] : arms) {
    EXPECT_LT(norm(base_of(arm).position - to.T_base.position), 0.1e-3) << arm;
    const bool is_ecm = arm == "ecm";
    const std::string tip = "/ambf/env/" + arm + (is_ecm ? "/BODY tool link" : "/BODY tool gripper1 link");
    const kinematics::Arm& model = *adf::known_arms().find(is_ecm ? "ECM" : "PSM");
    std::vector<double> q(model.size(), 0.0);
    q[0] = to.yaw, q[1] = to.pitch, q[2] = to.insertion;
    const math::Vec3 wanted = forward(model, q).position;
    const math::Vec3 in_body{0, 0, is_ecm ? -0.371 : 0.0};
    const math::Vec3 is = math::inverse(base_of(arm)) * (rig.body(tip).T_world_body * in_body);
    EXPECT_LT(norm(is - wanted), 0.2e-3) << arm;
  }
  EXPECT_LT(rig.largest_gap(), 0.05e-3);
}

}  // namespace
}  // namespace ambf::runtime
