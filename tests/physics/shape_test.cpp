// Shapes: sizes, placement relative to the centre of mass, inertia, sharing, hulls.
#include <gtest/gtest.h>

#include <optional>
#include <tuple>

#include "physics/detail/shape_data.h"
#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

scene::PlacedGeometry round_part(scene::Shape shape, double radius, double height, scene::Axis axis) {
  scene::PlacedGeometry part;
  part.geometry.shape = shape;
  part.geometry.radius = radius;
  part.geometry.height = height;
  part.geometry.axis = axis;
  return part;
}

void expect_size(const Shape& shape, const math::Vec3& size) {
  const BoundingBox box = shape.bounds();
  EXPECT_NEAR(box.max.x - box.min.x, size.x, 0.005);
  EXPECT_NEAR(box.max.y - box.min.y, size.y, 0.005);
  EXPECT_NEAR(box.max.z - box.min.z, size.z, 0.005);
}

TEST(Shape, PrimitivesHaveTheirSizesAlongTheirAxis) {
  expect_size(*make_shape({box(0.1, 0.2, 0.3)}, {}), {0.1, 0.2, 0.3});
  expect_size(*make_shape({sphere(0.1)}, {}), {0.2, 0.2, 0.2});
  for (const auto shape : {scene::Shape::cylinder, scene::Shape::capsule, scene::Shape::cone}) {
    // The height of a capsule includes its caps.
    expect_size(*make_shape({round_part(shape, 0.1, 0.5, scene::Axis::x)}, {}), {0.5, 0.2, 0.2});
    expect_size(*make_shape({round_part(shape, 0.1, 0.5, scene::Axis::y)}, {}), {0.2, 0.5, 0.2});
    expect_size(*make_shape({round_part(shape, 0.1, 0.5, scene::Axis::z)}, {}), {0.2, 0.2, 0.5});
  }
  ShapeOptions doubled;
  doubled.scale = 2.0;
  expect_size(*make_shape({box(0.1, 0.2, 0.3)}, doubled), {0.2, 0.4, 0.6});
  EXPECT_TRUE(make_shape({ground()}, {})->infinite());
  EXPECT_TRUE(make_shape({}, {})->empty());
}

// Where rays hit a body tells where its surface is, whatever its COM.
std::optional<double> height_at(const World& world, double x, double y) {
  const auto hit = world.ray_cast({x, y, 5.0}, {x, y, -5.0});
  if (!hit) return std::nullopt;
  return hit->point.z;
}

TEST(Shape, OffsetsAreInTheBodyFrameWhateverTheCentreOfMass) {
  Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    BodyDefinition p;
    p.T_body_com = trial == 0 ? math::Pose{} : random.pose(0.3);
    p.T_world_body.position = {0.1, 0.2, 0.0};
    ShapeOptions options;
    options.T_body_com = p.T_body_com;
    p.shape = make_shape({box(0.2, 0.2, 0.2, {{0.5, 0, 0.3}, {}}), sphere(0.1, {{-0.5, 0, 0}, {}})}, options);
    Body body(p);
    World world;
    world.add(body);
    EXPECT_LT(math::norm(body.pose().position - p.T_world_body.position), 1e-12);
    ASSERT_TRUE(height_at(world, 0.6, 0.2));
    EXPECT_NEAR(*height_at(world, 0.6, 0.2), 0.4, 1e-6);
    EXPECT_NEAR(*height_at(world, 0.6 + 0.099, 0.2 - 0.099), 0.4, 1e-6);
    EXPECT_NEAR(*height_at(world, -0.4, 0.2), 0.1, 1e-6);
    EXPECT_FALSE(height_at(world, 0.1, 0.2));
  }
}

TEST(Shape, PlanesAreShiftedWithTheCentreOfMassToo) {
  BodyDefinition p;
  p.mass = 0.0;
  p.T_body_com = {{0.1, 0.2, 0.3}, math::from_rpy(0.1, 0.2, 0.3)};
  p.T_world_body = {{0, 0, 1}, {}};
  ShapeOptions options;
  options.T_body_com = p.T_body_com;
  options.moving = false;
  p.shape = make_shape({ground(0.25)}, options);
  Body body(p);
  World world;
  world.add(body);
  EXPECT_NEAR(*height_at(world, 3.0, -2.0), 1.25, 1e-9);
}

