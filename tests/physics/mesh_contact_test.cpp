// Moving triangle meshes in contact: they rest, carry, are held and bounce as solid bodies do, whatever they touch.
#include <gtest/gtest.h>

#include "tests/physics/fixtures.h"
#include "tests/physics/mesh_scene.h"

namespace ambf::physics {
namespace {

using namespace testing;

double upward_impulse(const World& world, const Body& on) {
  std::vector<Contact> contacts(256);
  contacts.resize(std::min(contacts.size(), world.contacts(contacts)));
  double sum = 0.0;
  for (const Contact& contact : contacts) {
    const math::Vec3 on_a = contact.normal_on_b * contact.normal_impulse + contact.friction_impulse;
    if (contact.body_a == &on) sum += on_a.z;
    if (contact.body_b == &on) sum -= on_a.z;
  }
  return sum;
}

// After a second of settling: nothing moves in the next ten, and the contacts carry the weight.
void expect_rest(Scene& scene, std::size_t i, double height, double tolerance = 3e-4) {
  run(scene.world, 1.0);
  const math::Pose before = scene[i].com_pose();
  EXPECT_NEAR(before.position.z, height, tolerance);
  run(scene.world, 10.0);
  const math::Pose after = scene[i].com_pose();
  EXPECT_LT(math::norm(after.position - before.position), 2e-5);
  EXPECT_LT(angle_between(after.orientation, before.orientation), 2e-4);
  EXPECT_NEAR(upward_impulse(scene.world, scene[i]), scene[i].mass() * 9.81e-3, 0.02 * scene[i].mass() * 9.81e-3);
}

const math::Vec3 kBlock{0.06, 0.1, 0.04};

TEST(MeshContact, BlockRestsOnABox) {
  for (const int cells : {1, 6})
    for (const bool inside_out : {false, true}) {
      const TestMesh mesh = box_mesh(kBlock, cells);
      Scene scene({parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}),
                   mesh_body(0.3, inside_out ? mesh.turned() : mesh, {0.1, 0.2, 0.03})});
      expect_rest(scene, 1, 0.02 + kMargin);
    }
}

TEST(MeshContact, BlockRestsOnAStaticMesh) {
  for (const int cells : {1, 40}) {
    Scene scene({mesh_body(0.0, sheet_mesh(2.0, cells), {}), mesh_body(0.3, box_mesh(kBlock, 2), {0.1, 0.13, 0.03})});
    expect_rest(scene, 1, 0.02 + 2 * kMargin);
  }
}

TEST(MeshContact, BlockRestsOnThinAndOpenMeshesWhateverTheirWinding) {
  for (const bool inside_out : {false, true}) {
    const TestMesh sheet = sheet_mesh(1.0, 5);
    Scene scene(
        {mesh_body(0.0, inside_out ? sheet.turned() : sheet, {}), mesh_body(0.3, box_mesh(kBlock), {0, 0, 0.03})});
    expect_rest(scene, 1, 0.02 + 2 * kMargin);
  }
  Scene thin({mesh_body(0.0, box_mesh({0.5, 0.5, 0.001}), {}), mesh_body(0.3, box_mesh(kBlock), {0, 0, 0.03})});
  expect_rest(thin, 1, 0.0005 + 0.02 + 2 * kMargin);
}

// No corner of one is near the other: only edges touch.
TEST(MeshContact, BarsRestAcross) {
  Scene scene(
      {mesh_body(0.0, box_mesh({1.0, 0.05, 0.05}), {}), mesh_body(0.5, box_mesh({0.05, 1.0, 0.05}), {0.0, 0.0, 0.06})});
  expect_rest(scene, 1, 0.05 + 2 * kMargin);
}

TEST(MeshContact, MeshesStack) {
  Scene scene({parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}), mesh_body(0.3, box_mesh(kBlock, 3), {0, 0, 0.0215}),
               mesh_body(0.3, box_mesh(kBlock, 2), {0.004, 0.003, 0.065}),
               mesh_body(0.3, ring_mesh(0.02, 0.006, 24, 12), {0, 0, 0.097})});
  run(scene.world, 1.0);
  const double heights[] = {0.0, 0.02 + kMargin, 0.06 + 3 * kMargin, 0.086 + 5 * kMargin};
  std::vector<math::Vec3> before;
  for (std::size_t i = 1; i < 4; ++i) {
    before.push_back(scene[i].com_pose().position);
    EXPECT_NEAR(before.back().z, heights[i], 5e-4) << i;
  }
  run(scene.world, 10.0);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LT(math::norm(scene[i].com_pose().position - before[i - 1]), 1e-4) << i;
}

