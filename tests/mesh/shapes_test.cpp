// Primitives, mass properties and hulls against closed forms.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "math/rotation.h"
#include "mesh/facing.h"
#include "mesh/hull.h"
#include "mesh/mass_properties.h"
#include "mesh/primitives.h"
#include "mesh/weld.h"
#include "tests/mesh/files.h"

namespace ambf::mesh {
namespace {

using math::Vec3;
using test::expect_sound;
constexpr double kPi = std::numbers::pi;

// Closed, outward, normals on the side of the faces.
void expect_good(const Mesh& mesh, double volume, double relative) {
  expect_sound(mesh);
  const MassProperties mass = mass_properties(make_collision_mesh(mesh));
  EXPECT_TRUE(mass.closed);
  EXPECT_NEAR(mass.volume / volume, 1.0, relative);
  for (const Submesh& s : mesh.submeshes) {
    ASSERT_EQ(s.texcoords.size(), 2 * s.vertex_count());
    for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
      const Vec3 a = s.vertex(s.triangles[t]), b = s.vertex(s.triangles[t + 1]), c = s.vertex(s.triangles[t + 2]);
      for (std::size_t k = 0; k < 3; ++k) {
        const float* n = s.normals.data() + std::size_t{3} * s.triangles[t + k];
        EXPECT_GT(math::dot(math::cross(b - a, c - a), {n[0], n[1], n[2]}), 0.0);
      }
    }
  }
}

TEST(Primitives, AreClosedOutwardAndOfTheRightSize) {
  expect_good(make_box(1, 2, 3), 6.0, 1e-6);
  expect_good(make_sphere(0.5, 64), 4.0 / 3.0 * kPi * 0.125, 0.01);
  expect_good(make_cylinder(0.5, 2.0, Axis::x, 128), kPi * 0.25 * 2.0, 0.002);
  expect_good(make_cone(0.5, 2.0, Axis::y, 128), kPi * 0.25 * 2.0 / 3.0, 0.002);
  expect_good(make_capsule(0.5, 2.0, Axis::z, 128), kPi * 0.25 * 1.0 + 4.0 / 3.0 * kPi * 0.125, 0.002);
  expect_good(make_capsule(0.5, 1.0), 4.0 / 3.0 * kPi * 0.125, 0.02);  // nothing but its caps
}

TEST(Primitives, StayClosedAndOutwardWhenStretchedAndMirrored) {
  for (const Vec3& factors : {Vec3{2, 0.5, 3}, Vec3{-1, 1, 1}, Vec3{-1, 2, -0.5}, Vec3{-0.1, -2, -1}})
    expect_good(stretched(make_cylinder(0.5, 2.0, Axis::x, 128), factors),
                kPi * 0.5 * std::abs(factors.x * factors.y * factors.z), 0.002);
  EXPECT_LT(bounds_of(stretched(make_box(1, 2, 3), {-2, 1, 1}).submeshes).min.x, -0.99);
}

TEST(FacingOf, ClosedSurfacesFaceOneWayAndOthersBoth) {
  const Submesh box = make_box(1, 2, 3).submeshes[0];
  EXPECT_EQ(facing_of(box), Facing::outwards);
  EXPECT_EQ(facing_of(make_sphere(0.5).submeshes[0]), Facing::outwards);
  Submesh inwards = box;
  std::reverse(inwards.triangles.begin(), inwards.triangles.end());
  EXPECT_EQ(facing_of(inwards), Facing::inwards);
  Submesh open = box;
  open.triangles.resize(open.triangles.size() - 3);
  EXPECT_EQ(facing_of(open), Facing::mixed);
  EXPECT_EQ(facing_of({}), Facing::mixed);
}

// A large box and a small one elsewhere: together they enclose a positive volume even where the small one faces
// inwards.
TEST(FacingOf, EachConnectedPartCounts) {
  const Submesh large = make_box(1, 2, 3).submeshes[0], small = make_box(0.1, 0.1, 0.1).submeshes[0];
  for (const bool small_inwards : {false, true}) {
    Submesh both = large;
    for (std::size_t i = 0; i < small.vertex_count(); ++i) {
      both.positions.insert(both.positions.end(),
                            {small.positions[3 * i] + 5.0F, small.positions[3 * i + 1], small.positions[3 * i + 2]});
    }
    std::vector<std::uint32_t> triangles = small.triangles;
    if (small_inwards) std::reverse(triangles.begin(), triangles.end());
    for (const std::uint32_t i : triangles) {
      both.triangles.push_back(i + static_cast<std::uint32_t>(large.vertex_count()));
    }
    EXPECT_EQ(facing_of(both), small_inwards ? Facing::mixed : Facing::outwards);
  }
}

TEST(Primitives, HeightRunsAlongTheAxis) {
  for (const auto& [axis, size] :
       {std::pair{Axis::x, Vec3{3, 1, 1}}, std::pair{Axis::y, Vec3{1, 3, 1}}, std::pair{Axis::z, Vec3{1, 1, 3}}}) {
    for (const Mesh& mesh : {make_cylinder(0.5, 3, axis), make_capsule(0.5, 3, axis), make_cone(0.5, 3, axis)}) {
      EXPECT_LT(math::norm(mesh.bounds.size() - size), 1e-6);
      EXPECT_LT(math::norm(mesh.bounds.min + mesh.bounds.max), 1e-6);  // centred
    }
    // The apex of the cone is at the positive end: its centre of mass is a quarter from the base.
    const Vec3 centre = mass_properties(make_collision_mesh(make_cone(0.5, 3, axis))).centre;
    EXPECT_NEAR(centre.x + centre.y + centre.z, -0.75, 1e-6);
  }
}

TEST(Primitives, PlaneLiesAtItsOffsetFacingItsNormal) {
  const Vec3 n = math::normalized(Vec3{1, 2, -2});
  const Mesh plane = make_plane({1, 2, -2}, 0.7);
  expect_sound(plane);
  const Submesh& s = plane.submeshes[0];
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(math::dot(s.vertex(i), n), 0.7, 1e-5);
  EXPECT_NEAR(mass_properties(make_collision_mesh(plane)).area, 1e4, 1e-2);
  const Vec3 face = math::cross(s.vertex(1) - s.vertex(0), s.vertex(2) - s.vertex(0));
  EXPECT_GT(math::dot(face, n), 0.0);
}

TEST(Primitives, CompoundPartsAreMovedAndKeepTheirMaterials) {
  Mesh all = make_box(1, 1, 1);
  Mesh part = make_box(2, 2, 2);
  part.materials.emplace_back();
  part.submeshes[0].material = 0;
  all.materials.resize(3);
  append(all, part, {{5, 0, 0}, math::from_rpy(0, 0, kPi / 2)});
  ASSERT_EQ(all.submeshes.size(), 2U);
  EXPECT_EQ(all.submeshes[1].material, 3);
  EXPECT_NEAR(all.bounds.max.x, 6.0, 1e-6);
  expect_sound(all);
}

TEST(MassProperties, BoxAnywhereHasItsClosedForm) {
  Mesh mesh;
  const Vec3 size{0.4, 0.2, 0.1}, centre{30, -20, 10};
  append(mesh, make_box(size.x, size.y, size.z), {centre, {}});
  const MassProperties m = mass_properties(make_collision_mesh(mesh));
  EXPECT_NEAR(m.volume, 0.008, 1e-7);  // single precision, 35 m away
  EXPECT_LT(math::norm(m.centre - centre), 1e-5);
  EXPECT_NEAR(m.inertia_per_mass[0], (0.04 + 0.01) / 12, 1e-6);
  EXPECT_NEAR(m.inertia_per_mass[1], (0.16 + 0.01) / 12, 1e-6);
  EXPECT_NEAR(m.inertia_per_mass[2], (0.16 + 0.04) / 12, 1e-6);
  for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(m.inertia_per_mass[k], 0.0, 1e-6);
}

TEST(MassProperties, TurnedBoxHasTheProductsOfInertiaOfTheTurn) {
  Mesh mesh;
  append(mesh, make_box(1, 2, 3), {{}, math::from_rpy(0, 0, kPi / 6)});
  const MassProperties m = mass_properties(make_collision_mesh(mesh));
  const double ix = 13.0 / 12, iy = 10.0 / 12, c = std::cos(kPi / 6), s = std::sin(kPi / 6);
  EXPECT_NEAR(m.inertia_per_mass[0], c * c * ix + s * s * iy, 1e-6);
  EXPECT_NEAR(m.inertia_per_mass[3], c * s * (ix - iy), 1e-6);
}

TEST(MassProperties, OpenSheetIsAThinShell) {
  const Mesh sheet = make_plane({0, 0, 1}, 0.0, 2.0);
  const MassProperties m = mass_properties(make_collision_mesh(sheet));
  EXPECT_FALSE(m.closed);
  EXPECT_NEAR(m.inertia_per_mass[2], (4.0 + 4.0) / 12, 1e-6);
  EXPECT_NEAR(m.inertia_per_mass[0], 4.0 / 12, 1e-6);
}

TEST(MassProperties, TheMeanCountsEveryCorner) {
  // A pyramid-like fan: the apex is a corner of every triangle but one place.
  const LoadResult r = load_bytes("v 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 1 3 4\n", "a.obj");
  ASSERT_TRUE(r.ok);
  EXPECT_NEAR(corner_mean(r.mesh).z, 2.0 / 6.0, 1e-7);
}

// The largest distance by which a support of the cloud exceeds that of the hull: 0 for a whole hull.
double support_gap(const std::vector<Vec3>& cloud, const std::vector<Vec3>& hull) {
  std::mt19937 rng(3);
  std::normal_distribution<double> g;
  double gap = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 d = math::normalized(Vec3{g(rng), g(rng), g(rng)});
    double a = -1e300, b = -1e300;
    for (const Vec3& p : cloud) a = std::max(a, math::dot(d, p));
    for (const Vec3& p : hull) b = std::max(b, math::dot(d, p));
    EXPECT_LE(b, a + 1e-12);  // never outside
    gap = std::max(gap, a - b);
  }
  return gap;
}