TEST(Shape, InertiaOfPrimitives) {
  const math::Vec3 ball = make_shape({sphere(0.2)}, {})->inertia(2.0);
  EXPECT_NEAR(ball.x, 0.4 * 2.0 * 0.04, 1e-9);
  const math::Vec3 cuboid = make_shape({box(0.1, 0.2, 0.3)}, {})->inertia(3.0);
  EXPECT_NEAR(cuboid.x, 3.0 / 12.0 * (0.04 + 0.09), 1e-9);
  EXPECT_NEAR(cuboid.z, 3.0 / 12.0 * (0.01 + 0.04), 1e-9);
  // No shape, no inertia; but a body can always turn.
  EXPECT_EQ(make_empty_shape()->inertia(1.0), (math::Vec3{}));
  BodyDefinition p;
  Body body(p);
  EXPECT_GT(body.inertia().x, 0.0);
}

std::pair<std::vector<math::Vec3>, std::vector<std::array<std::uint32_t, 3>>> ball_mesh(double radius, int rings) {
  std::vector<math::Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double polar = kPi * i / rings, turn = 2.0 * kPi * k / around;
      vertices.push_back(
          math::Vec3{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)} * radius);
    }
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const auto at = [around](int ring, int step) {
        return static_cast<std::uint32_t>(ring * around + step % around);
      };
      triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return {vertices, triangles};
}

using scene::CollisionMeshType;

TEST(MeshShape, EveryKindStandsWhereTheMeshIs) {
  const auto [vertices, triangles] = ball_mesh(0.2, 24);
  const MeshSource mesh(vertices, triangles);
  for (const auto type : {CollisionMeshType::convex_hull, CollisionMeshType::convex_mesh,
                          CollisionMeshType::triangle_mesh, CollisionMeshType::point_cloud}) {
    for (const bool moving : {true, false}) {
      BodyDefinition p;
      p.mass = moving ? 1.0 : 0.0;
      p.inertia = math::Vec3{0.01, 0.01, 0.01};
      p.T_body_com = {{0.1, -0.2, 0.3}, math::from_rpy(0.3, 0.2, 0.1)};
      ShapeOptions options;
      options.T_body_com = p.T_body_com;
      options.moving = moving;
      p.shape = mesh.shape(type, {{0, 0, 0.5}, {}}, options);
      Body body(p);
      World world;
      world.add(body);
      // The top vertex; a cloud of points can only be hit where a point is.
      const auto top = world.ray_cast({1e-4, 1e-4, 5.0}, {1e-4, 1e-4, -5.0});
      ASSERT_TRUE(top) << static_cast<int>(type) << moving;
      EXPECT_NEAR(top->point.z, 0.7, 3e-3) << static_cast<int>(type) << moving;
      EXPECT_EQ(p.shape->concave(), type == CollisionMeshType::triangle_mesh);
      if (type != CollisionMeshType::point_cloud) {
        const auto side = world.ray_cast({5, 0.01, 0.51}, {-5, 0.01, 0.51});
        ASSERT_TRUE(side);
        EXPECT_NEAR(side->point.x, 0.2, 0.012);
      }
    }
  }
}

TEST(MeshShape, IsSharedWhereEverythingIsEqual) {
  const auto [vertices, triangles] = ball_mesh(0.2, 8);
  const MeshSource mesh(vertices, triangles);
  ShapeOptions options;
  const SharedShape one = mesh.shape(CollisionMeshType::triangle_mesh, {}, options);
  EXPECT_EQ(one, mesh.shape(CollisionMeshType::triangle_mesh, {}, options));
  EXPECT_NE(one, mesh.shape(CollisionMeshType::convex_hull, {}, options));
  options.scale = 2.0;
  EXPECT_NE(one, mesh.shape(CollisionMeshType::triangle_mesh, {}, options));
}

TEST(MeshShape, OfOneMeshInTwoWorldsSharesWhatIsConstant) {
  mesh::CollisionMesh mesh;
  std::tie(mesh.vertices, mesh.triangles) = ball_mesh(0.2, 8);
  const auto shared = std::make_shared<const mesh::CollisionMesh>(mesh);
  const MeshSource one(shared), two(shared), another(std::make_shared<const mesh::CollisionMesh>(mesh));
  const auto shape = [](const MeshSource& of, const ShapeOptions& options = {}) {
    return of.shape(CollisionMeshType::triangle_mesh, {}, options);
  };
  const SharedShape first = shape(one), second = shape(two), third = shape(another);
  EXPECT_NE(first, second) << "each world has Bullet's shape for itself";
  EXPECT_EQ(first->data().surfaces.at(0), second->data().surfaces.at(0));
  EXPECT_NE(first->data().surfaces.at(0), third->data().surfaces.at(0));
  ShapeOptions wide;
  wide.margin *= 2;
  EXPECT_NE(first->data().surfaces.at(0), shape(two, wide)->data().surfaces.at(0));
}