TEST(MeshContact, EveryConvexShapeRestsOnAMesh) {
  for (const auto kind :
       {scene::Shape::box, scene::Shape::sphere, scene::Shape::capsule, scene::Shape::cylinder, scene::Shape::cone}) {
    scene::PlacedGeometry part = box(0.04, 0.04, 0.04);
    part.geometry.shape = kind;
    part.geometry.radius = 0.02;
    part.geometry.height = 0.04;
    const math::Vec3 at{0.003, 0.002, 0.085};
    Scene scene({parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}),
                 mesh_body(5.0, box_mesh({0.3, 0.3, 0.06}, 3), {0, 0, 0.031}), parameters(0.1, {part}, at)});
    run(scene.world, 1.0);
    const math::Pose before = scene[2].com_pose();
    const double above = kind == scene::Shape::cone ? 0.021 : 0.02;  // Bullet puts a cone's margin around it
    EXPECT_NEAR(before.position.z, 0.06 + above + 2 * kMargin, 5e-4) << static_cast<int>(kind);
    run(scene.world, 5.0);
    EXPECT_LT(math::norm(scene[2].com_pose().position - before.position), 2e-4) << static_cast<int>(kind);
  }
}

// A ring goes over a peg and cannot leave it sideways.
TEST(MeshContact, RingHangsOnAPeg) {
  Scene scene({parameters(0.0, {box(2, 2, 0.2), box(0.02, 0.02, 0.2, {{0, 0, 0.15}, {}})}, {0, 0, -0.1}),
               mesh_body(0.05, ring_mesh(0.025, 0.004, 36, 12), {0.005, 0.002, 0.08})});
  run(scene.world, 1.0);
  EXPECT_NEAR(scene[1].com_pose().position.z, 0.004 + kMargin, 5e-4);
  for (int i = 0; i < 2000; ++i) {
    scene[1].apply_force({0.3, 0, 0}, scene[1].com_pose().position);
    scene.world.step();
  }
  EXPECT_LT(scene[1].com_pose().position.x, 0.015);
  EXPECT_LT(scene[1].com_pose().position.z, 0.01);
}

TEST(MeshContact, BouncesAsItsRestitutionSays) {
  const auto rise = [](double restitution) {
    std::vector<BodyDefinition> all{parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}),
                                    mesh_body(0.3, box_mesh(kBlock, 2), {0, 0, 0.121})};
    for (BodyDefinition& p : all) {
      p.surface.restitution = restitution;
      p.surface.linear_damping = p.surface.angular_damping = 0.0;
    }
    Scene scene(all);
    run(scene.world, 0.17);  // 0.1 m down take 0.143 s
    double highest = 0.0;
    for (int i = 0; i < 150; ++i) {
      scene.world.step();
      highest = std::max(highest, scene[1].com_pose().position.z - 0.021);
    }
    return highest;
  };
  EXPECT_LT(rise(0.0), 0.002);
  EXPECT_NEAR(rise(0.7), 0.49 * 0.49 * 0.1, 0.02);  // restitutions are multiplied
}

TEST(MeshContact, ReportsWhereAndHowHardItTouches) {
  Scene scene({parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}), mesh_body(0.3, box_mesh(kBlock, 4), {0, 0, 0.021})});
  run(scene.world, 1.0);
  std::vector<Contact> contacts(64);
  contacts.resize(scene.world.contacts(contacts));
  ASSERT_EQ(contacts.size(), 4u);  // the corners of its lower face
  double impulse = 0.0;
  for (const Contact& contact : contacts) {
    const bool mesh_is_a = contact.body_a == &scene[1];
    EXPECT_EQ(contact.body_b, mesh_is_a ? &scene[0] : &scene[1]);
    EXPECT_NEAR((mesh_is_a ? 1.0 : -1.0) * contact.normal_on_b.z, 1.0, 1e-6);
    EXPECT_NEAR(contact.distance, 0.0, 1e-4);
    for (const math::Vec3& point : {contact.point_on_a, contact.point_on_b}) {
      EXPECT_NEAR(std::abs(point.x), 0.5 * kBlock.x, 1e-4);
      EXPECT_NEAR(std::abs(point.y), 0.5 * kBlock.y, 1e-4);
      EXPECT_NEAR(point.z, 0.0, 1e-4);  // on the floor, and on the margin of the mesh
    }
    impulse += contact.normal_impulse;
  }
  EXPECT_NEAR(impulse, 0.3 * 9.81e-3, 1e-5);
}

