// Table 6.2 and Fig. 6.9 beyond one pair of jaws and a box: meshes are held, and two grippers hold one object.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/model/resistive.h"

namespace ambf::model {
namespace {

using namespace test;

// Of Table 6.2; each ray presses with half its stiffness.
constexpr double kStick = 1000.0, kArea = 0.001, kMass = 0.4;

// A prism of eight sides about y, 0.1 m across and long, with its frame in the middle.
std::string prism() {
  const std::string file = ::testing::TempDir() + "/prism.obj";
  std::ofstream out(file);
  constexpr int kSides = 8;
  const double radius = 0.05 / std::cos(3.14159265358979 / kSides);
  for (const double y : {-0.05, 0.05})
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * 3.14159265358979 * (k + 0.5) / kSides;
      out << "v " << radius * std::cos(angle) << " " << y << " " << radius * std::sin(angle) << "\n";
    }
  for (int k = 1; k <= kSides; ++k) {
    const int next = k % kSides + 1;
    out << "f " << k << " " << k + kSides << " " << next << "\nf " << next << " " << k + kSides << " " << next + kSides
        << "\n";
    if (k > 1 && k < kSides)
      out << "f 1 " << k << " " << next << "\nf " << kSides + 1 << " " << next + kSides << " " << k + kSides << "\n";
  }
  return file;
}

// `pairs` of static jaws along y, each with `elements` rays; together they bear `share` of the weight.
double slip(int pairs, double share, const std::string& object) {
  const int elements = 12;
  const Numbers n{.stick = kStick,
                  .damping = 0.1,
                  .slide = 0.5,
                  .area = kArea,
                  .stiffness = 2.0 * share * kMass * kGravity / (elements * pairs),
                  .contact_damping = 5.0};
  std::string text = object, sensors;
  for (int pair = 0; pair < pairs; ++pair) {
    const double y = pairs == 1 ? 0.0 : 0.05 * (pair - 0.5);
    for (const double side : {-1.0, 1.0}) {
      const std::string name = (side < 0.0 ? "l" : "r") + std::to_string(pair);
      text += box(name, 0.0, {0.11 * side, y, 0}, {0.1, 0.04, 0.1});
      std::vector<math::Vec3> starts;
      for (const math::Vec3& p : grid(elements / 4, 2, 0.03, 0.0)) starts.push_back({-0.05 * side, p.x, 0.4 * p.y});
      text += sensor("s" + name, name, starts, {-side, 0, 0}, n);
      sensors += (sensors.empty() ? "SENSOR s" : ", SENSOR s") + name;
    }
  }
  ResistiveWorld world(text, sensors);
  world.load_slowly({0, 0, -kGravity}, 0.5);
  world.rig.step(share > 1.0 ? 10000 : 500);
  return -world.at("b").z;
}

TEST(ResistiveGrasps, TwoGrippersBearWhatNeitherBearsAlone) {
  const std::string object = box("b", kMass, {0, 0, 0}, {0.1, 0.1, 0.1});
  EXPECT_LT(slip(2, 4.0 / 3.0, object), kArea);
  EXPECT_GT(slip(1, 2.0 / 3.0, object), 0.01) << "half of them";
  EXPECT_GT(slip(2, 2.0 / 3.0, object), 0.01);
}

TEST(ResistiveGrasps, HoldMeshesAsTheyHoldBoxes) {
  const std::string object = "BODY b: {name: b, mass: 0.4, mesh: '" + prism() +
                             "', collision mesh type: CONCAVE_MESH, friction: {static: 0, rolling: 0}, damping: "
                             "{linear: 0, angular: 0}}\n";
  EXPECT_LT(slip(1, 4.0 / 3.0, object), kArea);
  EXPECT_GT(slip(1, 2.0 / 3.0, object), 0.01);
}

}  // namespace
}  // namespace ambf::model
