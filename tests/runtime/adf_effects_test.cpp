// Every key of bodies and joints does something: the same scene with and without the key, simulated, must differ by
// what the key promises. Joints that are free in several directions, and springs: adf_wide_joints_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "adf_effects.h"
#include "math/rotation.h"

namespace ambf::runtime::test {
namespace {

const std::string kCube = "mass: 1, collision shape: BOX, collision geometry: {x: 0.2, y: 0.2, z: 0.2}";
const std::string kBall = "mass: 1, collision shape: SPHERE, collision geometry: {radius: 0.1}";

// One body above an inclined floor, whose keys may be given too; `header` are keys of the file.
std::string drop(const std::string& body, double height, double incline = 0.0, const std::string& floor = "",
                 const std::string& header = "") {
  return header +
         "bodies: [FLOOR, BODY A]\nFLOOR: {name: floor, mass: 0, collision shape: BOX, collision geometry: {x: 8, y: "
         "8, z: "
         "0.2}, " +
         floor + at(0, 0.1 * std::sin(incline), -0.1 * std::cos(incline), incline) + "}\nBODY A: {name: a, " + body +
         ", " + at(0, 0, height, incline) + "}\n";
}

double height(Rig& rig) { return place(rig, "BODY A").position.z; }
double slid(Rig& rig) { return math::norm(place(rig, "BODY A").position) > 0.3 ? 1.0 : 0.0; }
double angle(Rig& rig) { return rig.frame().joints.at(0).position; }

std::vector<state::AddressedCommand> turn(Rig& rig) {
  state::RigidBodyCommand command;
  command.type = state::CartesianCommandType::force;
  command.wrench_world.torque = {0, 0, 0.01};
  return {{rig.id("BODY A"), command}};
}

std::vector<state::AddressedCommand> bend(Rig& rig) {
  state::RigidBodyCommand command;
  command.joints = {{state::JointCommandType::position, -0.4}};
  return {{rig.id("FRAME"), command}};
}

std::vector<state::AddressedCommand> hold(Rig& rig) {
  state::RigidBodyCommand command;
  command.joints = {{state::JointCommandType::position, 0.0}};
  return {{rig.id("FRAME"), command}};
}

TEST(AdfEffects, GravityMassAndInertia) {
  const double fallen = -0.5 * 9.81 * 0.1 * 0.101;  // 0.1 s of semi-implicit steps
  const auto spin = [](Rig& rig) { return rig.body("BODY A").twist_world.angular.z; };
  expect_effects({
      {"gravity of a body", drop(kCube, 3), drop(kCube + ", gravity: {x: 0, y: 0, z: 9.81}", 3), 100, height,
       3 + fallen, 3 - fallen, 1e-3},
      {"gravity of a file", drop(kCube, 3), drop(kCube, 3, 0, "", "gravity: {x: 0, y: 0, z: 0}\n"), 100, height,
       3 + fallen, 3, 1e-3},
      {"gravity of a body goes before the file's", drop(kCube, 3, 0, "", "gravity: {x: 0, y: 0, z: 0}\n"),
       drop(kCube + ", gravity: {x: 0, y: 0, z: 9.81}", 3, 0, "", "gravity: {x: 0, y: 0, z: 0}\n"), 100, height, 3,
       3 - fallen, 1e-3},
      {"mass", drop(kCube, 3), drop("mass: 0, collision shape: BOX, collision geometry: {x: 1, y: 1, z: 1}", 3), 100,
       height, 3 + fallen, 3, 1e-3},
      // 0.01 Nm for 0.1 s
      {"inertia", drop(kCube + ", inertia: {ix: 0.01, iy: 0.01, iz: 0.01}", 3),
       drop(kCube + ", inertia: {ix: 0.01, iy: 0.01, iz: 0.04}", 3), 100, spin, 0.1, 0.025, 2e-3, turn},
  });
}

TEST(AdfEffects, SurfaceAndDamping) {
  const auto speed = [](Rig& rig) { return math::norm(rig.body("BODY A").twist_world.linear); };
  const auto spin = [](Rig& rig) { return rig.body("BODY A").twist_world.angular.z; };
  // v(t) = g / k (1 - e^-kt), k = -ln(1 - damping)
  const auto after = [](double damping, double acceleration, double t) {
    const double k = -std::log(1.0 - damping);
    return acceleration / k * (1.0 - std::exp(-k * t));
  };
  const std::string rough = "friction: {static: 1, rolling: 0}, restitution: 1, ";
  const std::string inertia = ", inertia: {ix: 0.01, iy: 0.01, iz: 0.01}";
  expect_effects({
      {"damping/linear", drop(kCube, 20), drop(kCube + ", damping: {linear: 0.9, angular: 0.1}", 20), 1000, speed,
       after(0.04, 9.81, 1), after(0.9, 9.81, 1), 0.02},
      {"damping/angular", drop(kCube + inertia, 20),
       drop(kCube + inertia + ", damping: {linear: 0.04, angular: 0.9}", 20), 400, spin, after(0.1, 1, 0.4),
       after(0.9, 1, 0.4), 0.01, turn},
      {"friction/static", drop(kCube + ", friction: {static: 1, rolling: 0}, restitution: 0", 0.1, 0.3, rough),
       drop(kCube + ", friction: {static: 0, rolling: 0}, restitution: 0", 0.1, 0.3, rough), 800, slid, 0, 1, 0},
      {"friction/rolling", drop(kBall + ", friction: {static: 1, rolling: 0}, restitution: 0", 0.1, 0.1, rough),
       drop(kBall + ", friction: {static: 1, rolling: 0.5}, restitution: 0", 0.1, 0.1, rough), 1500, slid, 1, 0, 0},
      // Falls 0.1 m from rest and comes back, or stays down.
      {"restitution", drop(kBall + ", restitution: 0", 0.2, 0, rough), drop(kBall + ", restitution: 1", 0.2, 0, rough),
       286, height, 0.1, 0.2, 0.02},
  });
}

TEST(AdfEffects, CollisionShapesAndFilters) {
  const double through = -0.5 * 9.81;  // where a second of free fall ends
  const std::string ball_at =
      "mass: 1, collision shape: SPHERE, collision geometry: {radius: 0.1}, collision offset: "
      "{position: {x: 0, y: 0, z: -0.2}, orientation: {r: 0, p: 0, y: 0}}";
  const std::string two =
      "mass: 1, compound collision shape: [{shape: BOX, geometry: {x: 0.2, y: 0.2, z: 0.2}}, {shape: BOX, geometry: "
      "{x: 0.2, y: 0.2, z: 0.2}, offset: {position: {x: 0, y: 0, z: -0.2}, orientation: {r: 0, p: 0, y: 0}}}]";
  expect_effects({
      {"collision groups", drop(kCube, 0.1), drop(kCube + ", collision groups: [1]", 0.1, 0, "collision groups: [2], "),
       1000, height, 0.1, 0.1 + through, 0.2},
      {"collision groups that are shared", drop(kCube + ", collision groups: [1]", 0.1, 0, "collision groups: [2], "),
       drop(kCube + ", collision groups: [1, 3]", 0.1, 0, "collision groups: [2, 3], "), 1000, height, 0.1 + through,
       0.1, 0.2},
      {"ignore inter-collision of a file", drop(kCube, 0.1), drop(kCube, 0.1, 0, "", "ignore inter-collision: true\n"),
       1000, height, 0.1, 0.1 + through, 0.2},
      {"collision offset", drop(kBall, 0.4), drop(ball_at, 0.4), 1500, height, 0.1, 0.3, 2e-3},
      {"compound collision shape, offset", drop(kCube, 0.4), drop(two, 0.4), 1500, height, 0.1, 0.3, 2e-3},
      {"scale of primitives", drop(kCube, 0.4), drop(kCube + ", scale: 2", 0.4), 1500, height, 0.1, 0.2, 2e-3},
      {"ignore inter-collision of a joint",
       arm("type: revolute, enable motor: false",
           "mass: 1, collision shape: BOX, collision geometry: {x: 1.1, y: 0.1, z: 0.02}"),
       arm("type: revolute, enable motor: false, ignore inter-collision: false",
           "mass: 1, collision shape: BOX, collision geometry: {x: 1.1, y: 0.1, z: 0.02}, collision offset: {position: "
           "{x: 0, y: 0, z: 0.12}, orientation: {r: 0, p: 0, y: 0}}"),
       400, swung, 1, 0, 0},
  });
}

TEST(AdfEffects, JointMotorsAndLimits) {
  const double down = std::numbers::pi / 2;  // about +y, from +x to -z
  expect_effects({
      {"enable motor", arm("type: revolute"), arm("type: revolute, enable motor: false"), 300, swung, 0, 1, 0},
      {"enable motor: 1 and 0", arm("type: revolute, enable motor: 1"), arm("type: revolute, enable motor: 0"), 300,
       swung, 0, 1, 0},
      {"passive of a joint", arm("type: revolute"), arm("type: revolute, passive: true"), 300, swung, 0, 1, 0},
      {"max motor impulse", arm("type: revolute"), arm("type: revolute, max motor impulse: 0.0001"), 300, swung, 0, 1,
       0},
      {"joint limits", arm("type: revolute, enable motor: false, damping: 2"),
       arm("type: revolute, enable motor: false, damping: 2, joint limits: {low: -0.3, high: 0.3}"), 8000, angle, down,
       0.3, 0.02},
      {"damping", arm("type: revolute, enable motor: false, damping: 0.01"),
       arm("type: revolute, enable motor: false, damping: 500"), 300, swung, 1, 0, 0},
      {"type", arm("type: revolute, enable motor: false"), arm("type: fixed"), 300, swung, 1, 0, 0},
      {"joint offset", arm("type: revolute"), arm("type: revolute, joint offset: 0.3"), 1,
       [](Rig& rig) { return std::abs(angle(rig)); }, 0, 0.3, 1e-3},
      {"child offset", arm("type: revolute"), arm("type: revolute, child offset: 0.3"), 1,
       [](Rig& rig) { return std::abs(angle(rig)); }, 0, 0.3, 1e-3},
      {"offset", arm("type: revolute"), arm("type: revolute, offset: 0.3"), 1,
       [](Rig& rig) { return std::abs(angle(rig)); }, 0, 0.3, 1e-3},
      {"enable feedback", arm("type: revolute"), arm("type: revolute, enable feedback: true"), 100,
       [](Rig& rig) { return std::abs(rig.frame().joints.at(0).effort); }, 0, 0.5 * 9.81, 0.05},
  });
}

TEST(AdfEffects, JointControllers) {
  // P against the weight of the arm: sags by about m g l / P; I takes it away; without `controller` the motor goes by
  // velocity.
  const double weight = 0.5 * 9.81 * std::cos(0.4);
  expect_effects({
      {"controller/P", arm("type: revolute, controller: {P: 100, I: 0, D: 10}"),
       arm("type: revolute, controller: {P: 1000, I: 0, D: 10}"), 450, angle, -0.4 + weight / 100, -0.4 + weight / 1000,
       6e-3, bend},
      {"controller/I", arm("type: revolute, controller: {P: 100, I: 0, D: 10}"),
       arm("type: revolute, controller: {P: 100, I: 300, D: 10}"), 490, angle, 0.049, 0, 0.02, hold},
      {"controller/D", arm("type: revolute, controller: {P: 100, I: 0, D: 1000}"),
       arm("type: revolute, controller: {P: 100, I: 0, D: 10}"), 100,
       [](Rig& rig) { return angle(rig) < -0.1 ? 1.0 : 0.0; }, 0, 1, 0, bend},
      {"controller output type", arm("type: revolute, controller: {P: 10, I: 0, D: 0.1}"),
       arm("type: revolute, controller: {P: 10, I: 0, D: 0.1}, controller output type: VELOCITY"), 490,
       [](Rig& rig) { return angle(rig) < 0.0 ? 1.0 : 0.0; }, 0, 1, 0, bend},
  });
}

// A mesh of two towers, 0.4 m high, with a gap of 0.2 m between them; and the scene in which a ball falls towards the
// gap, or a body of that mesh falls on the floor.
std::string towers() {
  const std::string file = (std::filesystem::temp_directory_path() / "ambf_towers.stl").string();
  std::ofstream out(file);
  out << "solid towers\n";
  for (const double x0 : {-0.3, 0.1}) {
    const auto corner = [&](int i) {
      std::ostringstream text;
      text << "vertex " << x0 + ((i & 1) != 0 ? 0.2 : 0.0) << " " << ((i & 2) != 0 ? 0.2 : -0.2) << " "
           << ((i & 4) != 0 ? 0.4 : 0.0) << "\n";
      return text.str();
    };
    constexpr int kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& face : kFaces) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const int i : face) out << corner(i);
      out << "endloop\nendfacet\n";
    }
  }
  out << "endsolid\n";
  return file;
}

