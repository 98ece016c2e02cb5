#include "render/marks/world_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/primitives.h"
#include "render/marks/detail/world_shape_geometry.h"

namespace ambf::render {
namespace {

constexpr DebugColor kRed = {1.0F, 0.0F, 0.0F, 0.5F};

math::Vec3 point(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

TEST(WorldShapes, IsEmptyUntilSomethingIsDrawnAndAfterClear) {
  WorldShapes draw;
  EXPECT_TRUE(draw.empty());
  draw.text({}, "here");
  EXPECT_FALSE(draw.empty());
  draw.clear();
  EXPECT_TRUE(draw.empty());
  draw.point({}, kRed, 4.0, Seen::always);
  EXPECT_FALSE(draw.empty());
}

TEST(WorldShapes, LinesKeepTheirEndsWidthAndColor) {
  WorldShapes draw;
  draw.line({1, 2, 3}, {4, 5, 6}, kRed, 3.0, Seen::through);
  EXPECT_TRUE(draw.lines(Seen::in_front).empty());
  ASSERT_EQ(draw.lines(Seen::through).size(), 1U);
  const DebugLine& line = draw.lines(Seen::through).front();
  EXPECT_EQ(point(line.from), (math::Vec3{1, 2, 3}));
  EXPECT_EQ(point(line.to), (math::Vec3{4, 5, 6}));
  EXPECT_EQ(line.from_half_px, 1.5F);
  EXPECT_EQ(line.color, (std::array<std::uint8_t, 4>{255, 0, 0, 128}));
}

TEST(WorldShapes, AnArrowEndsAtItsTipAndItsHeadIsNeverLongerThanHalfOfIt) {
  WorldShapes draw;
  draw.arrow({0, 0, 0}, {0, 0, 1}, kRed, 0.2, 2.0);
  draw.arrow({0, 0, 0}, {0, 0, 0.1}, kRed, 0.2, 2.0);
  draw.arrow({1, 1, 1}, {1, 1, 1}, kRed, 0.2, 2.0);  // of no length: nothing
  const auto& lines = draw.lines(Seen::in_front);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_NEAR(lines[1].from[2], 0.8, 1e-6);
  EXPECT_NEAR(lines[1].to[2], 1.0, 1e-6);
  EXPECT_EQ(lines[1].to_half_px, 0.0F);
  EXPECT_GT(-lines[1].from_half_px, 2 * lines[0].from_half_px);
  EXPECT_NEAR(lines[3].from[2], 0.05, 1e-6);
}

TEST(WorldShapes, ABoxHasTwelveEdgesOfItsSize) {
  WorldShapes draw;
  draw.box({{1, 0, 0}, {}}, {0.2, 0.4, 0.6}, kRed);
  ASSERT_EQ(draw.lines(Seen::in_front).size(), 12U);
  double total = 0.0;
  for (const DebugLine& line : draw.lines(Seen::in_front)) total += math::norm(point(line.to) - point(line.from));
  EXPECT_NEAR(total, 4 * (0.2 + 0.4 + 0.6), 1e-5);
  draw.filled_box({{1, 0, 0}, {}}, {0.2, 0.4, 0.6}, kRed);
  const auto& corners = draw.triangles(Seen::in_front);
  ASSERT_EQ(corners.size(), 36U);
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const math::Vec3 a = point(corners[i].point);
    area += 0.5 * math::norm(math::cross(point(corners[i + 1].point) - a, point(corners[i + 2].point) - a));
  }
  EXPECT_NEAR(area, 2 * (0.2 * 0.4 + 0.4 * 0.6 + 0.2 * 0.6), 1e-5);
}

TEST(WorldShapes, AnArcTurnsAboutItsAxisFromItsStart) {
  WorldShapes draw;
  draw.arc({0, 0, 1}, {0, 0, 1}, {0.5, 0, 0}, std::numbers::pi / 2, kRed);
  const auto& lines = draw.lines(Seen::in_front);
  ASSERT_GT(lines.size(), 6U);
  EXPECT_LT(math::norm(point(lines.front().from) - math::Vec3{0.5, 0, 1}), 1e-6);
  EXPECT_LT(math::norm(point(lines.back().to) - math::Vec3{0, 0.5, 1}), 1e-6);
  for (const DebugLine& line : lines) EXPECT_NEAR(math::norm(point(line.to) - math::Vec3{0, 0, 1}), 0.5, 1e-6);
}

TEST(WorldShapes, AxesAreRedGreenBlue) {
  WorldShapes draw;
  draw.axes({{0, 0, 1}, {}}, 0.5);
  const auto& lines = draw.lines(Seen::always);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_LT(math::norm(point(lines[0].to) - math::Vec3{0.5, 0, 1}), 1e-6);
  EXPECT_LT(math::norm(point(lines[2].to) - math::Vec3{0, 0, 1.5}), 1e-6);
  EXPECT_GT(lines[0].color[0], lines[0].color[2]);
  EXPECT_GT(lines[1].color[1], lines[1].color[0]);
  EXPECT_GT(lines[2].color[2], lines[2].color[0]);
}

TEST(DebugGeometry, ABoxHasTwelveSharpEdgesAndADiagonalOnEachFace) {
  const DebugGeometry box = debug_geometry(mesh::make_box(0.2, 0.3, 0.4));
  EXPECT_EQ(box.vertices.size(), 3U * 8U) << "corners are joined";
  EXPECT_EQ(box.triangles.size(), 36U);
  EXPECT_EQ(box.sharp, 12U);
  EXPECT_EQ(box.edges.size(), 2U * 18U);
}

TEST(DebugGeometry, ARoundSurfaceHasNoSharpEdgesButBordersAndPolylinesAre) {
  const DebugGeometry sphere = debug_geometry(mesh::make_sphere(0.1));
  EXPECT_GT(sphere.edges.size(), 200U);
  EXPECT_LT(sphere.sharp, 70U) << "only about the poles, if at all";

  mesh::Mesh open;
  mesh::Submesh part;
  part.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  part.triangles = {0, 1, 2};
  part.lines = {{0, 3}};
  open.submeshes.push_back(part);
  const DebugGeometry border = debug_geometry(open);
  EXPECT_EQ(border.sharp, 4U);
  EXPECT_EQ(border.edges.size(), 8U);
}

}  // namespace
}  // namespace ambf::render
