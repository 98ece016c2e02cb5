// Bundles of rays: where they meet every kind of shape, against marching along the ray by the distance to the shape
// (primitives) and against every triangle one by one (hulls and meshes); when they are cast again.
#include "physics/rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

// Signed distance to a shape around its origin, axis z: what the rays know nothing of.
using Distance = std::function<double(const math::Vec3&)>;

double length(double a, double b) { return std::sqrt(a * a + b * b); }

Distance distance_to(const scene::Geometry& g) {
  switch (g.shape) {
    case scene::Shape::sphere: return [r = g.radius](const math::Vec3& p) { return math::norm(p) - r; };
    case scene::Shape::box:
      return [h = g.size * 0.5](const math::Vec3& p) {
        const math::Vec3 q{std::abs(p.x) - h.x, std::abs(p.y) - h.y, std::abs(p.z) - h.z};
        const math::Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
        return math::norm(out) + std::min(std::max({q.x, q.y, q.z}), 0.0);
      };
    case scene::Shape::capsule:
      return [r = g.radius, h = 0.5 * g.height - g.radius](const math::Vec3& p) {
        return math::norm(math::Vec3{p.x, p.y, p.z - std::clamp(p.z, -h, h)}) - r;
      };
    case scene::Shape::cylinder:
      return [r = g.radius, h = 0.5 * g.height](const math::Vec3& p) {
        const double a = length(p.x, p.y) - r, b = std::abs(p.z) - h;
        return length(std::max(a, 0.0), std::max(b, 0.0)) + std::min(std::max(a, b), 0.0);
      };
    case scene::Shape::cone:  // no more than the distance: enough to march by
      return [r = g.radius, h = g.height](const math::Vec3& p) {
        const double side = (length(p.x, p.y) * h + (p.z - 0.5 * h) * r) / length(h, r);
        return std::max({side, -p.z - 0.5 * h});
      };
    case scene::Shape::plane: return [o = g.offset](const math::Vec3& p) { return p.z - o; };
  }
  return {};
}

// Where the ray first comes to the shape; none where it misses it or starts inside. `grazes`: nobody can say.
std::optional<double> march(const Distance& distance, const math::Vec3& from, const math::Vec3& unit, double reach,
                            bool& grazes) {
  grazes = false;
  if (distance(from) <= 0.0) return std::nullopt;
  for (double t = 0.0; t < reach;) {
    const double d = distance(from + unit * t);
    if (d < 1e-12) return t;
    if (d < 1e-8 && distance(from + unit * (t + 1e-7)) > d) grazes = true;
    t += d;
  }
  return std::nullopt;
}

std::vector<Ray> random_rays(Random& random, std::size_t count, double size) {
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) ray = {random.vector(size), random.vector(size)};
  return rays;
}

scene::PlacedGeometry geometry(scene::Shape shape) {
  scene::PlacedGeometry part = box(0.2, 0.3, 0.4);
  part.geometry.shape = shape;
  part.geometry.radius = 0.12;
  part.geometry.height = 0.35;
  part.geometry.axis = scene::Axis::z;
  return part;
}

