// Tips and edges of bodies between the points of tissue: they never pass, they are felt as they push, they rub, and
// nothing jumps as they slide from face to face.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "physics/tissue.h"
#include "physics/tissue_grid.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/meshes.h"
#include "tests/physics/soft_scene.h"
#include "tests/physics/tissue_block.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr double kCoarse = 0.01;  // m, between points: a tip of 1 mm has much room there

TissueDefinition solid() {
  TissueDefinition made = tissue_of(block({0.06, 0.06, 0.03}, {-0.03, -0.03, -0.03}), kCoarse, 1e4);
  for (std::uint32_t i = 0; i < made.grid.corners.size(); ++i)
    if (made.grid.corners[i].z < -0.03 + 1e-9) made.fixed.push_back(i);
  return made;
}

TissueDefinition sheet() {
  TissueSurface flat;
  constexpr std::uint32_t kSide = 7;
  for (std::uint32_t j = 0; j < kSide; ++j)
    for (std::uint32_t i = 0; i < kSide; ++i) flat.vertices.push_back({kCoarse * i - 0.03, kCoarse * j - 0.03, 0.0});
  for (std::uint32_t j = 0; j + 1 < kSide; ++j)
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      const std::uint32_t a = j * kSide + i, c = a + kSide;
      flat.triangles.push_back({a, a + 1, c});
      flat.triangles.push_back({a + 1, c + 1, c});
    }
  TissueDefinition made;
  made.grid = make_sheet_grid(flat, 0.0005);
  made.material.young = 2e5;
  made.material.share = 0.5, made.material.time = 0.01;  // it would ring for long
  for (std::uint32_t i = 0; i < made.grid.corners.size(); ++i) {
    const Vec3& at = made.grid.corners[i];
    if (std::max(std::abs(at.x), std::abs(at.y)) > 0.03 - 1e-9) made.fixed.push_back(i);
  }
  return made;
}

// m, world: the highest of its surface over a place.
double height_at(const Tissue& tissue, double x, double y) {
  double high = -1.0;
  for (const auto& face : tissue.faces()) {
    const Vec3 a = tissue.position(face[0]), b = tissue.position(face[1]) - a, c = tissue.position(face[2]) - a;
    const double all = b.x * c.y - b.y * c.x, px = x - a.x, py = y - a.y;
    if (std::abs(all) < 1e-12) continue;
    const double at_b = (px * c.y - py * c.x) / all, at_c = (b.x * py - b.y * px) / all;
    if (at_b >= 0.0 && at_c >= 0.0 && at_b + at_c <= 1.0) high = std::max(high, a.z + b.z * at_b + c.z * at_c);
  }
  return high;
}

// Its lowest point is the origin.
struct Tool {
  std::string name;
  SharedShape shape;
};

SharedShape primitive(scene::Shape shape, const Vec3& size, double radius, double height, const math::Pose& offset) {
  scene::PlacedGeometry part;
  part.geometry.shape = shape;
  part.geometry.size = size, part.geometry.radius = radius, part.geometry.height = height;
  part.geometry.axis = scene::Axis::z;
  part.offset = offset;
  ShapeOptions options;
  options.moving = false;
  options.margin = 1e-4;
  return make_shape({part}, options);
}

// All with tips 1 mm wide.
std::vector<Tool> tools() {
  TestMesh wedge;  // a tetrahedron on its tip, 8 mm high
  wedge.vertices = {{0, 0, 0}, {0.003, 0, 0.008}, {-0.002, 0.0025, 0.008}, {-0.002, -0.0025, 0.008}};
  wedge.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  ShapeOptions options;
  options.moving = false;
  options.margin = 1e-4;
  const MeshSource source(wedge.vertices, wedge.triangles);
  using enum scene::Shape;
  using enum scene::CollisionMeshType;
  return {{"sphere", primitive(sphere, {}, 0.0005, 0, {{0, 0, 0.0005}, {}})},
          {"capsule", primitive(capsule, {}, 0.0005, 0.01, {{0, 0, 0.005}, {}})},
          {"cylinder", primitive(cylinder, {}, 0.0005, 0.01, {{0, 0, 0.005}, {}})},
          {"cone", primitive(cone, {}, 0.002, 0.01, {{0, 0, 0.005}, math::exp({kPi, 0, 0})})},
          {"box", primitive(box, {0.001, 0.001, 0.01}, 0, 0, {{0, 0, 0.005}, {}})},
          {"lying capsule", primitive(capsule, {}, 0.0005, 0.02, {{0, 0, 0.0005}, math::exp({0, 0.5 * kPi, 0})})},
          {"hull", source.shape(convex_hull, {}, options)},
          {"mesh", source.shape(triangle_mesh, {}, options)}};
}

