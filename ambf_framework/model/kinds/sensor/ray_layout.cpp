#include "model/kinds/sensor/detail/ray_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "math/rotation.h"

namespace ambf::model {

namespace {

// From -half to half of the whole angle.
double angle_at(int i, int count, double whole_rad) { return whole_rad * (static_cast<double>(i) / (count - 1) - 0.5); }

constexpr double kMinNormal = 1e-6;  // of a sum of unit normals

// A place on a mesh and its outward normal, of any length.
struct Spot {
  math::Vec3 at, normal;
};

}  // namespace

std::vector<state::SensorRay> listed_rays(const scene::Sensor& sensor) {
  std::vector<state::SensorRay> rays;
  for (const scene::SensorRayBlock& ray : sensor.array)
    rays.push_back({ray.offset, ray.offset + ray.direction * sensor.range_m});
  const scene::ParametricRays& fan = sensor.parametric;
  if (!rays.empty() || !sensor.mesh_files.empty() || fan.resolution < 2) return rays;
  for (int i = 0; i < fan.resolution; ++i) {
    for (int j = 0; j < fan.resolution; ++j) {
      const math::Quat turn = math::from_rpy(0.0, angle_at(i, fan.resolution, fan.vertical_rad),
                                             angle_at(j, fan.resolution, fan.horizontal_rad));
      const math::Vec3 direction = math::rotate(turn, {1.0, 0.0, 0.0});
      const math::Vec3 start = direction * fan.start_offset_m;
      rays.push_back({start, start + direction * sensor.range_m});
    }
  }
  return rays;
}

std::vector<state::SensorRay> rays_on(const mesh::CollisionMesh& mesh, const scene::Sensor& sensor) {
  std::vector<Spot> faces, vertices(mesh.vertices.size());
  std::map<std::array<std::uint32_t, 2>, Spot> edges;
  for (const auto& triangle : mesh.triangles) {
    math::Vec3 v[3];
    for (std::size_t i = 0; i < 3; ++i) v[i] = mesh.vertices[triangle[i]] * sensor.mesh_scale;
    const math::Vec3 area = math::cross(v[1] - v[0], v[2] - v[1]);
    if (math::norm(area) < kMinRayArea) continue;
    const math::Vec3 normal = area / math::norm(area);
    faces.push_back({(v[0] + v[1] + v[2]) / 3.0, normal});
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
      Spot& edge = edges[{std::min(triangle[i], triangle[next]), std::max(triangle[i], triangle[next])}];
      edge.at = 0.5 * (v[i] + v[next]);
      edge.normal += normal;
      const math::Vec3 a = math::normalized(v[next] - v[i]), b = math::normalized(v[last] - v[i]);
      Spot& vertex = vertices[triangle[i]];
      vertex.at = v[i];
      vertex.normal += normal * std::acos(std::clamp(math::dot(a, b), -1.0, 1.0));
    }
  }
  std::vector<state::SensorRay> rays;
  const auto add = [&](const Spot& spot) {
    const double length = math::norm(spot.normal);
    if (length < kMinNormal) return;
    const math::Vec3 outward = spot.normal / length, start = spot.at - outward * sensor.depth_m;
    rays.push_back({start, start + outward * sensor.range_m});
  };
  if (sensor.placement.faces) std::for_each(faces.begin(), faces.end(), add);
  if (sensor.placement.edges)
    for (const auto& [ends, spot] : edges) add(spot);
  if (sensor.placement.vertices) std::for_each(vertices.begin(), vertices.end(), add);
  return rays;
}

}  // namespace ambf::model