TEST(Hull, BoxFullOfPointsIsItsEightCorners) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  std::vector<Vec3> cloud;
  for (int i = 0; i < 5000; ++i) cloud.push_back({u(rng), 0.5 * u(rng), 0.1 * u(rng)});
  for (int k = 0; k < 8; ++k) cloud.push_back({k & 1 ? 1.0 : -1.0, k & 2 ? 0.5 : -0.5, k & 4 ? 0.1 : -0.1});
  const ReducedHull hull = reduce_hull(cloud);
  EXPECT_EQ(hull.points.size(), 8U);
  EXPECT_EQ(hull.triangles.size(), 12U);
  EXPECT_NEAR(hull.max_deviation, 0.0, 1e-12);
  EXPECT_NEAR(support_gap(cloud, hull.points), 0.0, 1e-12);
}

// Points in the plane of a face lie above it by rounding only, however far from that one triangle they are.
TEST(Hull, PointsInTheFacesOfAPrismDoNotDeviate) {
  for (int turn = 0; turn < 20; ++turn) {
    const double c = std::cos(0.1 * turn), s = std::sin(0.1 * turn);
    std::vector<Vec3> points;
    for (double z : {0.0, 0.1575}) {
      for (int k = 0; k < 12; ++k) {
        const double angle = k * std::numbers::pi / 6.0;
        for (double radius : {0.12, 0.05}) {
          const double x = radius * std::cos(angle), y = radius * std::sin(angle);
          points.push_back({x, c * y - s * z, s * y + c * z});  // turned about x, so that faces are not exact
        }
      }
    }
    const ReducedHull hull = reduce_hull(points);
    EXPECT_EQ(hull.points.size(), 24U) << turn;
    EXPECT_LT(hull.max_deviation, 1e-9) << turn;
  }
}

