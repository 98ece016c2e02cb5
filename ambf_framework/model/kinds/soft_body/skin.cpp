#include "model/kinds/soft_body/detail/skin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/mesh.h"
#include "model/kinds/soft_body/detail/builder.h"

namespace ambf::model {
namespace {

constexpr double kSamePlace = 1e-6;  // of the nodes' extent

struct Triangle {
  std::array<std::uint32_t, 3> node;
  math::Vec3 a, ab, ac, normal;  // unit normal
  math::Vec3 centre;
  double radius;
};

std::vector<Triangle> triangles_of(const std::vector<math::Vec3>& nodes,
                                   const std::vector<std::array<std::uint32_t, 3>>& corners) {
  std::vector<Triangle> made;
  for (const auto& c : corners) {
    const math::Vec3 a = nodes[c[0]], ab = nodes[c[1]] - a, ac = nodes[c[2]] - a;
    const math::Vec3 normal = math::cross(ab, ac);
    if (!(math::norm(normal) > 0.0)) continue;
    const math::Vec3 centre = a + (ab + ac) * (1.0 / 3.0);
    double radius = 0.0;
    for (const std::uint32_t node : c) radius = std::max(radius, math::norm(nodes[node] - centre));
    made.push_back({c, a, ab, ac, normal * (1.0 / math::norm(normal)), centre, radius});
  }
  return made;
}

// Weights of the corners at the point's projection on the plane: they add up to 1, and one may be negative.
std::array<double, 3> weights(const Triangle& t, const math::Vec3& point) {
  const math::Vec3 ap = point - t.a;
  const double bb = math::dot(t.ab, t.ab), bc = math::dot(t.ab, t.ac), cc = math::dot(t.ac, t.ac);
  const double pb = math::dot(ap, t.ab), pc = math::dot(ap, t.ac), area = bb * cc - bc * bc;
  const double v = (cc * pb - bc * pc) / area, w = (bb * pc - bc * pb) / area;
  return {1.0 - v - w, v, w};
}

double distance_to(const Triangle& t, const math::Vec3& point) {
  const std::array<double, 3> at = weights(t, point);
  if (at[0] >= 0.0 && at[1] >= 0.0 && at[2] >= 0.0) return std::abs(math::dot(point - t.a, t.normal));
  const auto to_edge = [&](const math::Vec3& from, const math::Vec3& along) {
    const double share = std::clamp(math::dot(point - from, along) / math::dot(along, along), 0.0, 1.0);
    return math::norm(point - from - along * share);
  };
  return std::min({to_edge(t.a, t.ab), to_edge(t.a, t.ac), to_edge(t.a + t.ab, t.ac - t.ab)});
}

state::SkinVertex on_node(std::uint32_t node) { return {{node, node, node}, {1.0F, 0.0F, 0.0F}, 0.0F}; }

const Triangle& nearest_to(const math::Vec3& point, const std::vector<Triangle>& triangles) {
  const Triangle* nearest = &triangles.front();
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    if (math::norm(point - t.centre) - t.radius >= least) continue;
    const double distance = distance_to(t, point);
    if (distance < least) least = distance, nearest = &t;
  }
  return *nearest;
}

state::SkinVertex on_triangle(const math::Vec3& point, const Triangle& t) {
  const std::array<double, 3> at = weights(t, point);
  return {t.node,
          {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])},
          static_cast<float>(math::dot(point - t.a, t.normal))};
}

state::SkinVertex bound_to(const math::Vec3& point, const std::vector<math::Vec3>& nodes,
                           const std::vector<Triangle>& triangles, double same_place) {
  std::uint32_t node = 0;
  for (std::uint32_t i = 1; i < nodes.size(); ++i)
    if (math::norm(nodes[i] - point) < math::norm(nodes[node] - point)) node = i;
  if (triangles.empty() || math::norm(nodes[node] - point) <= same_place) return on_node(node);
  return on_triangle(point, nearest_to(point, triangles));
}

// Triangles that share no vertices.
mesh::Submesh parted(const mesh::Submesh& whole) {
  mesh::Submesh made;
  made.material = whole.material;
  for (const std::uint32_t i : whole.triangles) {
    const auto copy = [i](const std::vector<float>& from, std::vector<float>& to, std::size_t each) {
      for (std::size_t k = 0; k < each && !from.empty(); ++k) to.push_back(from[each * i + k]);
    };
    copy(whole.positions, made.positions, 3);
    copy(whole.normals, made.normals, 3);
    copy(whole.texcoords, made.texcoords, 2);
    copy(whole.tangents, made.tangents, 4);
    made.triangles.push_back(static_cast<std::uint32_t>(made.triangles.size()));
  }
  return made;
}

}  // namespace

std::vector<state::SkinVertex> make_skin(const mesh::Appearance& appearance, const std::vector<math::Vec3>& nodes,
                                         const std::vector<std::array<std::uint32_t, 3>>& corners) {
  std::vector<state::SkinVertex> skin;
  const std::vector<Triangle> triangles = triangles_of(nodes, corners);
  const double same_place = kSamePlace * mesh::bounds_of(nodes).diagonal();
  for (const mesh::AppearancePart& part : appearance.parts)
    for (const mesh::Submesh& submesh : part.mesh->submeshes)
      for (std::size_t i = 0; i < submesh.vertex_count(); ++i)
        skin.push_back(bound_to(part.T_body_part * (submesh.vertex(i) * part.scale), nodes, triangles, same_place));
  return skin;
}

std::shared_ptr<const mesh::Appearance> look_of_cut_sheet(const std::vector<std::array<std::uint32_t, 3>>& faces,
                                                          const std::vector<math::Vec3>& points,
                                                          const mesh::Appearance& given,
                                                          std::vector<state::SkinVertex>& skin) {
  const std::vector<Triangle> triangles = triangles_of(points, faces);
  const double same_place = kSamePlace * mesh::bounds_of(points).diagonal();
  auto look = std::make_shared<mesh::Appearance>(given);
  for (mesh::AppearancePart& part : look->parts) {
    auto made = std::make_shared<mesh::Mesh>(*part.mesh);
    for (mesh::Submesh& submesh : made->submeshes) {
      submesh = parted(submesh);
      for (std::size_t i = 0; i < submesh.vertex_count(); i += 3) {
        math::Vec3 at[3], middle{};
        for (std::size_t k = 0; k < 3; ++k) {
          at[k] = part.T_body_part * (submesh.vertex(i + k) * part.scale);
          middle += at[k] / 3.0;
        }
        const Triangle& on = nearest_to(middle, triangles);
        for (const math::Vec3& vertex : at) {
          const auto* const corner = std::find_if(on.node.begin(), on.node.end(), [&](std::uint32_t node) {
            return math::norm(points[node] - vertex) <= same_place;
          });
          skin.push_back(corner == on.node.end() ? on_triangle(vertex, on) : on_node(*corner));
        }
      }
    }
    part.mesh = std::move(made);
  }
  return look;
}

}  // namespace ambf::model
