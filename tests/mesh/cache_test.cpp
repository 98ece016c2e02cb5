#include "mesh/cache.h"

#include <thread>

#include "mesh/primitives.h"
#include "tests/mesh/files.h"

namespace ambf::mesh {
namespace {

using namespace test;  // NOLINT

TEST(MeshCache, SameFileTwentyTimesIsDecodedOnce) {
  const Folder folder;
  const std::string path = folder.write("a.stl", binary_stl(corners_of(make_box(1, 1, 1))));
  MeshCache cache;
  const CachedMesh first = cache.load(path);
  ASSERT_NE(first.mesh, nullptr);
  for (int i = 0; i < 19; ++i) EXPECT_EQ(cache.load(path).mesh, first.mesh);
  EXPECT_EQ(cache.statistics().requests, 20U);
  EXPECT_EQ(cache.statistics().decodes, 1U);
  EXPECT_EQ(cache.statistics().meshes_held, 1U);
}

TEST(MeshCache, EqualContentUnderOtherNamesIsDecodedOnce) {
  const Folder folder;
  const std::string bytes = binary_stl(corners_of(make_box(1, 1, 1)));
  folder.write("high/a.stl", bytes);
  folder.write("low/b.STL", bytes);
  std::filesystem::create_symlink(folder / "high/a.stl", folder / "link.stl");
  MeshCache cache;
  const auto mesh = cache.load(folder / "high/a.stl").mesh;
  EXPECT_EQ(cache.load(folder / "low/b.STL").mesh, mesh);
  EXPECT_EQ(cache.load(folder / "link.stl").mesh, mesh);
  EXPECT_EQ(cache.load(folder / "high/../low/b.STL").mesh, mesh);
  EXPECT_EQ(cache.statistics().decodes, 1U);
}

TEST(MeshCache, ThreadsAskingAtOnceShareOneDecoding) {
  const Folder folder;
  const std::string path = folder.write("a.stl", binary_stl(corners_of(make_sphere(1, 200))));
  MeshCache cache;
  const auto all = cache.load_many(std::vector<std::string>(40, path), 8);
  for (const CachedMesh& one : all) EXPECT_EQ(one.mesh, all[0].mesh);
  EXPECT_NE(all[0].mesh, nullptr);
  EXPECT_EQ(cache.statistics().decodes, 1U);
}

TEST(MeshCache, ManyFilesComeBackInOrderWithTheirErrors) {
  const Folder folder;
  std::vector<std::string> paths;
  for (int i = 0; i < 30; ++i) {
    paths.push_back(i % 10 == 7
                        ? folder / "missing.stl"
                        : folder.write(std::to_string(i) + ".stl", binary_stl(corners_of(make_box(1 + i, 1, 1)))));
  }
  MeshCache cache;
  const auto all = cache.load_many(paths, 4);
  ASSERT_EQ(all.size(), paths.size());
  for (int i = 0; i < 30; ++i) {
    if (i % 10 == 7) {
      EXPECT_EQ(all[i].mesh, nullptr);
      EXPECT_TRUE(base::has_errors(all[i].diagnostics));
    } else {
      ASSERT_NE(all[i].mesh, nullptr);
      EXPECT_NEAR(all[i].mesh->bounds.size().x, 1 + i, 1e-5);
    }
  }
}

TEST(MeshCache, EditedFileIsLoadedAgainEvenWithinOneTickOfTheFileSystem) {
  const Folder folder;
  MeshCache cache;
  for (int i = 0; i < 20; ++i) {
    // Same name, same size, written in quick succession.
    const std::string path = folder.write("a.stl", binary_stl(corners_of(make_box(1 + i, 1, 1))));
    const auto mesh = cache.load(path).mesh;
    ASSERT_NE(mesh, nullptr);
    ASSERT_NEAR(mesh->bounds.size().x, 1 + i, 1e-5);
  }
}

TEST(MeshCache, EditedLibraryAndAppearingTextureLoadTheMeshAgain) {
  const Folder folder;
  folder.write("a.mtl", "newmtl m\nKd 1 0 0\nmap_Kd wood.png\n");
  const std::string path =
      folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
  MeshCache cache;
  const CachedMesh red = cache.load(path);
  ASSERT_NE(red.mesh, nullptr);
  EXPECT_EQ(red.mesh->materials[0].diffuse.r, 1.0F);
  ASSERT_EQ(red.diagnostics.size(), 1U);
  // The warning is repeated at every hit: each body that names the mesh can report it.
  EXPECT_EQ(cache.load(path).diagnostics.size(), 1U);
  EXPECT_EQ(cache.statistics().decodes, 1U);
  folder.write("wood.png", "x");
  const CachedMesh textured = cache.load(path);
  EXPECT_TRUE(textured.diagnostics.empty());
  EXPECT_EQ(textured.mesh->materials[0].texture_file, folder / "wood.png");
  folder.write("a.mtl", "newmtl m\nKd 0 1 0\nmap_Kd wood.png\n");
  EXPECT_EQ(cache.load(path).mesh->materials[0].diffuse.g, 1.0F);
  EXPECT_EQ(cache.statistics().decodes, 3U);
  EXPECT_EQ(cache.statistics().meshes_held, 1U);
}

TEST(MeshCache, EqualObjInTwoFoldersKeepsItsOwnMaterials) {
  const Folder folder;
  const std::string obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
  folder.write("one/a.mtl", "newmtl m\nKd 1 0 0\n");
  folder.write("two/a.mtl", "newmtl m\nKd 0 1 0\n");
  MeshCache cache;
  EXPECT_EQ(cache.load(folder.write("one/a.obj", obj)).mesh->materials[0].diffuse.r, 1.0F);
  EXPECT_EQ(cache.load(folder.write("two/a.obj", obj)).mesh->materials[0].diffuse.g, 1.0F);
}

TEST(MeshCache, FailureIsNotRemembered) {
  const Folder folder;
  const std::string path = folder / "a.stl";
  MeshCache cache;
  EXPECT_EQ(cache.load(path).mesh, nullptr);
  folder.write("a.stl", "broken");
  EXPECT_EQ(cache.load(path).mesh, nullptr);
  folder.write("a.stl", binary_stl(corners_of(make_box(1, 1, 1))));
  EXPECT_NE(cache.load(path).mesh, nullptr);
}

TEST(MeshCache, DiagnosticsNameThePathOfTheCall) {
  const Folder folder;
  const std::string bytes = square_ply_ascii();  // with endings that do not fit: a warning
  folder.write("one.stl", bytes);
  folder.write("two.stl", bytes);
  MeshCache cache;
  cache.load(folder / "one.stl");
  const CachedMesh two = cache.load(folder / "two.stl");
  ASSERT_EQ(two.diagnostics.size(), 1U);
  EXPECT_EQ(two.diagnostics[0].file, folder / "two.stl");
  EXPECT_EQ(cache.statistics().decodes, 1U);
}

TEST(MeshCache, ProductsAreMadeOncePerKind) {
  const Folder folder;
  const std::string path = folder.write("a.stl", binary_stl(corners_of(make_sphere(1, 40))));
  MeshCache cache;
  const auto mesh = cache.load(path).mesh;
  const auto collision = cache.collision_mesh(mesh);
  ASSERT_NE(collision, nullptr);
  const auto hull = cache.hull(mesh);
  EXPECT_LE(hull->points.size(), 64U);
  EXPECT_EQ(cache.collision_mesh(cache.load(path).mesh), collision);
  EXPECT_EQ(cache.hull(cache.load(path).mesh), hull);
  EXPECT_NE(cache.hull(mesh, {16, 1e-4}), hull);
  EXPECT_LE(cache.hull(mesh, {16, 1e-4})->points.size(), 16U);
  EXPECT_TRUE(cache.mass_properties(mesh)->closed);
  EXPECT_EQ(cache.statistics().products, 4U);
  // A mesh from elsewhere works too.
  EXPECT_EQ(cache.hull(std::make_shared<const Mesh>(make_box(1, 1, 1)))->points.size(), 8U);
}

TEST(MeshCache, TrimFreesWhatNobodyHolds) {
  const Folder folder;
  MeshCache cache;
  std::shared_ptr<const Mesh> held =
      cache.load(folder.write("held.stl", binary_stl(corners_of(make_box(1, 1, 1))))).mesh;
  auto dropped = cache.load(folder.write("dropped.stl", binary_stl(corners_of(make_box(2, 1, 1))))).mesh;
  auto with_hull = cache.load(folder.write("hull.stl", binary_stl(corners_of(make_box(3, 1, 1))))).mesh;
  auto hull = cache.hull(with_hull);
  const std::weak_ptr<const Mesh> watch = dropped;
  dropped.reset();
  with_hull.reset();
  EXPECT_EQ(cache.trim(), 1U);
  EXPECT_TRUE(watch.expired());
  EXPECT_EQ(cache.statistics().meshes_held, 2U);
  hull.reset();
  EXPECT_EQ(cache.trim(), 1U);
  EXPECT_EQ(cache.load(folder / "held.stl").mesh, held);
  EXPECT_EQ(cache.statistics().decodes, 3U);
  EXPECT_NE(cache.load(folder / "dropped.stl").mesh, nullptr);
  EXPECT_EQ(cache.statistics().decodes, 4U);
}

TEST(MeshCache, LoadingTrimmingAndProductsFromManyThreads) {
  const Folder folder;
  std::vector<std::string> paths;
  for (int i = 0; i < 6; ++i)
    paths.push_back(folder.write(std::to_string(i) + ".stl", binary_stl(corners_of(make_box(1 + i, 1, 1)))));
  MeshCache cache;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 60; ++i) {
        const auto mesh = cache.load(paths[(i + t) % paths.size()]).mesh;
        ASSERT_NE(mesh, nullptr);
        const auto hull = cache.hull(mesh);
        ASSERT_EQ(hull->points.size(), 8U);
        ASSERT_EQ(cache.collision_mesh(mesh)->vertices.size(), 8U);
        if (i % 10 == t) cache.trim();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  cache.trim();
  EXPECT_EQ(cache.statistics().meshes_held, 0U);
}

}  // namespace
}  // namespace ambf::mesh
