#include "render/scene/soft_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "math/rotation.h"
#include "state/frame.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

math::Vec3 unit_or_zero(const math::Vec3& v) {
  const double length = math::norm(v);
  return length > 0.0 ? v * (1.0 / length) : math::Vec3{};
}

math::Vec3 place(const state::SkinVertex& vertex, const math::Vec3* nodes) {
  const math::Vec3 &a = nodes[vertex.node[0]], &b = nodes[vertex.node[1]], &c = nodes[vertex.node[2]];
  const math::Vec3 at = a * vertex.weight[0] + b * vertex.weight[1] + c * vertex.weight[2];
  return vertex.height == 0.0F ? at : at + unit_or_zero(math::cross(b - a, c - a)) * vertex.height;
}

void put(const math::Vec3& v, float* to) {
  to[0] = static_cast<float>(v.x);
  to[1] = static_cast<float>(v.y);
  to[2] = static_cast<float>(v.z);
}

}  // namespace

void node_positions(const state::Frame& frame, std::vector<math::Vec3>& out) {
  out.clear();
  const auto count = static_cast<std::uint32_t>(state::soft_bodies(*frame.structure).size());
  for (std::uint32_t slot = 0; slot < count; ++slot)
    for (const state::SoftNode& node : state::nodes_of(frame, slot)) out.push_back(node.position_world);
}

SoftSurface::SoftSurface(const state::SoftBodyInfo& body, const mesh::AppearancePart& part, std::size_t first_skin)
    : object_(body.object),
      first_node_(body.first_node),
      nodes_(body.nodes),
      first_skin_(first_skin),
      shape_(body.shape),
      mesh_(std::make_shared<const mesh::Mesh>(*part.mesh)),
      now_(part.mesh->submeshes) {
  for (mesh::Submesh& submesh : now_) {
    submesh.normals.resize(submesh.positions.size(), 0.0F);
    submesh.tangents.clear();  // as the file gives them they are of the mesh at rest
  }
  find_smooth_places();
}

// Files split vertices at creases, where normals differ, and at seams of pictures, where they do not.
void SoftSurface::find_smooth_places() {
  std::map<std::array<float, 6>, std::uint32_t> known;
  for (const mesh::Submesh& submesh : now_)
    for (std::size_t i = 0; i < submesh.vertex_count(); ++i) {
      const float *p = &submesh.positions[3 * i], *n = &submesh.normals[3 * i];
      const auto number = static_cast<std::uint32_t>(known.size());
      smooth_.push_back(known.try_emplace({p[0], p[1], p[2], n[0], n[1], n[2]}, number).first->second);
    }
  normals_.resize(known.size());
}

bool SoftSurface::pose(const std::vector<math::Vec3>& nodes) {
  if (nodes.size() < std::size_t{first_node_} + nodes_) return false;
  const math::Vec3* own = nodes.data() + first_node_;
  if (shape_->tube_radius_m > 0.0F) return pose_tube(own);
  std::size_t vertex = first_skin_;
  math::Vec3 low{1e300, 1e300, 1e300}, high = -low;
  for (mesh::Submesh& submesh : now_)
    for (std::size_t i = 0; i < submesh.vertex_count(); ++i, ++vertex) {
      const math::Vec3 at = place(shape_->skin[vertex], own);
      put(at, &submesh.positions[3 * i]);
      low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
    }
  bounds_ = {0.5 * (low + high), 0.5 * math::norm(high - low)};
  shade();
  return true;
}

// Rings about the nodes, each across the mean direction there, without a twist from one to the next.
bool SoftSurface::pose_tube(const math::Vec3* nodes) {
  if (now_.size() != 1 || now_[0].vertex_count() != state::kTubeSides * nodes_ + 2) return false;
  const double radius = shape_->tube_radius_m;
  const std::uint32_t last = nodes_ - 1;
  std::vector<float>& to = now_[0].positions;
  math::Vec3 low{1e300, 1e300, 1e300}, high = -low, side{};
  for (std::uint32_t i = 0; i < nodes_; ++i) {
    const math::Vec3 before = i > 0 ? unit_or_zero(nodes[i] - nodes[i - 1]) : math::Vec3{};
    const math::Vec3 after = i < last ? unit_or_zero(nodes[i + 1] - nodes[i]) : math::Vec3{};
    const math::Vec3 along = unit_or_zero(before + after);
    side = unit_or_zero(side - along * math::dot(side, along));
    if (side == math::Vec3{})
      side = unit_or_zero(math::cross(along, std::abs(along.x) < 0.7 ? math::Vec3{1, 0, 0} : math::Vec3{0, 1, 0}));
    const math::Vec3 across = math::cross(along, side);
    for (std::size_t k = 0; k < state::kTubeSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / state::kTubeSides;
      put(nodes[i] + (side * std::cos(angle) + across * std::sin(angle)) * radius,
          &to[3 * (state::kTubeSides * i + k)]);
    }
    if (i == 0) put(nodes[0] - along * radius, &to[3 * state::kTubeSides * nodes_]);
    if (i == last) put(nodes[last] + along * radius, &to[3 * (state::kTubeSides * nodes_ + 1)]);
    low = {std::min(low.x, nodes[i].x), std::min(low.y, nodes[i].y), std::min(low.z, nodes[i].z)};
    high = {std::max(high.x, nodes[i].x), std::max(high.y, nodes[i].y), std::max(high.z, nodes[i].z)};
  }
  bounds_ = {0.5 * (low + high), 0.5 * math::norm(high - low) + 2.0 * radius};
  shade();
  return true;
}

// By the triangles around each place, large ones more.
void SoftSurface::shade() {
  normals_.assign(normals_.size(), {});
  std::size_t first = 0;
  for (const mesh::Submesh& submesh : now_) {
    for (std::size_t t = 0; t + 2 < submesh.triangles.size(); t += 3) {
      const std::uint32_t* i = &submesh.triangles[t];
      const math::Vec3 a = submesh.vertex(i[0]);
      const math::Vec3 area = math::cross(submesh.vertex(i[1]) - a, submesh.vertex(i[2]) - a);
      for (int corner = 0; corner < 3; ++corner) normals_[smooth_[first + i[corner]]] += area;
    }
    first += submesh.vertex_count();
  }
  first = 0;
  for (mesh::Submesh& submesh : now_) {
    for (std::size_t i = 0; i < submesh.vertex_count(); ++i) {
      const math::Vec3 normal = unit_or_zero(normals_[smooth_[first + i]]);
      put(normal == math::Vec3{} ? math::Vec3{0, 0, 1} : normal, &submesh.normals[3 * i]);
    }
    first += submesh.vertex_count();
  }
}

}  // namespace ambf::render