TEST(Hull, SphereIsReducedWithinTheErrorItReports) {
  const CollisionMesh sphere = make_collision_mesh(make_sphere(1.0, 100));
  double last = 1.0;
  for (int limit : {8, 16, 32, 64}) {
    const ReducedHull hull = reduce_hull(sphere.vertices, {limit, 1e-6});
    EXPECT_LE(hull.points.size(), static_cast<std::size_t>(limit));
    EXPECT_LE(support_gap(sphere.vertices, hull.points), hull.max_deviation + 1e-12);
    EXPECT_LT(hull.max_deviation, last);  // more points, less error
    last = hull.max_deviation;
    // Closed and outward.
    CollisionMesh surface{hull.points, hull.triangles, {}, bounds_of(hull.points)};
    const MassProperties mass = mass_properties(surface);
    EXPECT_TRUE(mass.closed);
    EXPECT_GT(mass.volume, 0.0);
  }
  EXPECT_LT(last, 0.09);  // 64 points on a unit sphere cannot do much better than 0.06
}

TEST(Hull, ToleranceStopsEarly) {
  const CollisionMesh sphere = make_collision_mesh(make_sphere(1.0, 100));
  const ReducedHull rough = reduce_hull(sphere.vertices, {64, 0.1});
  EXPECT_LT(rough.points.size(), 40U);
  EXPECT_LT(rough.max_deviation, 0.2 * std::sqrt(12.0));
}

