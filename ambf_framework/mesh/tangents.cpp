#include "mesh/tangents.h"

#include <cmath>

namespace ambf::mesh {

void compute_tangents(Submesh& submesh) {
  using math::Vec3;
  const std::size_t count = submesh.vertex_count();
  std::vector<Vec3> along_u(count), along_v(count);
  for (std::size_t t = 0; t + 2 < submesh.triangles.size(); t += 3) {
    const std::uint32_t i[3] = {submesh.triangles[t], submesh.triangles[t + 1], submesh.triangles[t + 2]};
    const Vec3 e1 = submesh.vertex(i[1]) - submesh.vertex(i[0]), e2 = submesh.vertex(i[2]) - submesh.vertex(i[0]);
    const auto uv = [&submesh](std::uint32_t vertex, std::uint32_t k) {
      return static_cast<double>(submesh.texcoords[2 * vertex + k]);
    };
    const double u1 = uv(i[1], 0) - uv(i[0], 0), u2 = uv(i[2], 0) - uv(i[0], 0);
    const double v1 = uv(i[1], 1) - uv(i[0], 1), v2 = uv(i[2], 1) - uv(i[0], 1);
    const double area_uv = u1 * v2 - u2 * v1;
    if (area_uv == 0.0 || !std::isfinite(1.0 / area_uv)) continue;
    const Vec3 du = (e1 * v2 - e2 * v1) / area_uv, dv = (e2 * u1 - e1 * u2) / area_uv;
    for (std::uint32_t vertex : i) {
      along_u[vertex] += du;
      along_v[vertex] += dv;
    }
  }
  submesh.tangents.resize(4 * count);
  for (std::size_t v = 0; v < count; ++v) {
    const float* n = submesh.normals.data() + 3 * v;
    const Vec3 normal{n[0], n[1], n[2]};
    Vec3 tangent = along_u[v] - normal * math::dot(normal, along_u[v]);
    double length = math::norm(tangent);
    if (!(length > 1e-20) ||
        !std::isfinite(length)) {  // no usable texture coordinates: any direction along the surface
      tangent = math::cross(normal, std::abs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
      length = math::norm(tangent);
    }
    tangent = tangent / length;
    float* out = submesh.tangents.data() + 4 * v;
    out[0] = static_cast<float>(tangent.x);
    out[1] = static_cast<float>(tangent.y);
    out[2] = static_cast<float>(tangent.z);
    out[3] = math::dot(math::cross(normal, tangent), along_v[v]) < 0.0 ? -1.0F : 1.0F;
  }
}

}  // namespace ambf::mesh