TEST(RayBundle, MeetsEveryPrimitiveWhereItIs) {
  Random random(11);
  std::size_t met = 0;
  for (const auto shape : {scene::Shape::box, scene::Shape::sphere, scene::Shape::capsule, scene::Shape::cylinder,
                           scene::Shape::cone, scene::Shape::plane}) {
    for (int trial = 0; trial < 14; ++trial) {
      scene::PlacedGeometry part = geometry(shape);
      part.offset = trial == 0 ? math::Pose{} : random.pose(0.1);
      const bool is_plane = shape == scene::Shape::plane;
      BodyDefinition p;
      p.mass = is_plane ? 0.0 : 1.0;
      p.T_body_com = trial < 2 ? math::Pose{} : random.pose(0.2);
      p.T_world_body = random.pose(0.3);
      ShapeOptions options;
      options.T_body_com = p.T_body_com;
      options.moving = !is_plane;
      options.scale = is_plane || trial < 3 ? 1.0 : random(0.5, 2.0);
      p.shape = make_shape({part}, options);
      Body body(p);
      World world;
      world.add(body);
      const auto rays = random_rays(random, 200, 0.6);
      std::vector<BundleHit> hits(rays.size());
      const math::Pose T_world_bundle = random.pose(0.3);
      RayBundle bundle;
      ASSERT_EQ(bundle.cast(world, T_world_bundle, rays, {}, hits), rays.size());

      scene::Geometry scaled = part.geometry;
      scaled.size = scaled.size * options.scale;
      scaled.radius *= options.scale;
      scaled.height *= options.scale;
      const math::Pose T_part_world = math::inverse(p.T_world_body * part.offset);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const math::Vec3 from = T_part_world * (T_world_bundle * rays[i].start);
        const math::Vec3 to = T_part_world * (T_world_bundle * rays[i].end);
        const double reach = math::norm(to - from);
        bool grazes = false;
        const auto expected = march(distance_to(scaled), from, (to - from) / reach, reach, grazes);
        if (grazes) continue;
        ASSERT_EQ(hits[i].body != nullptr, expected.has_value()) << static_cast<int>(shape) << " trial " << trial;
        if (!expected) continue;
        ++met;
        EXPECT_NEAR(hits[i].fraction * reach, *expected, 1e-6);
        EXPECT_NEAR(math::norm(T_part_world * hits[i].point - (from + (to - from) * hits[i].fraction)), 0.0, 1e-9);
        EXPECT_LE(math::dot(hits[i].normal, (T_world_bundle * rays[i].end) - (T_world_bundle * rays[i].start)), 0.0);
        EXPECT_NEAR(math::norm(hits[i].normal), 1.0, 1e-12);
      }
    }
  }
  EXPECT_GT(met, 1500U);
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Rings of points on a ball with bumps, closed by fans at the poles: `bumps` 0 is convex.
std::pair<std::vector<math::Vec3>, Triangles> bumpy_ball(double radius, std::uint32_t n, double bumps) {
  std::vector<math::Vec3> points{{0, 0, radius}};
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const double polar = kPi * i / n, around = kPi * j / n;
      const double r = radius * (1.0 + bumps * std::sin(5 * polar) * std::cos(3 * around));
      points.push_back(
          {r * std::sin(polar) * std::cos(around), r * std::sin(polar) * std::sin(around), r * std::cos(polar)});
    }
  points.push_back({0, 0, -radius});
  const auto last = static_cast<std::uint32_t>(points.size() - 1);
  const auto at = [n](std::uint32_t ring, std::uint32_t j) { return 1 + (ring - 1) * 2 * n + j % (2 * n); };
  Triangles triangles;
  for (std::uint32_t j = 0; j < 2 * n; ++j) {
    triangles.push_back({0, at(1, j), at(1, j + 1)});
    triangles.push_back({last, at(n - 1, j + 1), at(n - 1, j)});
    for (std::uint32_t i = 1; i + 1 < n; ++i) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {points, triangles};
}

// Moeller and Trumbore, for every triangle.
std::optional<double> first_of(const std::vector<math::Vec3>& points, const Triangles& triangles,
                               const math::Vec3& from, const math::Vec3& along, bool& grazes) {
  std::optional<double> first;
  grazes = false;
  for (const auto& [a, b, c] : triangles) {
    const math::Vec3 ab = points[b] - points[a], ac = points[c] - points[a], h = math::cross(along, ac);
    const double det = math::dot(ab, h);
    if (std::abs(det) < 1e-14) continue;
    const math::Vec3 s = from - points[a], q = math::cross(s, ab);
    const double u = math::dot(s, h) / det, v = math::dot(along, q) / det, t = math::dot(ac, q) / det;
    const double edge = std::min({u, v, 1.0 - u - v});
    if (std::abs(edge) < 1e-9 || std::abs(t) < 1e-9 || std::abs(t - 1.0) < 1e-9) grazes = true;
    if (edge >= 0.0 && t >= 0.0 && t <= 1.0 && t < first.value_or(2.0)) first = t;
  }
  return first;
}

TEST(RayBundle, MeetsHullsAndMeshesWhereTheirTrianglesAre) {
  Random random(12);
  std::size_t met = 0;
  for (const bool hull : {true, false}) {
    for (int trial = 0; trial < 10; ++trial) {
      const bool moving = trial % 2 == 0;
      const auto [points, triangles] = bumpy_ball(0.25, hull ? 4 : 12, hull ? 0.0 : 0.2);
      const MeshSource mesh(points, triangles);
      const math::Pose offset = random.pose(0.2);
      BodyDefinition p;
      p.mass = moving ? 1.0 : 0.0;
      p.inertia = math::Vec3{0.01, 0.01, 0.01};
      p.T_body_com = random.pose(0.2);
      p.T_world_body = random.pose(0.3);
      ShapeOptions options;
      options.T_body_com = p.T_body_com;
      options.moving = moving;
      options.scale = random(0.5, 2.0);
      p.shape = mesh.shape(hull ? scene::CollisionMeshType::convex_hull : scene::CollisionMeshType::triangle_mesh,
                           offset, options);
      Body body(p);
      World world;
      world.add(body);
      const auto rays = random_rays(random, 150, 0.7);
      std::vector<BundleHit> hits(rays.size());
      const math::Pose T_world_bundle = random.pose(0.2);
      RayBundle bundle;
      bundle.cast(world, T_world_bundle, rays, {}, hits);

      std::vector<math::Vec3> placed;
      for (const math::Vec3& point : points) placed.push_back(p.T_world_body * (offset * (point * options.scale)));
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const math::Vec3 from = T_world_bundle * rays[i].start, to = T_world_bundle * rays[i].end;
        bool grazes = false;
        auto expected = first_of(placed, triangles, from, to - from, grazes);
        if (grazes) continue;
        // From inside of a solid hull it is met nowhere, from inside of a mesh's surface where it ends.
        const auto outside = first_of(placed, triangles, from, random.unit() * 10.0, grazes);
        if (hull && outside) {
          const auto back = first_of(placed, triangles, from, (from - to) * 100.0, grazes);
          if (expected && back) expected.reset();
        }
        ASSERT_EQ(hits[i].body != nullptr, expected.has_value()) << "hull " << hull << " trial " << trial;
        if (!expected) continue;
        ++met;
        EXPECT_NEAR((hits[i].fraction - *expected) * math::norm(to - from), 0.0, 1e-6);
        EXPECT_EQ(hits[i].triangle >= 0, !hull);
      }
    }
  }
  EXPECT_GT(met, 500U);
}

