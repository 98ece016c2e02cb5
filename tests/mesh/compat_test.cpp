// Every mesh of the compatibility models loads, and agrees with assimp, an independent reader, in triangles and extent.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <set>

#include "mesh/cache.h"
#include "tests/mesh/files.h"
#include "tests/support/compat_models.h"

namespace ambf::mesh {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> compat_meshes() {
  std::vector<std::string> paths;
  std::error_code error;
  for (fs::recursive_directory_iterator it(compat::folder(), error), end; !error && it != end; it.increment(error)) {
    std::string ending = it->path().extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(c));
    if (ending == ".stl" || ending == ".obj" || ending == ".3ds" || ending == ".dae" || ending == ".ply") {
      paths.push_back(it->path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

// Corners of all triangles as assimp reads them.
std::vector<math::Vec3> read_with_assimp(const std::string& path) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  std::vector<math::Vec3> corners;
  for (unsigned m = 0; scene != nullptr && m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices != 3) continue;
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& p = mesh.mVertices[mesh.mFaces[f].mIndices[k]];
        corners.push_back({p.x, p.y, p.z});
      }
    }
  }
  return corners;
}

// Triangles that welding leaves an area.
std::size_t count_triangles(const std::vector<math::Vec3>& corners, double epsilon) {
  std::size_t count = 0;
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    const math::Vec3 &a = corners[t], &b = corners[t + 1], &c = corners[t + 2];
    count += std::min({math::norm(a - b), math::norm(b - c), math::norm(c - a)}) > epsilon ? 1 : 0;
  }
  return count;
}

TEST(CompatMeshes, AllLoadAndAgreeWithAnIndependentReader) {
  AMBF_NEEDS_COMPAT();
  const std::vector<std::string> paths = compat_meshes();
  ASSERT_FALSE(paths.empty());
  MeshCache cache;
  const std::vector<CachedMesh> meshes = cache.load_many(paths);
  std::set<const Mesh*> compared;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    ASSERT_NE(meshes[i].mesh, nullptr) << paths[i] << "\n" << test::text_of(meshes[i].diagnostics);
    for (const base::Diagnostic& d : meshes[i].diagnostics) {
      // Textures of other machines are the only thing to complain about.
      EXPECT_TRUE(d.severity == base::Severity::information || d.message.find("texture") == 0) << to_string(d);
    }
    if (!compared.insert(meshes[i].mesh.get()).second) continue;
    const Mesh& mesh = *meshes[i].mesh;
    test::expect_sound(mesh);
    const std::vector<math::Vec3> reference = read_with_assimp(paths[i]);
    const BoundingBox bounds = bounds_of(reference);
    EXPECT_EQ(mesh.triangle_count(), count_triangles(reference, 1e-6 * bounds.diagonal())) << paths[i];
    EXPECT_LT(math::norm(mesh.bounds.min - bounds.min), 2e-6 * bounds.diagonal()) << paths[i];
    EXPECT_LT(math::norm(mesh.bounds.max - bounds.max), 2e-6 * bounds.diagonal()) << paths[i];
  }
  EXPECT_LT(compared.size(), paths.size());  // some files are equal: they were decoded once
  EXPECT_EQ(cache.statistics().decodes, compared.size());
}

}  // namespace
}  // namespace ambf::mesh