TEST(MeshShape, AreWhatASourceIsKeptFor) {
  const auto [vertices, triangles] = ball_mesh(0.2, 8);
  const MeshSource mesh(vertices, triangles);
  EXPECT_FALSE(mesh.in_use());
  SharedShape shape = mesh.shape(CollisionMeshType::triangle_mesh, {}, {});
  EXPECT_TRUE(mesh.in_use());
  shape.reset();
  EXPECT_FALSE(mesh.in_use());
}

TEST(MeshShape, EmptyOrBrokenMeshesGiveTheEmptyShape) {
  EXPECT_TRUE(MeshSource({}, {}).shape(CollisionMeshType::convex_hull, {}, {})->empty());
  EXPECT_TRUE(MeshSource({{0, 0, 0}}, {{0, 1, 2}}).shape(CollisionMeshType::triangle_mesh, {}, {})->empty());
}

TEST(MeshShape, HullsOfManyPointsAreReduced) {
  const auto [vertices, triangles] = ball_mesh(0.2, 40);
  const MeshSource mesh(vertices, triangles);
  const SharedShape shape = mesh.shape(CollisionMeshType::convex_hull, {}, {});
  const BoundingBox box = shape->bounds();
  EXPECT_NEAR(box.max.x, 0.2, 0.02);
  // 64 points on a ball: inertia of a box around it stays close.
  EXPECT_GT(shape->inertia(1.0).x, 0.0);
}

TEST(MeshShape, MovingTriangleMeshRestsOnStaticOne) {
  const auto [vertices, triangles] = ball_mesh(0.1, 12);
  const MeshSource ball(vertices, triangles);
  const MeshSource floor({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  ShapeOptions fixed;
  fixed.moving = false;
  BodyDefinition floor_parameters, ball_parameters;
  floor_parameters.mass = 0.0;
  floor_parameters.shape = floor.shape(CollisionMeshType::triangle_mesh, {}, fixed);
  ball_parameters.shape = ball.shape(CollisionMeshType::triangle_mesh, {}, {});
  ball_parameters.T_world_body.position = {0.013, 0.021, 0.12};
  Body ground_body(floor_parameters), body(ball_parameters);
  World world;
  world.add(ground_body);
  world.add(body);
  run(world, 2.0);
  EXPECT_NEAR(body.pose().position.z, 0.1, 0.006);
}

// Four pegs of a board stand inside four rings made of boxes; rings are compounds with a hole.
TEST(Shape, CompoundRingHangsOnAPeg) {
  std::vector<scene::PlacedGeometry> ring;
  for (int i = 0; i < 12; ++i) {
    const math::Quat turn = math::from_axis_angle({0, 0, 1}, 2.0 * kPi * i / 12);
    ring.push_back(box(0.004, 0.009, 0.004, {math::rotate(turn, {0.015, 0, 0}), turn}));
  }
  Body board(parameters(0.0, {ground()}, {}));
  scene::PlacedGeometry peg_part;
  peg_part.geometry.shape = scene::Shape::cylinder;
  peg_part.geometry.radius = 0.004;
  peg_part.geometry.height = 0.03;
  Body peg(parameters(0.0, {peg_part}, {0, 0, 0.015})), hoop(parameters(0.01, ring, {0.004, 0, 0.05}));
  World world;
  world.add(board);
  world.add(peg);
  world.add(hoop);
  run(world, 1.5);
  EXPECT_NEAR(hoop.pose().position.z, 0.002, 0.001);
  EXPECT_LT(std::hypot(hoop.pose().position.x, hoop.pose().position.y), 0.012);
  // It cannot leave sideways.
  for (int i = 0; i < 1500; ++i) {
    hoop.apply_force({0.05, 0, 0}, hoop.com_pose().position);
    world.step();
  }
  EXPECT_LT(hoop.pose().position.x, 0.013);
}

}  // namespace
}  // namespace ambf::physics