TEST(RayBundle, SeesTheNearestOfManyAndLeavesOutWhatItsFilterSays) {
  World world;
  Body near(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0.5, 0, 0})), far(parameters(1.0, {sphere(0.1)}, {1.0, 0, 0}));
  Body owner(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0, 0, 0}));
  for (Body* body : {&owner, &far, &near}) world.add(*body);
  const std::vector<Ray> rays{{{0, 0, 0}, {2, 0, 0}}};
  std::vector<BundleHit> hits(1);
  RayBundle bundle;
  bundle.cast(world, {}, rays, {.ignored = &owner}, hits);
  EXPECT_EQ(hits[0].body, &near);
  EXPECT_NEAR(hits[0].fraction, 0.45 / 2.0, 1e-12);

  bundle.forget();
  bundle.cast(world, {}, rays, {.from_inside = true}, hits);
  EXPECT_EQ(hits[0].body, &owner);
  EXPECT_EQ(hits[0].fraction, 0.0);
  bundle.forget();
  bundle.cast(world, {{0.5, 0, 0}, {}}, rays, {}, hits);
  EXPECT_EQ(hits[0].body, &far) << "what a ray starts in is not seen";
}

TEST(RayBundle, IsCastAgainOnlyWhenSomethingWithinReachHasMoved) {
  WorldOptions options;
  options.gravity = {};
  World world(options);
  Body seen(parameters(1.0, {box(0.1, 0.1, 0.1)}, {0.5, 0, 0})), beyond(parameters(1.0, {sphere(0.1)}, {5.0, 0, 0}));
  Body wall(parameters(0.0, {box(0.1, 1, 1)}, {0.9, 0, 0}));
  for (Body* body : {&seen, &beyond, &wall}) world.add(*body);
  const std::vector<Ray> rays(10, {{0, 0, 0}, {1, 0, 0}});
  std::vector<BundleHit> hits(rays.size());
  RayBundle bundle;
  EXPECT_EQ(bundle.cast(world, {}, rays, {}, hits), 10U);
  world.step();
  EXPECT_EQ(bundle.cast(world, {}, rays, {}, hits), 0U) << "nothing moved";
  beyond.set_twist({{1, 0, 0}, {}});
  world.step();
  EXPECT_EQ(bundle.cast(world, {}, rays, {}, hits), 0U) << "nothing within reach moved";
  seen.set_pose({{0.3, 0, 0}, {}});
  EXPECT_EQ(bundle.cast(world, {}, rays, {}, hits), 10U) << "put elsewhere between two steps";
  EXPECT_NEAR(hits[9].fraction, 0.25, 1e-12);
  wall.set_pose({{0.1, 0, 0}, {}});
  EXPECT_EQ(bundle.cast(world, {}, rays, {}, hits, 4), 4U) << "in turns";
  EXPECT_EQ(hits[3].body, &wall);
  EXPECT_EQ(hits[4].body, &seen);
  EXPECT_EQ(bundle.cast(world, {}, rays, {}, hits, 4), 4U);
  EXPECT_EQ(bundle.cast(world, {}, rays, {}, hits, 4), 2U);
  EXPECT_EQ(hits[9].body, &wall);
  EXPECT_EQ(bundle.cast(world, {}, rays, {}, hits, 4), 0U);
  EXPECT_EQ(bundle.cast(world, {{0, 0.01, 0}, {}}, rays, {}, hits), 10U) << "the bundle moved";
}

// Its box in the broadphase is where the last step found it.
TEST(RayBundle, SeesAFastBodyWhereItIsNow) {
  WorldOptions options;
  options.gravity = {};
  World world(options);
  BodyDefinition p = parameters(1.0, {sphere(0.01)}, {-1.0, 0, 0});
  p.surface.linear_damping = 0.0;
  Body ball(p);
  world.add(ball);
  ball.set_twist({{500, 0, 0}, {}});
  world.step();
  const double x = ball.pose().position.x;
  ASSERT_NEAR(x, -0.5, 1e-6);
  const std::vector<Ray> rays{{{x, 0, 1.0}, {x, 0, -1.0}}};
  std::vector<BundleHit> hits(1);
  RayBundle().cast(world, {}, rays, {}, hits);
  EXPECT_EQ(hits[0].body, &ball);
}

}  // namespace
}  // namespace ambf::physics
