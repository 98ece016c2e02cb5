// How tissue looks that can be cut: its own faces, since a mesh drawn over it could not part where it does.
#include <array>
#include <cmath>
#include <map>

#include "mesh/mesh.h"
#include "model/kinds/soft_body/detail/builder.h"

namespace ambf::model {
namespace {

using Face = std::array<std::uint32_t, 3>;
using Place = std::array<float, 3>;

constexpr double kCrease = 0.75;  // cosine, between faces that are shaded as one
const mesh::Color kWithin{0.55F, 0.06F, 0.05F, 1.0F};

Place place_of(const math::Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// 0.1 um: points of several elements at one place differ by rounding.
math::Vec3 rounded(const math::Vec3& v) {
  const auto each = [](double value) { return std::round(value * 1e7) * 1e-7; };
  return {each(v.x), each(v.y), each(v.z)};
}

math::Vec3 normal_of(const std::vector<math::Vec3>& points, const Face& face) {
  const math::Vec3 area = math::cross(points[face[1]] - points[face[0]], points[face[2]] - points[face[0]]);
  const double size = math::norm(area);
  return size > 0.0 ? area / size : math::Vec3{0, 0, 1};
}

void add_corner(mesh::Submesh& to, const math::Vec3& at, const math::Vec3& normal) {
  for (const float value : place_of(at)) to.positions.push_back(value);
  for (const float value : place_of(normal)) to.normals.push_back(value);
  to.triangles.push_back(static_cast<std::uint32_t>(to.triangles.size()));
}

mesh::Material outside_of(const mesh::Appearance* given) {
  mesh::Material material;
  if (given == nullptr) return material;
  if (given->has_material) {
    const auto color = [&](const float(&rgb)[3]) { return mesh::Color{rgb[0], rgb[1], rgb[2], 1.0F}; };
    material.ambient = color(given->material.ambient);
    material.diffuse = color(given->material.diffuse);
    material.specular = color(given->material.specular);
    material.emission = color(given->material.emission);
    material.shininess = given->material.shininess;
  } else if (!given->parts.empty() && given->parts[0].mesh != nullptr && !given->parts[0].mesh->materials.empty()) {
    material = given->parts[0].mesh->materials[0];
    material.texture_file.clear();
    material.normal_map_file.clear();
  }
  return material;
}

}  // namespace

std::shared_ptr<const mesh::Appearance> look_of_cuts(const physics::TissueGrid& grid,
                                                     const std::vector<math::Vec3>& points,
                                                     const mesh::Appearance* given,
                                                     std::vector<state::SkinVertex>& skin) {
  std::map<Place, std::vector<math::Vec3>> normals;  // of the faces of the surface around each place
  for (std::size_t f = 0; f < grid.first_inner_face; ++f)
    for (const std::uint32_t point : grid.faces[f])
      normals[place_of(rounded(points[point]))].push_back(normal_of(points, grid.faces[f]));
  auto made = std::make_shared<mesh::Mesh>();
  made->materials = {outside_of(given), {}};
  made->materials[1].name = "within";
  made->materials[1].ambient = made->materials[1].diffuse = kWithin;
  made->materials[1].specular = {0.25F, 0.2F, 0.2F, 1.0F};
  made->submeshes.resize(2);
  made->submeshes[0].material = 0;
  made->submeshes[1].material = 1;
  for (std::size_t f = 0; f < grid.faces.size(); ++f) {
    const bool is_inner = f >= grid.first_inner_face;
    const math::Vec3 own = normal_of(points, grid.faces[f]);
    for (const std::uint32_t point : grid.faces[f]) {
      math::Vec3 normal = own;
      if (!is_inner) {
        math::Vec3 sum{};
        for (const math::Vec3& each : normals[place_of(rounded(points[point]))])
          if (math::dot(each, own) > kCrease) sum += each;
        normal = rounded(sum / math::norm(sum));
      }
      add_corner(made->submeshes[is_inner ? 1 : 0], rounded(points[point]), normal);
      state::SkinVertex vertex;
      vertex.node = {point, point, point};
      skin.push_back(vertex);
    }
  }
  made->bounds = mesh::bounds_of(points);
  auto look = std::make_shared<mesh::Appearance>();
  if (given != nullptr) {
    look->visible = given->visible;
    look->shaders = given->shaders;
  }
  look->parts.push_back({made, {}, 1.0});
  return look;
}

}  // namespace ambf::model