TEST(AdfEffects, CollisionMeshes) {
  const std::filesystem::path file = towers();
  const std::string mesh =
      "mesh: " + file.filename().string() + ", high resolution path: " + file.parent_path().string() + ", ";
  const auto ball_above = [&](const std::string& type) {
    return "bodies: [TOWERS, BODY A]\nTOWERS: {name: towers, mass: 0, " + mesh + type + at(0, 0, 0) +
           "}\nBODY A: {name: a, mass: 1, collision shape: SPHERE, collision geometry: {radius: 0.05}, " +
           at(0, 0, 0.5) + "}\n";
  };
  const auto falls = [&](const std::string& keys) {
    return drop("mass: 1, " + mesh + keys + "inertia: {ix: 0.05, iy: 0.05, iz: 0.05}", 0.1);
  };
  const auto on_top = [](Rig& rig) { return height(rig) > 0.4 ? 1.0 : 0.0; };
  expect_effects({
      {"collision mesh type", ball_above(""), ball_above("collision mesh type: CONVEX_HULL, "), 400, on_top, 0, 1, 0},
      {"collision mesh type, as it is without", ball_above("collision mesh type: CONCAVE_MESH, "),
       ball_above("collision mesh type: CONVEX_MESH, "), 400, on_top, 0, 1, 0},
      {"collision margin of points", falls("collision mesh type: POINT_CLOUD, collision margin: 0.001, "),
       falls("collision mesh type: POINT_CLOUD, collision margin: 0.05, "), 1500, height, 0.001, 0.05, 2e-3},
  });
}

