// Meshes as they come from exports and scans: slivers, needles, double vertices and triangles, cracks, rims. They
// carry, and nothing explodes.
#include <gtest/gtest.h>

#include <random>

#include "tests/physics/mesh_scene.h"

namespace ambf::physics {
namespace {

using namespace testing;

const math::Vec3 kSize{0.06, 0.06, 0.04};

// Corners of its own for each triangle, in part written as -0.
TestMesh exploded(const TestMesh& mesh) {
  TestMesh result;
  for (const auto& t : mesh.triangles) {
    const auto base = static_cast<std::uint32_t>(result.vertices.size());
    for (const std::uint32_t v : t) {
      math::Vec3 at = mesh.vertices[v];
      if (at.z == 0.0 && result.vertices.size() % 2) at.z = -0.0;
      result.vertices.push_back(at);
    }
    result.triangles.push_back({base, base + 1, base + 2});
  }
  return result;
}

// Triangles without area, of one point, of two, and of three in a line; and every third triangle twice.
TestMesh with_empty_triangles(TestMesh mesh) {
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = mesh.triangles[i];
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]]) * 0.5);
    mesh.triangles.push_back({t[0], t[0], t[0]});
    mesh.triangles.push_back({t[0], t[1], t[1]});
    mesh.triangles.push_back({t[0], middle, t[1]});
  }
  return mesh;
}
TestMesh with_double_triangles(TestMesh mesh) {
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; i += 3) mesh.triangles.push_back(mesh.triangles[i]);
  return mesh;
}

// Each triangle is cut into three around a point that lies almost on one of its sides: needles a micrometre high.
TestMesh with_needles(const TestMesh& mesh) {
  TestMesh result;
  result.vertices = mesh.vertices;
  for (const auto& t : mesh.triangles) {
    const math::Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const math::Vec3 side = (a + b) * 0.5;
    const auto near = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.push_back(side + (c - side) * (1e-6 / math::norm(c - side)));
    result.triangles.push_back({t[0], t[1], near});
    result.triangles.push_back({t[1], t[2], near});
    result.triangles.push_back({t[2], t[0], near});
  }
  return result;
}

// Neighbours miss each other by up to a micrometre: there are cracks everywhere, as in single precision.
TestMesh cracked(const TestMesh& mesh) {
  TestMesh result = exploded(mesh);
  std::mt19937 random(3);
  for (math::Vec3& v : result.vertices) v.z += 1e-6 * (static_cast<double>(random() % 1000) / 1000.0 - 0.5);
  return result;
}

TestMesh without_some(TestMesh mesh, std::size_t every) {
  TestMesh result = mesh;
  result.triangles.clear();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (i % every != 0) result.triangles.push_back(mesh.triangles[i]);
  return result;
}

struct Kind {
  const char* name;
  TestMesh (*make)(const TestMesh&);
};
const Kind kKinds[] = {
    {"exploded", [](const TestMesh& m) { return exploded(m); }},
    {"empty triangles", [](const TestMesh& m) { return with_empty_triangles(m); }},
    {"double triangles", [](const TestMesh& m) { return with_double_triangles(m); }},
    {"needles", [](const TestMesh& m) { return with_needles(m); }},
    {"cracks", [](const TestMesh& m) { return cracked(m); }},
    {"holes", [](const TestMesh& m) { return without_some(m, 17); }},
};

// Rests for three seconds at a height, and is slow all the time.
void expect_carried(const std::vector<BodyDefinition>& all, std::size_t i, double height, const std::string& what,
                    double tolerance = 5e-4) {
  Scene scene(all);
  double fastest = 0.0;
  for (int k = 0; k < 3000; ++k) {
    scene.world.step();
    fastest = std::max(fastest, math::norm(scene[i].twist().linear));
  }
  EXPECT_EQ(scene.world.first_diverged(), nullptr) << what;
  EXPECT_NEAR(scene[i].com_pose().position.z, height, tolerance) << what;
  EXPECT_LT(fastest, 0.3) << what;
}

TEST(BrokenMesh, CarriesAndIsCarried) {
  for (const Kind& kind : kKinds)
    for (const int cells : {4, 60}) {
      const std::string what = std::string(kind.name) + " " + std::to_string(cells);
      const TestMesh block = kind.make(box_mesh(kSize, cells)), sheet = kind.make(sheet_mesh(0.2, 2 * cells));
      const double half = 0.5 * kSize.z;
      expect_carried(
          {parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}), mesh_body(0.3, block, {0.003, 0.002, half + 0.0012})}, 1,
          half + kMargin, what + " on a box");
      expect_carried({mesh_body(0.0, sheet, {}), mesh_body(0.3, box_mesh(kSize, 3), {0.003, 0.002, half + 0.0022})}, 1,
                     half + 2 * kMargin, what + " below a block");
      expect_carried({mesh_body(0.0, sheet, {}), mesh_body(0.3, block, {0.003, 0.002, half + 0.0022})}, 1,
                     half + 2 * kMargin, what + " on its like");
    }
}