// Vertices run over the edges between the triangles of a floor without noticing.
TEST(MeshContact, SlidesOverInternalEdges) {
  for (const int cells : {1, 30}) {
    Scene scene(
        {mesh_body(0.0, sheet_mesh(1.0, cells), {}), mesh_body(0.3, box_mesh(kBlock, 3), {-0.2, 0.013, 0.0221})});
    run(scene.world, 0.2);
    scene[1].apply_impulse({0.3, 0, 0}, scene[1].com_pose().position);
    for (int i = 0; i < 600; ++i) {
      scene.world.step();
      EXPECT_NEAR(scene[1].com_pose().position.z, 0.022, 1e-4);
    }
    // 1 m/s and the friction coefficient 0.25, both squared products of 0.5.
    EXPECT_NEAR(scene[1].com_pose().position.x, -0.2 + 1.0 / (2.0 * 0.25 * 9.81), 0.005);
    EXPECT_NEAR(scene[1].com_pose().position.y, 0.013, 1e-4);
  }
}

// So fine that not all pairs of triangles are looked at.
TEST(MeshContact, VeryFineMeshesRestToo) {
  const TestMesh fine = box_mesh(kBlock, 40);
  Scene on_box({parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}), mesh_body(0.3, fine, {0.01, 0.013, 0.0211})});
  expect_rest(on_box, 1, 0.02 + kMargin);
  Scene on_mesh({mesh_body(0.0, sheet_mesh(0.5, 200), {}), mesh_body(0.3, fine, {0.01, 0.013, 0.0221})});
  expect_rest(on_mesh, 1, 0.02 + 2 * kMargin);
}

// A round shape covers far more triangles than are looked at one by one; that below it is among these.
TEST(MeshContact, RoundShapesRestOnVeryFineMeshes) {
  for (const auto kind : {scene::Shape::sphere, scene::Shape::capsule, scene::Shape::cylinder}) {
    scene::PlacedGeometry part = box(0.1, 0.1, 0.1);
    part.geometry.shape = kind;
    part.geometry.radius = 0.05;
    part.geometry.height = 0.1;
    Scene scene({parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}),
                 mesh_body(5.0, box_mesh({0.3, 0.3, 0.06}, 150), {0, 0, 0.031}),
                 parameters(0.5, {part}, {0.0031, 0.0022, 0.113})});
    run(scene.world, 2.0);
    EXPECT_NEAR(scene[2].com_pose().position.z, 0.06 + 0.05 + 2 * kMargin, 1e-3) << static_cast<int>(kind);
  }
}

// Faces of the far side of a thin plate are no nearer way out.
TEST(MeshContact, OpenMeshesRestOnThinPlates) {
  for (const int cells : {1, 10}) {
    Scene scene({mesh_body(0.0, box_mesh({0.5, 0.5, 0.001}, cells), {}),
                 mesh_body(0.1, sheet_mesh(0.1, 4), {0.013, 0.011, 0.0030})});
    run(scene.world, 2.0);
    EXPECT_NEAR(scene[1].com_pose().position.z, 0.0005 + 2 * kMargin, 3e-4) << cells;
  }
}

// Two faces back to back make a blade, whose edge is as sharp as can be.
TEST(MeshContact, EdgesOfTwoSidedSheetsTouch) {
  TestMesh sheet = sheet_mesh(1.0, 1);
  const TestMesh back = sheet.turned();
  sheet.triangles.insert(sheet.triangles.end(), back.triangles.begin(), back.triangles.end());
  // Upright, below a bar: no corner is near anything.
  Scene scene({mesh_body(0.0, sheet, {0, 0, -0.5}, math::from_rpy(0.5 * kPi, 0, 0)),
               mesh_body(0.0, sheet, {0.2, 0, -0.5}, math::from_rpy(0.5 * kPi, 0, 0)),
               mesh_body(0.5, box_mesh({0.05, 1.0, 0.05}), {0.0, 0.0, 0.03})});
  run(scene.world, 0.3);
  EXPECT_NEAR(scene[2].com_pose().position.z, 0.025 + 2 * kMargin, 5e-4);
}

