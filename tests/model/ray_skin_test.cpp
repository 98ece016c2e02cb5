// Rays that are wrapped onto a body's mesh, the surface through what rays sense, and what of a sensor's friction is cut
// by what it meets.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/model/resistive.h"

namespace ambf::model {
namespace {

using namespace test;

std::string write(const std::string& name, const std::string& text) {
  std::string file = ::testing::TempDir() + "/" + name;
  std::ofstream(file) << text;
  return file;
}

// A cube of 0.2 m about its frame's origin, outward.
std::string cube() {
  return write("skin_cube.obj",
               "v -0.1 -0.1 -0.1\nv 0.1 -0.1 -0.1\nv 0.1 0.1 -0.1\nv -0.1 0.1 -0.1\nv -0.1 -0.1 0.1\nv 0.1 -0.1 0.1\n"
               "v 0.1 0.1 0.1\nv -0.1 0.1 0.1\nf 1 4 3\nf 1 3 2\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\n"
               "f 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n");
}
// 2 x 2 squares of 0.04 m in the plane z = 0.3; normals along -z.
std::string patch() {
  std::string text;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      text += "v " + std::to_string(0.04 * (k - 1)) + " " + std::to_string(0.04 * (i - 1)) + " 0.3\n";
  for (int i = 0; i < 2; ++i)
    for (int k = 1; k < 3; ++k) {
      const std::string a = std::to_string(3 * i + k), b = std::to_string(3 * i + k + 1),
                        c = std::to_string(3 * i + k + 3), d = std::to_string(3 * i + k + 4);
      text += "f " + a + " " + c + " " + b + "\nf " + b + " " + c + " " + d + "\n";
    }
  return write("skin_patch.obj", text);
}

base::Diagnostics load(Rig& rig, const std::string& text) {
  const adf::ModelResult read = adf::parse_model(
      "namespace: /test/\nbodies: [BODY a]\n" + box("a", 1.0, {0, 0, 1}, {0.2, 0.2, 0.2}) + text, "skin.yaml");
  base::Diagnostics all = read.diagnostics;
  const base::Diagnostics more = rig.load(*read.model).diagnostics;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string wrapped(const std::string& wrap, const std::string& more = {}) {
  return "sensors: [SENSOR s]\nSENSOR s: {name: s, type: Resistance, parent: BODY a, range: 0.02, mesh: '" + patch() +
         "', wrap: " + wrap + more + "}\n";
}
std::string onto(const std::string& offset) { return "{onto: '" + cube() + "', offset: " + offset + "}"; }

const state::SensorInfo& info(const Rig& rig) { return state::sensors(*rig.live->structure()).at(0); }

TEST(RayWrap, RaysStandOnTheMeshThatIsWrappedOntoAndPointAway) {
  Rig rig;
  EXPECT_TRUE(adf::no_worse_than_information(load(rig, wrapped(onto("0.001"), ", depth: 0.005"))));
  const auto& rays = *info(rig).rays;
  ASSERT_EQ(rays.size(), 8U);
  for (const state::SensorRay& ray : rays) {
    EXPECT_NEAR(ray.start.z, 0.1 + 0.001 - 0.005, 1e-7);
    EXPECT_NEAR(ray.end.z - ray.start.z, 0.02, 1e-7);
  }
}

// The mesh that is wrapped onto is in the frame of the parent, the patch in that of the sensor.
TEST(RayWrap, KnowsWhereTheSensorSits) {
  Rig rig;
  const std::string at = ", location: {position: {x: 0.02, y: 0, z: 0.05}, orientation: {r: 0, p: 0, y: 0}}";
  EXPECT_TRUE(adf::no_worse_than_information(load(rig, wrapped(onto("0"), at))));
  for (const state::SensorRay& ray : *info(rig).rays) EXPECT_NEAR(ray.start.z, 0.1 - 0.05, 1e-7);
}

TEST(RayWrap, WhatCannotBeWrappedIsNamed) {
  const struct {
    std::string text, message;
  } kCases[] = {
      {wrapped("{offset: 0.01}"), "error: \\[SENSOR s: wrap/onto\\] missing"},
      {wrapped("{onto: absent.obj}"), "error: \\[SENSOR s: wrap/onto\\] mesh to wrap onto not found"},
      {wrapped(onto("-1")), "error: \\[SENSOR s: wrap/offset\\] expected a number of at least 0"},
      {wrapped(onto("0.5")), "error: \\[SENSOR s: wrap\\] no triangle"},
      {wrapped(onto("0"), ", location: {position: {x: 3, y: 0, z: 0}, orientation: {r: 0, p: 0, y: 0}}"),
       "error: \\[SENSOR s: wrap\\] no triangle"},
      {wrapped(onto("0"), ", location: {position: {x: 0.08, y: 0, z: 0}, orientation: {r: 0, p: 0, y: 0}}"),
       "info: \\[SENSOR s: wrap\\] 4 of 8 triangles"},
      {"sensors: [SENSOR s]\nSENSOR s: {name: s, type: Resistance, parent: BODY a, parametric: {resolution: 2}, "
       "wrap: " +
           onto("0") + "}\n",
       "warning: \\[SENSOR s: wrap\\] not used"},
  };
  for (const auto& each : kCases) {
    Rig rig;
    const base::Diagnostics found = load(rig, each.text);
    EXPECT_TRUE(adf::says(found, each.message)) << each.message;
    const bool dropped = each.message.starts_with("error");
    EXPECT_EQ(state::sensors(*rig.live->structure()).size(), dropped ? 0U : 1U) << each.message;
  }
}

std::set<std::uint32_t> joined(const state::SensorInfo& sensor) {
  std::set<std::uint32_t> elements;
  for (const auto& triangle : *sensor.skin) elements.insert(triangle.begin(), triangle.end());
  return elements;
}
// Triangles face where the rays point, and none covers another: their areas add up to `area`.
double area_of(const state::SensorInfo& sensor) {
  double sum = 0.0;
  for (const auto& [a, b, c] : *sensor.skin) {
    const auto& rays = *sensor.rays;
    const math::Vec3 twice = math::cross(rays[b].end - rays[a].end, rays[c].end - rays[a].end);
    EXPECT_GT(math::dot(twice, rays[a].end - rays[a].start), 0.0);
    sum += 0.5 * math::norm(twice);
  }
  return sum;
}

TEST(RaySkin, JoinsListedRaysOfOneSideAndLeavesGapsBetweenGroups) {
  Rig rig;
  std::vector<math::Vec3> starts = grid(5, 4, 0.05, 0.1);
  for (const math::Vec3& start : grid(5, 4, 0.05, 0.1)) starts.push_back(start + math::Vec3{0.5, 0, 0});
  load(rig, "sensors: [SENSOR s]\n" + sensor("s", "a", starts, {0, 0, 1}, {}));
  EXPECT_EQ(joined(info(rig)).size(), 40U);
  EXPECT_NEAR(area_of(info(rig)), 2 * 0.04 * 0.0375, 1e-9);
}

TEST(RaySkin, JoinsRaysOnAMeshAboutItsVerticesAndAFanAsAGrid) {
  Rig rig, fan;
  load(rig, "sensors: [SENSOR s]\nSENSOR s: {name: s, type: Resistance, parent: BODY a, range: 0.02, mesh: '" + cube() +
                "'}\n");
  EXPECT_EQ(joined(info(rig)).size(), 12U);
  EXPECT_EQ(info(rig).skin->size(), 3U * 12U - 2U * 8U) << "a closed surface: fans about 8 vertices";
  load(fan,
       "sensors: [SENSOR s]\nSENSOR s: {name: s, type: Range, parent: BODY a, range: 1, parametric: "
       "{resolution: 4, horizontal angle: 0.5, vertical angle: 0.5}}\n");
  EXPECT_EQ(info(fan).skin->size(), 18U);
  area_of(info(fan));
}

TEST(RaySkin, ThereIsNoneAroundASensorThatLooksToAllSides) {
  Rig rig;
  load(rig,
       "sensors: [SENSOR s]\nSENSOR s: {name: s, type: Proximity, parent: BODY a, array: [{offset: {x: 0, y: 0, z: 0}, "
       "direction: {x: 1, y: 0, z: 0}}, {offset: {x: 0, y: 0, z: 0}, direction: {x: -1, y: 0, z: 0}}, {offset: {x: 0, "
       "y: 0, z: 0}, direction: {x: 0, y: 1, z: 0}}]}\n");
  EXPECT_TRUE(info(rig).skin->empty());
}

// Of 0.01 kg and steps of 1 ms with one element: m / h^2 = 1e4 N/m, 0.5 m / h = 5 N s/m.
TEST(ResistanceLimits, WhatALightPartnerCutsIsToldOnceWithItsLimit) {
  const auto touch = [](double mass, Numbers n) {
    ResistiveWorld world(box("a", 0.0, {0, 0, 0}, {0.2, 0.2, 0.2}) + box("b", mass, {0, 0, 0.16}, {0.1, 0.1, 0.1}) +
                             sensor("s", "a", {{0, 0, 0.1}}, {0, 0, 1}, n),
                         "SENSOR s");
    const auto port = world.rig.port("b");
    std::vector<CutReport> reports;
    for (int i = 0; i < 30; ++i) {
      port->post(test::twist({{0.01, 0, 0}, {}}));
      world.rig.step(1);
      while (const auto report = world.rig.live->take_cut_report()) reports.push_back(*report);
    }
    return reports;
  };
  Numbers n{.stick = 3e4, .slide = 9.0, .area = 1.0, .variable = "false"};
  const std::vector<CutReport> light = touch(0.01, n);
  ASSERT_GE(light.size(), 1U);
  ASSERT_LE(light.size(), 2U) << "once, and once more when it is the first that sticks less";
  const CutReport& last = light.back();
  EXPECT_EQ(last.of, CutReport::Of::touch);
  EXPECT_EQ(last.touch.sensor, 0U);
  EXPECT_EQ(last.touch.elements, 1U);
  EXPECT_EQ(last.touch.stick, 3e4);
  EXPECT_LE(last.touch.stick_limit, 1e4);
  EXPECT_GT(last.touch.stick_limit, 1e3);
  EXPECT_EQ(last.touch.slide, 9.0);
  EXPECT_LE(last.touch.slide_limit, 5.0);
  EXPECT_EQ(last.touch.damping_limit, 0.0) << "all of it counts";
  EXPECT_TRUE(touch(1.0, n).empty()) << "a heavier one bears it";
}

}  // namespace
}  // namespace ambf::model