// A tool that is led.
struct Led {
  Led(const TissueDefinition& given, const SharedShape& shape, const Vec3& from, double step = 0.001,
      double friction = 0.0)
      : scene({0, 0, 0}, step), tissue(given), tool(made_of(shape, from, friction)), at(from) {
    add(scene.world, tissue);
    scene.world.add(tool);
  }
  ~Led() { remove(scene.world, tissue); }
  static BodyDefinition made_of(const SharedShape& shape, const Vec3& at, double friction) {
    BodyDefinition made;
    made.mass = 0.0;
    made.shape = shape;
    made.T_world_body.position = at;
    made.surface.friction = friction;
    return made;
  }
  void go(const Vec3& by, int steps) {
    for (int i = 0; i < steps; ++i) {
      at += by / steps;
      tool.move_to({at, {}});
      scene.world.step();
    }
  }
  void wait(int steps) { go({}, steps); }

  Scene scene;
  Tissue tissue;
  Body tool;
  Vec3 at;
};

// In the middle of a face, near one of its edges, on a diagonal.
const std::vector<Vec3> kBetween = {{0.0033, 0.0033, 0}, {0.0049, 0.001, 0}, {-0.0052, 0.0051, 0}};

TEST(TissueTips, NoTipPassesBetweenPoints) {
  for (const bool thin : {false, true})
    for (const Tool& tool : tools())
      for (const double step : {0.0005, 0.002}) {
        const Vec3& place = kBetween[tool.name.size() % kBetween.size()];
        SCOPED_TRACE(tool.name + (thin ? " on a sheet" : " on a solid") + ", ms: " + std::to_string(1e3 * step));
        TissueDefinition given = thin ? sheet() : solid();
        given.step_s = step;
        given.margin = 2e-4;
        Led led(given, tool.shape, place + Vec3{0, 0, 0.004}, step);
        double passed = 0.0;
        for (int i = 0; i < static_cast<int>(0.024 / step); ++i) {  // 0.5 m/s: 12 mm
          led.go({0, 0, -0.5 * step}, 1);
          passed = std::max(passed, height_at(led.tissue, led.at.x, led.at.y) - led.at.z);
        }
        EXPECT_LT(passed, 0.001) << "m, that the surface is above the tip";
        led.wait(static_cast<int>(0.1 / step));
        EXPECT_LT(height_at(led.tissue, led.at.x, led.at.y) - led.at.z, 0.0003) << "m, at rest";
        EXPECT_GT(led.tissue.tips(), 0U);
        if (!thin) {  // a light sheet rings for long
          EXPECT_GT(led.tissue.force_on(led.tool).z, 0.01);
        }
        led.go({0, 0, 0.02}, static_cast<int>(0.04 / step));
        led.wait(static_cast<int>(0.2 / step));
        EXPECT_EQ(led.tissue.tips(), 0U);
        EXPECT_LT(std::abs(height_at(led.tissue, place.x, place.y)), thin ? 0.002 : 0.0005) << "m: it comes back";
        EXPECT_FALSE(led.tissue.divergence());
      }
}

// A blade's back, laid on the edge of a table: no point of the tissue is within either.
TEST(TissueTips, EdgesBearWhatLiesOnThem) {
  for (const bool thin : {false, true}) {
    SCOPED_TRACE(thin ? "sheet" : "solid");
    Scene scene;
    TissueDefinition given = thin ? sheet() : solid();
    given.fixed.clear();
    given.T_world_body.position.z = thin ? 0.003 : 0.033;
    Tissue tissue(given);
    Body left(parameters(0.0, {testing::box(0.0008, 0.2, 0.02)}, {-0.0148, 0, -0.01})),
        right(parameters(0.0, {testing::box(0.0008, 0.2, 0.02)}, {0.0152, 0, -0.01}));
    add(scene.world, tissue);
    scene.world.add(left);
    scene.world.add(right);
    scene.step(thin ? 300 : 600);
    EXPECT_GT(tissue.centre().position.z, thin ? -0.01 : 0.01);
    EXPECT_GT(tissue.tips(), 4U);
    double held = 0.0;
    for (int i = 0; i < 100; ++i) {
      scene.step(1);
      held -= 0.01 * (tissue.force_on(left).z + tissue.force_on(right).z);
    }
    EXPECT_NEAR(held, tissue.mass() * kG, 0.2 * tissue.mass() * kG);
    remove(scene.world, tissue);
  }
}