// A second arm beside the first, which its motor holds; its own joint has no motor, and is described before the other.
std::string two_arms(const std::string& second_joint) {
  std::string scene = arm("type: revolute");
  for (const auto& [old_list, list] :
       {std::pair<std::string, std::string>{"[FRAME, ARM]", "[FRAME, ARM, SECOND]"}, {"[J]", "[K, J]"}})
    scene.replace(scene.find(old_list), old_list.size(), list);
  return scene + "SECOND: {name: second, mass: 1, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}, " + at(0.5, 0.5, 0) +
         "}\nK: {name: k, parent: FRAME, child: SECOND, parent pivot: {x: 0, y: 0.5, z: 0}, child pivot: {x: -0.5, y: "
         "0, "
         "z: 0}, parent axis: {x: 0, y: 1, z: 0}, child axis: {x: 0, y: 1, z: 0}, type: revolute, enable motor: false" +
         second_joint + "}\n";
}

TEST(AdfEffects, JointsThatFollowOthers) {
  const auto fell = [](Rig& rig) { return place(rig, "SECOND").position.z < -0.1 ? 1.0 : 0.0; };
  expect_effects({
      {"mimic", two_arms(""), two_arms(", mimic: {joint: J}"), 300, fell, 1, 0, 0},
      {"mimic/offset", two_arms(", mimic: {joint: J}"), two_arms(", mimic: {joint: J, offset: 0.3}"), 300,
       [](Rig& rig) { return rig.frame().joints.at(0).position - rig.frame().joints.at(1).position; }, 0, 0.3, 1e-4},
      {"mimic/multiplier", two_arms(", mimic: {joint: J, offset: 0.3}"),
       two_arms(", mimic: {joint: J, offset: 0.3, multiplier: -2}"), 300,
       [](Rig& rig) {
         const double second = rig.frame().joints.at(0).position, first = rig.frame().joints.at(1).position;
         return std::abs(second + 2.0 * first - 0.3) < 1e-4 ? 1.0 : 0.0;
       },
       0, 1, 0},
  });
}

TEST(AdfEffects, FramesOfBodies) {
  const std::string hung = "mass: 1, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}";
  expect_effects({
      // Held at its centre of mass it does not turn; held beside it, it does.
      {"inertial offset",
       arm("type: revolute, enable motor: false",
           hung + ", inertial offset: {position: {x: -0.5, y: 0, z: 0}, orientation: {r: 0, p: 0, y: 0}}"),
       arm("type: revolute, enable motor: false", hung), 300, swung, 0, 1, 0},
      // A body of scale 2 is held at twice the pivot, so its frame is drawn to x = 1.
      {"scale of pivots", arm("type: fixed"),
       arm("type: fixed", "mass: 1, scale: 2, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}"),
       3000, [](Rig& rig) { return place(rig, "ARM").position.x; }, 0.5, 1.0, 5e-3},
  });
}

}  // namespace
}  // namespace ambf::runtime::test