// Long thin triangles, as CAD programs cut cylinders into: two shafts across each other touch with long edges only.
TestMesh shaft(int around) {
  TestMesh mesh;
  for (int i = 0; i < around; ++i)
    for (const double x : {-0.1, 0.1}) {
      const double turn = 2.0 * kPi * (i + 0.5) / around;
      mesh.vertices.push_back({x, 0.005 * std::cos(turn), 0.005 * std::sin(turn)});
    }
  const auto at = [=](int i, int end) { return static_cast<std::uint32_t>(2 * (i % around) + end); };
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({at(i, 0), at(i, 1), at(i + 1, 1)});
    mesh.triangles.push_back({at(i, 0), at(i + 1, 1), at(i + 1, 0)});
    if (i == 0 || i + 1 == around) continue;
    mesh.triangles.push_back({at(0, 0), at(i, 0), at(i + 1, 0)});
    mesh.triangles.push_back({at(0, 1), at(i + 1, 1), at(i, 1)});
  }
  return mesh;
}

TEST(BrokenMesh, ShaftsOfLongTrianglesCarryEachOther) {
  for (const int around : {12, 24, 28, 32, 48, 64, 400})
    for (const double turn : {0.5 * kPi, 0.3}) {
      const double apart = 0.01 + 2 * kMargin;
      Scene scene({mesh_body(0.0, shaft(around), {0, 0.02, 0}), mesh_body(0.0, shaft(around), {0, -0.02, 0}),
                   mesh_body(0.2, shaft(around), {0, 0, apart + 1e-4}, math::from_rpy(0, 0, turn))});
      run(scene.world, 1.0);
      EXPECT_NEAR(scene[2].com_pose().position.z, apart, 5e-4) << around << " " << turn;
      EXPECT_EQ(scene.world.first_diverged(), nullptr);
    }
}

TEST(BrokenMesh, ShaftsOfLongTrianglesContinueAlikeAfterASnapshot) {
  const std::vector<BodyDefinition> all{
      mesh_body(0.0, shaft(64), {0, 0.02, 0}), mesh_body(0.0, shaft(48), {0, -0.02, 0}),
      mesh_body(0.2, shaft(64), {0, 0, 0.01 + 3 * kMargin}, math::from_rpy(0, 0, 1.0))};
  Scene one(all), other(all);
  run(one.world, 0.2);
  std::vector<std::byte> saved;
  one.world.save_state(saved);
  ASSERT_TRUE(other.world.restore_state(saved));
  for (Scene* scene : {&one, &other}) run(scene->world, 0.3);
  EXPECT_TRUE(one[2].com_pose() == other[2].com_pose());
}

TEST(BrokenMesh, ShaftsOfLongTrianglesRestOnBoxesMeshesAndEdges) {
  const double height = 0.005 + kMargin;
  for (const int around : {24, 64, 200}) {
    const std::string what = std::to_string(around);
    const BodyDefinition on_box = mesh_body(0.2, shaft(around), {0, 0, height + 2e-4});
    expect_carried({parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}), on_box}, 1, height, what + " on a box");
    BodyDefinition on_mesh = on_box;
    on_mesh.T_world_body.position.z += kMargin;
    expect_carried({mesh_body(0.0, sheet_mesh(0.4, 100), {}), on_mesh}, 1, height + kMargin, what + " on a mesh");
    if (around > 64) continue;  // docs/mesh_contacts.md: edges of a box do not know where they touch
    BodyDefinition across = on_box;
    across.T_world_body.orientation = math::from_rpy(0, 0, 1.3);
    const math::Quat turned = math::from_rpy(0.25 * kPi, 0, 0);
    const double top = 0.02 * std::sqrt(2.0);
    expect_carried({parameters(0.0, {box(0.3, 0.04, 0.04, {{0, 0.03, 0}, turned})}, {0, 0, -top}),
                    parameters(0.0, {box(0.3, 0.04, 0.04, {{0, -0.03, 0}, turned})}, {0, 0, -top}), across},
                   2, height, what + " on edges", around > 24 ? 3e-3 : 5e-4);
  }
}

// Inside of its rim an open mesh carries, and what slides over the rim falls off without being thrown.
TEST(BrokenMesh, RimsAreNoTraps) {
  for (const int cells : {4, 200}) {
    Scene scene(
        {mesh_body(0.0, sheet_mesh(0.1, cells), {}), mesh_body(0.3, box_mesh(kSize, cells / 4), {0, 0, 0.0221})});
    double fastest = 0.0, lowest_inside = 1.0;
    for (int i = 0; i < 600; ++i) {
      scene[1].apply_force({2.0, 0, 0}, scene[1].com_pose().position);
      scene.world.step();
      const math::Vec3 at = scene[1].com_pose().position;
      if (at.x < 0.045) lowest_inside = std::min(lowest_inside, at.z);
      if (at.z > -0.02) fastest = std::max(fastest, math::norm(scene[1].twist().linear));
    }
    EXPECT_GT(lowest_inside, 0.0217) << cells;
    EXPECT_LT(scene[1].com_pose().position.z, -0.05) << cells;
    EXPECT_LT(fastest, 2.5) << cells;
  }
}

// Thinner than features know each other's depth: the far side, too, is near the sheet, but has not come through it.
TEST(BrokenMesh, ThinPlatesRestOnOpenMeshes) {
  for (const double thick : {0.0005, 0.001, 0.003})
    for (const int cells : {2, 60}) {
      expect_carried({mesh_body(0.0, sheet_mesh(0.2, 2 * cells), {}),
                      mesh_body(0.1, box_mesh({0.06, 0.06, thick}, cells), {0.003, 0.002, 0.5 * thick + 0.0021})},
                     1, 0.5 * thick + 2 * kMargin, "plate of " + std::to_string(thick) + " " + std::to_string(cells),
                     kMargin);
    }
}

}  // namespace
}  // namespace ambf::physics