// A closed static mesh that faces inward is a room, and holds what is in it; or it is wound the wrong way, and carries
// what is on it.
TEST(MeshContact, StaticMeshesThatFaceInwardAreRoomsAndCarry) {
  for (const double side : {-1.0, 1.0}) {
    const double height = 0.5 * side + 0.02 + 2 * kMargin;
    Scene scene({mesh_body(0.0, box_mesh({1.0, 1.0, 1.0}, 2).turned(), {}),
                 mesh_body(0.3, box_mesh(kBlock, 2), {0.1, 0.13, height + 0.008})});
    expect_rest(scene, 1, height);
  }
}

TEST(MeshContact, SurvivesMeshesAndPosesThatAreNoNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  TestMesh broken = box_mesh(kBlock, 3);
  for (const double value : {nan, inf, 1e200, 1e150}) {
    const auto first = static_cast<std::uint32_t>(broken.vertices.size());
    broken.vertices.push_back({value, 0, 0});
    broken.triangles.push_back({first, 0, 1});
    broken.triangles.push_back({first, first, first});
  }
  Scene scene({parameters(0.0, {box(2, 2, 0.2)}, {0, 0, -0.1}), mesh_body(0.3, broken, {0, 0, 0.02}),
               mesh_body(0.3, box_mesh(kBlock, 20), {0, 0, 0.05}), mesh_body(0.3, box_mesh(kBlock, 20), {0, 0, 0.09})});
  run(scene.world, 0.05);
  scene[2].set_twist({{nan, nan, nan}, {}});
  run(scene.world, 0.05);
  EXPECT_NE(scene.world.first_diverged(), nullptr);
}

// Rings of 4096 triangles each, all at nearly one place.
std::vector<BodyDefinition> crowd(int count, double apart) {
  const SharedShape shape = ring_mesh(0.05, 0.02, 64, 32).shape();
  std::vector<BodyDefinition> all;
  for (int i = 0; i < count; ++i) {
    BodyDefinition p;
    p.mass = 0.2;
    p.shape = shape;
    p.T_world_body = {{apart * i, 0.4 * apart * i, 0.1 * apart * i}, math::from_rpy(0.7 * i, 0.4 * i, 0.0)};
    p.gravity = math::Vec3{0, 0, 0};
    all.push_back(p);
  }
  return all;
}

TEST(MeshContact, CrowdsStayAffordableAndFinite) {
  constexpr int kSteps = 300;
  const auto cost_per_step = [](Scene& scene) {
    for (int i = 0; i < 20; ++i) scene.world.step();
    const double start = thread_cpu_s();
    for (int i = 0; i < kSteps; ++i) scene.world.step();
    return (thread_cpu_s() - start) / kSteps;
  };
  // What two such rings take whose surfaces cross.
  std::vector<BodyDefinition> two = crowd(2, 0.01);
  Scene pair(two);
  const double of_pair = cost_per_step(pair);
  Scene crowded(crowd(24, 0.001));
  const double of_crowd = cost_per_step(crowded);
  EXPECT_LT(of_crowd, 30.0 * of_pair) << of_pair << " " << of_crowd;  // and not as its 276 meetings
  EXPECT_GT(crowded.world.crowded_steps(), 0u);
  EXPECT_NE(crowded.world.max_depth_meshes()[0], nullptr);
  EXPECT_EQ(crowded.world.first_diverged(), nullptr);
  double fastest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    crowded.world.step();
    for (std::size_t k = 0; k < 24; ++k) fastest = std::max(fastest, math::norm(crowded[k].twist().linear));
  }
  EXPECT_LT(fastest, 5.0);
}

TEST(MeshContact, IsDeterministicAlsoInCrowds) {
  const auto end_of = [](std::vector<math::Pose>& poses) {
    Scene scene(crowd(8, 0.002));
    run(scene.world, 0.5);
    for (std::size_t i = 0; i < 8; ++i) poses.push_back(scene[i].com_pose());
    return scene.world.crowded_steps();
  };
  std::vector<math::Pose> first, second;
  EXPECT_GT(end_of(first), 0u);
  end_of(second);
  EXPECT_TRUE(first == second);
}

TEST(MeshContact, ContinuesAlikeAfterASnapshot) {
  Scene one(crowd(6, 0.004)), other(crowd(6, 0.004));
  run(one.world, 0.3);
  std::vector<std::byte> saved;
  one.world.save_state(saved);
  ASSERT_TRUE(other.world.restore_state(saved));
  for (Scene* scene : {&one, &other}) run(scene->world, 0.3);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(one[i].com_pose() == other[i].com_pose());
}

}  // namespace
}  // namespace ambf::physics
