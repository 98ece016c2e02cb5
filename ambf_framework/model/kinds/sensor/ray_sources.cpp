// Where the rays of a sensor come from: its lists, or a mesh, wrapped onto another one or as it is.
#include "math/rotation.h"
#include "mesh/cache.h"
#include "mesh/wrap.h"
#include "model/kinds/sensor/detail/ray_layout.h"

namespace ambf::model {

namespace {

constexpr std::size_t kMaxRays = 65536;            // of one sensor
constexpr std::size_t kMaxWrapWork = 400'000'000;  // vertices times triangles, a few seconds

std::shared_ptr<const mesh::CollisionMesh> first_mesh(mesh::MeshCache& meshes, const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (const auto mesh = meshes.load(file).mesh; mesh != nullptr) return meshes.collision_mesh(mesh);
  return nullptr;
}

// The mesh of rays, laid onto `wrap: onto`; null, and an error, when nothing of it is left.
std::shared_ptr<const mesh::CollisionMesh> wrap(mesh::MeshCache& meshes, const mesh::CollisionMesh& patch,
                                                const scene::Sensor& described, const scene::Identity& at,
                                                Findings& findings) {
  const auto found = first_mesh(meshes, described.wrap.onto_files);
  const std::size_t work = found == nullptr ? 0 : patch.vertices.size() * found->triangles.size();
  if (work == 0 || work > kMaxWrapWork) {
    findings.error(at, "wrap/onto",
                   work == 0 ? std::string("expected two meshes of triangles, found none")
                             : std::to_string(patch.vertices.size()) + " vertices onto " +
                                   std::to_string(found->triangles.size()) + " triangles take too long",
                   "the sensor is left out");
    return nullptr;
  }
  mesh::CollisionMesh onto = *found;
  const math::Pose T_sensor_parent = math::inverse(described.T_parent_sensor);
  for (math::Vec3& vertex : onto.vertices)  // to the frame and scale of the patch
    vertex = T_sensor_parent * (vertex * described.mesh_scale) / described.mesh_scale;
  auto skin =
      std::make_shared<mesh::CollisionMesh>(mesh::wrapped(patch, onto, described.wrap.offset_m / described.mesh_scale));
  if (skin->triangles.empty()) {
    findings.error(at, "wrap", "no triangle of the mesh of rays looks at the mesh that it shall be wrapped onto",
                   "the sensor is left out: its normals must point at that mesh, from outside");
    return nullptr;
  }
  const std::size_t lost = patch.triangles.size() - skin->triangles.size();
  if (lost > 0)
    findings.information(at, "wrap",
                         std::to_string(lost) + " of " + std::to_string(patch.triangles.size()) +
                             " triangles meet nothing and are left out");
  return skin;
}

}  // namespace

bool lay_rays(mesh::MeshCache& meshes, const scene::Sensor& described, const scene::Identity& at,
              std::vector<state::SensorRay>& rays, Findings& findings, state::SensorInfo& info) {
  rays = listed_rays(described);
  std::shared_ptr<const mesh::CollisionMesh> base;
  if (rays.empty()) {
    base = first_mesh(meshes, described.mesh_files);
    if (base != nullptr && !described.wrap.onto_files.empty()) {
      base = wrap(meshes, *base, described, at, findings);
      if (base == nullptr) return false;
    }
    if (base != nullptr) rays = rays_on(*base, described);
  }
  if (rays.size() > kMaxRays) {
    findings.error(
        at, "mesh", "expected at most " + std::to_string(kMaxRays) + " rays, found " + std::to_string(rays.size()),
        "the sensor is left out: there is a ray for each triangle, and by `placement` for each edge or vertex");
    return false;
  }
  if (rays.empty()) {
    findings.error(at, "mesh", "expected a mesh of triangles, found none", "the sensor is left out");
    return false;
  }
  info.skin = std::make_shared<const std::vector<std::array<std::uint32_t, 3>>>(skin_of(rays, base.get(), described));
  return true;
}

}  // namespace ambf::model
