// Which elements of a sensor are neighbours: the triangles of the surface through what they sense.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "math/rotation.h"
#include "model/kinds/sensor/detail/ray_layout.h"

namespace ambf::model {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t kMaxListed = 1024;  // elements that are triangulated: it takes their square
constexpr double kMinAlong = 0.25;        // cosine to the mean direction: beyond, rays lie on no one side
constexpr double kLongEdge = 3.0;         // times the median: between groups of rays that are apart

// Each vertex within a mesh is surrounded by faces: their rays, in turn.
std::vector<Triangle> about_vertices(const mesh::CollisionMesh& mesh, double scale) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> face_of, next_of;  // by directed edge
  std::vector<std::array<std::uint32_t, 2>> first(mesh.vertices.size());   // an edge that leaves the vertex
  std::vector<bool> used(mesh.vertices.size());
  std::uint32_t element = 0;
  for (const Triangle& triangle : mesh.triangles) {
    math::Vec3 v[3];
    for (std::size_t i = 0; i < 3; ++i) v[i] = mesh.vertices[triangle[i]] * scale;
    if (math::norm(math::cross(v[1] - v[0], v[2] - v[1])) < kMinRayArea) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      face_of[{from, to}] = element;
      next_of[{from, to}] = triangle[(i + 2) % 3];
      first[from] = {from, to};
      used[from] = true;
    }
    ++element;
  }
  std::vector<Triangle> skin;
  std::vector<std::uint32_t> around;
  for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
    if (!used[vertex]) continue;
    around.clear();
    std::array<std::uint32_t, 2> edge = first[vertex];
    do {
      const auto face = face_of.find(edge);
      if (face == face_of.end() || around.size() > mesh.triangles.size()) {
        around.clear();  // at the mesh's rim
        break;
      }
      around.push_back(face->second);
      edge = {vertex, next_of[edge]};
    } while (edge != first[vertex]);
    for (std::size_t i = 2; i < around.size(); ++i) skin.push_back({around[0], around[i - 1], around[i]});
  }
  return skin;
}

std::vector<Triangle> grid(std::uint32_t side) {
  std::vector<Triangle> skin;
  for (std::uint32_t i = 0; i + 1 < side; ++i)
    for (std::uint32_t j = 0; j + 1 < side; ++j) {
      const std::uint32_t at = i * side + j;  // i: about y, downwards; j: about z, to the left
      skin.push_back({at, at + side, at + 1});
      skin.push_back({at + 1, at + side, at + side + 1});
    }
  return skin;
}

struct Flat {
  double x = 0.0, y = 0.0;
};

double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Whether `p` is within the circle through a, b, c (counter-clockwise).
bool within_circle(const Flat& a, const Flat& b, const Flat& c, const Flat& p) {
  const auto row = [&](const Flat& q) {
    const double x = q.x - p.x, y = q.y - p.y;
    return std::array<double, 3>{x, y, x * x + y * y};
  };
  const auto u = row(a), v = row(b), w = row(c);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]) >
         0.0;
}

// Delaunay's triangles, by Bowyer and Watson; counter-clockwise.
std::vector<Triangle> triangulated(std::vector<Flat> points) {
  const auto count = static_cast<std::uint32_t>(points.size());
  double size = 0.0;
  for (const Flat& p : points) size = std::max({size, std::abs(p.x), std::abs(p.y)});
  if (size == 0.0) return {};
  for (std::uint32_t i = 0; i < count; ++i) {  // no four on one circle, as those of a grid are; the same in every run
    points[i].x = points[i].x / size + 1e-5 * std::sin(12.9898 * i + 1.0);
    points[i].y = points[i].y / size + 1e-5 * std::sin(78.233 * i + 2.0);
  }
  points.insert(points.end(), {{-40.0, -40.0}, {40.0, -40.0}, {0.0, 60.0}});
  std::vector<Triangle> triangles{{count, count + 1, count + 2}};
  for (std::uint32_t i = 0; i < count; ++i) {
    std::set<std::array<std::uint32_t, 2>> rim;  // of the hole that the point makes
    std::erase_if(triangles, [&](const Triangle& t) {
      if (!within_circle(points[t[0]], points[t[1]], points[t[2]], points[i])) return false;
      for (std::size_t k = 0; k < 3; ++k)
        if (rim.erase({t[(k + 1) % 3], t[k]}) == 0) rim.insert({t[k], t[(k + 1) % 3]});
      return true;
    });
    for (const auto& [from, to] : rim) triangles.push_back({from, to, i});
  }
  std::erase_if(triangles, [&](const Triangle& t) {
    return std::max({t[0], t[1], t[2]}) >= count || !(turn(points[t[0]], points[t[1]], points[t[2]]) > 1e-4);
  });
  return triangles;
}

// Without triangles between rays that are far apart.
void drop_long(const std::vector<state::SensorRay>& rays, std::vector<Triangle>& triangles) {
  const auto longest_edge = [&](const Triangle& t) {
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, math::norm(rays[t[k]].end - rays[t[(k + 1) % 3]].end));
    return longest;
  };
  std::vector<double> lengths;
  for (const Triangle& triangle : triangles) lengths.push_back(longest_edge(triangle));
  if (lengths.empty()) return;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const double limit = kLongEdge * *middle;
  std::erase_if(triangles, [&](const Triangle& triangle) { return longest_edge(triangle) > limit; });
}

}  // namespace

std::vector<Triangle> skin_of(const std::vector<state::SensorRay>& rays, const mesh::CollisionMesh* mesh,
                              const scene::Sensor& sensor) {
  const scene::RayPlacement& placement = sensor.placement;
  if (mesh != nullptr && placement.faces && !placement.edges && !placement.vertices)
    return about_vertices(*mesh, sensor.mesh_scale);
  if (mesh == nullptr && sensor.array.empty() && sensor.parametric.resolution >= 2)
    return grid(static_cast<std::uint32_t>(sensor.parametric.resolution));
  if (rays.size() < 3 || rays.size() > kMaxListed) return {};
  math::Vec3 sum;
  for (const state::SensorRay& ray : rays) sum += math::normalized(ray.end - ray.start);
  const math::Vec3 along = math::normalized(sum);
  for (const state::SensorRay& ray : rays)
    if (math::dot(math::normalized(ray.end - ray.start), along) < kMinAlong) return {};
  const math::Quat turned = math::rotation_between(along, {0, 0, 1});
  math::Vec3 middle;
  for (const state::SensorRay& ray : rays) middle += ray.end / static_cast<double>(rays.size());
  std::vector<Flat> points;
  for (const state::SensorRay& ray : rays) {
    const math::Vec3 seen = math::rotate(turned, ray.end - middle);
    points.push_back({seen.x, seen.y});
  }
  std::vector<Triangle> triangles = triangulated(std::move(points));
  drop_long(rays, triangles);
  return triangles;
}

}  // namespace ambf::model