TEST(Hull, RepeatsBitForBitAndDoesNotDependOnRandomSeeds) {
  const CollisionMesh mesh = make_collision_mesh(make_capsule(0.3, 1.7, Axis::x, 60));
  const ReducedHull a = reduce_hull(mesh.vertices), b = reduce_hull(mesh.vertices);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Hull, FlatLinearAndSinglePointCloudsWork) {
  std::vector<Vec3> disc, line;
  const math::Quat turn = math::from_rpy(0.3, 0.7, -0.2);
  for (int i = 0; i < 500; ++i) {
    const double a = 0.1 * i, r = 1.0 - 0.5 * (i % 2);
    disc.push_back(math::rotate(turn, {r * std::cos(a), r * std::sin(a), 0.0}));
    line.push_back(math::rotate(turn, {std::sin(0.1 * i), 0.0, 0.0}));
  }
  const ReducedHull flat = reduce_hull(disc);
  EXPECT_LE(flat.points.size(), 64U);
  EXPECT_GE(flat.points.size(), 32U);
  EXPECT_LE(support_gap(disc, flat.points), flat.max_deviation + 1e-12);
  EXPECT_LT(flat.max_deviation, 0.01);
  EXPECT_EQ(reduce_hull(line).points.size(), 2U);
  EXPECT_NEAR(support_gap(line, reduce_hull(line).points), 0.0, 1e-9);
  EXPECT_EQ(reduce_hull({{1, 2, 3}, {1, 2, 3}}).points.size(), 1U);
  EXPECT_TRUE(reduce_hull({}).points.empty());
}

TEST(Hull, RandomCloudsAreInsideUpToTheReportedError) {
  std::mt19937 rng(5);
  std::normal_distribution<double> g;
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec3> cloud;
    const double flatness = std::pow(10.0, -(round % 10));
    for (int i = 0; i < 400; ++i) {
      Vec3 p{g(rng), g(rng), g(rng) * flatness};
      if (round % 3 == 0) p = {std::round(p.x), std::round(p.y), std::round(p.z * 2)};  // many coplanar points
      cloud.push_back(p);
    }
    const ReducedHull hull = reduce_hull(cloud, {24 + round, 0.0});
    EXPECT_LE(support_gap(cloud, hull.points), hull.max_deviation + 1e-9 * bounds_of(cloud).diagonal() + 1e-12)
        << round;
  }
}

}  // namespace
}  // namespace ambf::mesh
