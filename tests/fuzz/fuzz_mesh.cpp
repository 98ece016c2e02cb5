// Any bytes given as a mesh file end in a sound mesh or in exactly one error. The first byte chooses the format, the
// rest is the file.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "mesh/hull.h"
#include "mesh/loader.h"
#include "mesh/mass_properties.h"
#include "mesh/weld.h"

namespace {

using namespace ambf;

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

void check(const mesh::Mesh& m) {
  for (const mesh::Submesh& s : m.submeshes) {
    const std::size_t n = s.vertex_count();
    require(s.positions.size() == 3 * n && s.normals.size() == 3 * n, "a normal per vertex");
    require(s.texcoords.empty() || s.texcoords.size() == 2 * n, "texture coordinates for all or none");
    require(s.tangents.empty() || s.tangents.size() == 4 * n, "tangents for all or none");
    require(s.material < static_cast<int>(m.materials.size()), "materials exist");
    for (std::uint32_t index : s.triangles) require(index < n, "triangle indices in range");
    for (const auto& line : s.lines) require(line[0] < n && line[1] < n, "line indices in range");
    for (const auto* values : {&s.positions, &s.normals, &s.texcoords, &s.tangents}) {
      for (float value : *values) require(std::isfinite(value), "finite numbers");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static const char* const kNames[] = {"nowhere/a.stl", "nowhere/a.obj", "nowhere/a.ply", "nowhere/a.3ds",
                                       "nowhere/a.dae"};
  if (size == 0) return 0;
  mesh::LoadOptions options;
  options.max_triangles = 20000;
  options.max_vertices = 60000;
  options.second_reader = false;  // a process for each of thousands of files
  const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  const mesh::LoadResult result = mesh::load_bytes(bytes, kNames[data[0] % std::size(kNames)], options);
  std::size_t errors = 0;
  for (const base::Diagnostic& d : result.diagnostics) errors += d.severity == base::Severity::error ? 1 : 0;
  require(errors == (result.ok ? 0U : 1U), "a mesh or one error");
  if (!result.ok) return 0;
  check(result.mesh);
  // What the loader makes of it next must stand it too.
  const mesh::CollisionMesh collision = mesh::make_collision_mesh(result.mesh);
  const mesh::MassProperties mass = mesh::mass_properties(collision);
  require(!std::isnan(mass.area), "an area");
  if (collision.vertices.size() < 2000)
    require(mesh::reduce_hull(collision.vertices).points.size() <= 64, "a hull of at most 64 points");
  return 0;
}