TEST(TissueTips, ThrownAtTissueTheyKeepTheMomentumOfBoth) {
  TissueDefinition given = solid();
  given.fixed.clear();
  Scene scene({0, 0, 0});
  Tissue tissue(given);
  Body ball(parameters(0.01, {testing::sphere(0.0005)}, {0.0033, 0.0033, 0.003}));
  add(scene.world, tissue);
  scene.world.add(ball);
  ball.set_twist({{0.1, 0, -0.5}, {}});
  const double before = 0.01 * -0.5;
  for (int i = 0; i < 60; ++i) {
    scene.step(1);
    EXPECT_NEAR(tissue.momentum().z + 0.01 * ball.twist().linear.z, before, 2e-3 * std::abs(before));
  }
  EXPECT_GT(ball.twist().linear.z, -0.2) << "it was stopped";
  EXPECT_NEAR(tissue.momentum().x + 0.01 * ball.twist().linear.x, 0.001, 1e-5);
  remove(scene.world, tissue);
}

TEST(TissueTips, RubUpToTheirFriction) {
  for (const bool thin : {false, true})
    for (const double friction : {0.0, 0.3, 1.0}) {
      SCOPED_TRACE(std::to_string(friction) + (thin ? ", sheet" : ", solid"));
      TissueDefinition given = thin ? sheet() : solid();
      given.material.friction = 1.0;
      Led led(given, tools().front().shape, {-0.012, 0.0033, 0.002}, 0.001, friction);
      led.go({0, 0, thin ? -0.013 : -0.005}, 150);
      led.wait(100);
      led.go({0.02, 0, 0}, 400);
      double along = 0.0, down = 0.0;
      for (int i = 0; i < 40; ++i) {
        led.go({5e-5, 0, 0}, 1);
        along -= led.tissue.force_on(led.tool).x, down += led.tissue.force_on(led.tool).z;
      }
      // The surface slopes under the tip, as it is drawn along.
      EXPECT_NEAR(along / down, friction, 0.12 + 0.3 * friction);
    }
}

// Drawn over three faces without friction: what is felt has no steps.
TEST(TissueTips, NothingJumpsFromFaceToFace) {
  for (const bool thin : {false, true})
    for (const std::size_t which : {0U, 4U, 5U}) {
      const Tool tool = tools()[which];
      SCOPED_TRACE(tool.name + (thin ? ", sheet" : ", solid"));
      Led led(thin ? sheet() : solid(), tool.shape, {-0.012, 0.0023, 0.002});
      led.go({0, 0, thin ? -0.013 : -0.005}, 200);
      led.wait(200);
      Vec3 before = led.tissue.force_on(led.tool);
      double high = 0.0, jump = 0.0;
      for (int i = 0; i < 300; ++i) {
        led.go({0.00008, 0.00001, 0}, 1);
        const Vec3 now = led.tissue.force_on(led.tool);
        jump = std::max(jump, math::norm(now - before));
        high = std::max(high, math::norm(now));
        before = now;
      }
      EXPECT_LT(jump, (thin ? 0.15 : 0.05) * high) << "N; a light sheet trembles";
    }
}

TEST(TissueTips, RepeatsAndIsSaved) {
  for (const bool thin : {false, true}) {
    const TissueDefinition given = thin ? sheet() : solid();
    const Tool tool = tools()[1];
    Led first(given, tool.shape, {0.0033, 0.0033, 0.002}), again(given, tool.shape, {0.0033, 0.0033, 0.002}),
        other(given, tool.shape, {0.0033, 0.0033, 0.002});
    std::vector<double> state, a, b, c;
    std::vector<std::byte> saved;
    for (Led* each : {&first, &again}) {
      each->go({0, 0, thin ? -0.012 : -0.006}, 120);
      each->wait(30);
      EXPECT_GT(each->tissue.tips(), 0U);
      each->scene.world.save_state(saved);
      each->tissue.get_state(state);
    }
    other.scene.world.restore_state(saved);
    ASSERT_TRUE(other.tissue.set_state(state));
    other.at = first.at;
    for (Led* each : {&first, &again, &other}) each->go({0.002, 0, -0.002}, 60);
    first.tissue.get_state(a), again.tissue.get_state(b), other.tissue.get_state(c);
    EXPECT_EQ(a, b);
    EXPECT_EQ(a, c);
    EXPECT_GT(other.tissue.tips(), 0U) << "it is found again";
  }
}

TEST(TissueTips, ABodyThatGoesLetsGo) {
  Led led(sheet(), tools().front().shape, {0.0033, 0.0033, 0.002});
  led.go({0, 0, -0.006}, 60);
  ASSERT_GT(led.tissue.tips(), 0U);
  led.scene.world.remove(led.tool);
  EXPECT_EQ(led.tissue.tips(), 0U);
  led.scene.step(300);
  EXPECT_LT(std::abs(height_at(led.tissue, 0.0033, 0.0033)), 0.003) << "m: it is free to come back";
}

}  // namespace
}  // namespace ambf::physics
