// What the keys of springs and of joints that are free in several directions do, as adf_effects_test.cpp for all
// others.
#include <gtest/gtest.h>

#include <cmath>

#include "adf_effects.h"
#include "math/rotation.h"

namespace ambf::runtime::test {
namespace {

TEST(AdfEffects, SpringsAndWideJoints) {
  const std::string floats = "gravity: {x: 0, y: 0, z: 0}\n";
  const auto turned = [](Rig& rig) { return math::norm(math::log(place(rig, "ARM").orientation)); };
  const auto gap = [](Rig& rig) { return math::norm(place(rig, "ARM") * math::Vec3{-0.5, 0, 0}); };
  const std::string six = "type: six dof, joint limits: {linear: {low: {x: 0, y: 0, z: 0}, high: {x: 0, y: 0, z: 0}}, ";
  expect_effects({
      {"equilibrium point of a torsion spring", arm("type: torsion spring, stiffness: 200, damping: 20", "", floats),
       arm("type: torsion spring, stiffness: 200, damping: 20, equilibrium point: 0.5", "", floats), 3000, turned, 0,
       0.5, 0.01},
      {"stiffness of a torsion spring", arm("type: torsion spring, stiffness: 100, damping: 20"),
       arm("type: torsion spring, stiffness: 10000, damping: 20"), 3000, turned, 0.049, 0.00049, 1e-3},
      {"equilibrium point of a linear spring, misspelt as in old files",
       arm("type: linear spring, stiffness: 200, damping: 20", "", floats),
       arm("type: linear spring, stiffness: 200, damping: 20, equilibrium point: 0.1", "", floats), 3000, gap, 0, 0.1,
       5e-3},
      {"joint limits of a cone twist", arm("type: p2p, enable motor: false, damping: 1"),
       arm("type: cone twist, damping: 1, joint limits: {x: 0.2, y: 0.2, z: 0.2}"), 6000,
       [&](Rig& rig) { return turned(rig) < 0.25 ? 1.0 : 0.0; }, 0, 1, 0},
      {"joint limits of six dof", arm(six + "angular: {low: {x: -3, y: -1.5, z: -3}, high: {x: 3, y: 1.5, z: 3}}}"),
       arm(six + "angular: {low: {x: 0, y: 0, z: 0}, high: {x: 0, y: 0, z: 0}}}"), 300, swung, 1, 0, 0},
      {"joint cfm of a joint", arm("type: fixed"), arm("type: fixed, joint cfm: 1"), 1000,
       [&](Rig& rig) { return gap(rig) > 1e-3 ? 1.0 : 0.0; }, 0, 1, 0},
      {"joint cfm of a file", arm("type: fixed"), arm("type: fixed", "", "joint cfm: 1\n"), 1000,
       [&](Rig& rig) { return gap(rig) > 1e-3 ? 1.0 : 0.0; }, 0, 1, 0},
      {"joint erp", arm("type: fixed, joint cfm: 1"), arm("type: fixed, joint cfm: 1, joint erp: 0.1"), 1000,
       [&](Rig& rig) { return gap(rig) > 8e-3 ? 1.0 : 0.0; }, 0, 1, 0},
  });
}

// Equal values along and about all axes.
std::string all_axes(double linear, double angular) {
  const auto vector = [](double v) {
    const std::string text = std::to_string(v);
    return "{x: " + text + ", y: " + text + ", z: " + text + "}";
  };
  return "{linear: " + vector(linear) + ", angular: " + vector(angular) + "}";
}

std::string six_limits(double linear) {
  const auto side = [](double v) {
    const std::string text = std::to_string(v);
    return "{x: " + text + ", y: " + text + ", z: " + text + "}";
  };
  return "joint limits: {linear: {low: " + side(-linear) + ", high: " + side(linear) +
         "}, angular: {low: {x: 0, y: 0, z: 0}, high: {x: 0, y: 0, z: 0}}}";
}

TEST(AdfEffects, SixDegreesOfFreedom) {
  const auto gap = [](Rig& rig) { return math::norm(place(rig, "ARM") * math::Vec3{-0.5, 0, 0}); };
  const std::string spring = "type: six dof spring, " + six_limits(0.5) + ", damping: " + all_axes(40, 10);
  const std::string floats = "gravity: {x: 0, y: 0, z: 0}\n";
  expect_effects({
      {"linear limits of six dof", arm("type: six dof, " + six_limits(0.05)), arm("type: six dof, " + six_limits(0.2)),
       3000, gap, 0.05, 0.2, 2e-3},
      {"linear stiffness of a six dof spring", arm(spring + ", stiffness: " + all_axes(100, 100)),
       arm(spring + ", stiffness: " + all_axes(1000, 100)), 4000, gap, 9.81 / 100, 9.81 / 1000, 2e-3},
      {"linear equilibrium of a six dof spring", arm(spring + ", stiffness: " + all_axes(200, 100), "", floats),
       arm(spring + ", stiffness: " + all_axes(200, 100) + ", equilibrium point: " + all_axes(0.1, 0), "", floats),
       4000, gap, 0, 0.1 * std::sqrt(3.0), 5e-3},
      {"linear damping of a six dof spring",
       arm("type: six dof spring, " + six_limits(0.5) + ", stiffness: " + all_axes(1, 1) +
           ", damping: " + all_axes(1, 1)),
       arm("type: six dof spring, " + six_limits(0.5) + ", stiffness: " + all_axes(1, 1) +
           ", damping: " + all_axes(1000, 1)),
       300, [&](Rig& rig) { return gap(rig) > 0.1 ? 1.0 : 0.0; }, 1, 0, 0},
      {"damping of a cone twist", arm("type: cone twist, damping: 0.01, joint limits: {x: 1.5, y: 1.5, z: 1.5}"),
       arm("type: cone twist, damping: 500, joint limits: {x: 1.5, y: 1.5, z: 1.5}"), 300, swung, 1, 0, 0},
  });
}

// The arm weighs 4.9 Nm about the joint's z, which is the world's y; it may not shift.
TEST(AdfEffects, AngularSpringsOfSixDegreesOfFreedom) {
  const auto about = [](double x, double y, double z) {
    return "{linear: {x: 1, y: 1, z: 1}, angular: {x: " + std::to_string(x) + ", y: " + std::to_string(y) +
           ", z: " + std::to_string(z) + "}}";
  };
  const auto spring = [](const std::string& stiffness, const std::string& damping, const std::string& rest = "") {
    return "type: six dof spring, joint limits: {linear: {low: {x: 0, y: 0, z: 0}, high: {x: 0, y: 0, z: 0}}, "
           "angular: {low: {x: -1.5, y: -1.5, z: -1.5}, high: {x: 1.5, y: 1.5, z: 1.5}}}, stiffness: " +
           stiffness + ", damping: " + damping + (rest.empty() ? "" : ", equilibrium point: " + rest);
  };
  const auto turned = [](Rig& rig) { return math::norm(math::log(place(rig, "ARM").orientation)); };
  const auto sunk = [](Rig& rig) { return math::log(place(rig, "ARM").orientation).y; };
  const std::string floats = "gravity: {x: 0, y: 0, z: 0}\n";
  const std::string calm = about(5, 5, 5), stiff = about(50, 50, 50);
  expect_effects({
      // K theta = 4.905 cos(theta)
      {"angular stiffness of a six dof spring", arm(spring(about(20, 20, 20), calm)),
       arm(spring(about(100, 100, 100), calm)), 4000, sunk, 0.2384, 0.0490, 1e-3},
      {"angular stiffness is that of its axis", arm(spring(about(0, 0, 20), calm)), arm(spring(about(99, 99, 0), calm)),
       9000, sunk, 0.2384, 1.5, 5e-3},
      // d theta' = 4.905 cos(theta)
      {"angular damping of a six dof spring", arm(spring(about(0, 0, 0), about(50, 50, 50))),
       arm(spring(about(0, 0, 0), about(25, 25, 25))), 1000, sunk, 0.0975, 0.1934, 2e-3},
      {"angular damping is that of its axis", arm(spring(about(0, 0, 0), about(0, 0, 50))),
       arm(spring(about(0, 0, 0), about(50, 50, 0))), 300, [&](Rig& rig) { return sunk(rig) > 0.3 ? 1.0 : 0.0; }, 0, 1,
       0},
      {"angular equilibrium of a six dof spring", arm(spring(stiff, calm), "", floats),
       arm(spring(stiff, calm, about(0, 0, 0.3)), "", floats), 4000, sunk, 0, 0.3, 1e-3},
      {"angular equilibrium about x and y", arm(spring(stiff, calm, about(0.2, 0, 0)), "", floats),
       arm(spring(stiff, calm, about(0, -0.4, 0)), "", floats), 4000, turned, 0.2, 0.4, 1e-3},
      {"angular equilibrium about x does not turn z", arm(spring(stiff, calm, about(0.2, 0, 0)), "", floats),
       arm(spring(stiff, calm, about(0, -0.4, 0)), "", floats), 4000, sunk, 0, 0, 1e-3},
  });
}

}  // namespace
}  // namespace ambf::runtime::test
