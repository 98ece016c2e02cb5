#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

#include "mesh/detail/hash_seed.h"
#include "mesh/detail/weld_points.h"
#include "mesh/formats/raw_mesh.h"
#include "mesh/formats/read_context.h"
#include "mesh/tangents.h"

namespace ambf::mesh {

namespace {

using math::Vec3;

struct Triangles {
  std::vector<RawCorner> corners;  // three each
  std::vector<std::int32_t> material;
  std::vector<std::uint32_t> smoothing;
  std::size_t count() const { return material.size(); }
};

Vec3 position_of(const RawMesh& raw, std::uint32_t i) {
  const float* p = raw.positions.data() + std::size_t{3} * i;
  return {p[0], p[1], p[2]};
}

// Nearly equal positions become one, so that normals can be smoothed across them.
void weld_positions(RawMesh& raw, double epsilon_relative) {
  const std::size_t count = raw.position_count();
  BoundingBox box;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = position_of(raw, static_cast<std::uint32_t>(i));
    if (i == 0) box = {p, p};
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
  }
  const Weld joined = weld_points(
      count, [&raw](std::size_t i) { return position_of(raw, static_cast<std::uint32_t>(i)); },
      epsilon_relative * box.diagonal());
  for (RawCorner& corner : raw.corners) corner.position = joined.first[corner.position];
  for (RawLine& line : raw.lines) line = {joined.first[line.a], joined.first[line.b], line.material};
}

// Splits polygons and drops triangles with two equal corners; returns how many were dropped.
std::size_t split_faces(const RawMesh& raw, Triangles& out) {
  std::size_t dropped = 0;
  out.corners.reserve(raw.corners.size());
  out.material.reserve(raw.faces.size());
  out.smoothing.reserve(raw.faces.size());
  const auto same_place = [&raw](const RawCorner& a, const RawCorner& b) {
    const float *p = raw.positions.data() + std::size_t{3} * a.position,
                *q = raw.positions.data() + std::size_t{3} * b.position;
    return a.position == b.position || (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]);
  };
  std::vector<Vec3> polygon;
  std::vector<std::uint32_t> pieces;
  for (const RawFace& face : raw.faces) {
    pieces = {0, 1, 2};
    if (face.count > 3) {
      polygon.clear();
      for (std::uint32_t k = 0; k < face.count; ++k)
        polygon.push_back(position_of(raw, raw.corners[face.first + k].position));
      triangulate(polygon, pieces);
    }
    for (std::size_t k = 0; k < pieces.size(); k += 3) {
      const RawCorner &a = raw.corners[face.first + pieces[k]], &b = raw.corners[face.first + pieces[k + 1]],
                      &c = raw.corners[face.first + pieces[k + 2]];
      if (same_place(a, b) || same_place(b, c) || same_place(a, c)) {
        ++dropped;
        continue;
      }
      out.corners.insert(out.corners.end(), {a, b, c});
      out.material.push_back(face.material);
      out.smoothing.push_back(face.smoothing);
    }
  }
  return dropped;
}

// Normals of the file made unit; a zero or non-finite one counts as missing.
bool take_file_normals(RawMesh& raw, Triangles& triangles) {
  for (std::size_t i = 0; i + 2 < raw.normals.size(); i += 3) {
    float* n = raw.normals.data() + i;
    const Vec3 v{n[0], n[1], n[2]};
    const double length = math::norm(v);
    const bool usable = std::isfinite(length) && length > 1e-12;
    for (int k = 0; k < 3; ++k) n[k] = usable ? static_cast<float>(n[k] / length) : 0.0F;
  }
  bool all = true;
  for (RawCorner& corner : triangles.corners) {
    if (corner.normal != kNoIndex) {
      const float* n = raw.normals.data() + std::size_t{3} * corner.normal;
      if (n[0] == 0.0F && n[1] == 0.0F && n[2] == 0.0F) corner.normal = kNoIndex;
    }
    all = all && corner.normal != kNoIndex;
  }
  return all;
}

struct VertexKey {
  std::uint32_t position, texcoord;
  std::uint64_t normal;  // quantised, so that normals computed for neighbours join in spite of rounding
  bool operator==(const VertexKey& o) const {
    return position == o.position && texcoord == o.texcoord && normal == o.normal;
  }
};

std::uint64_t quantised(const float n[3]) {
  const auto part = [](float v) { return static_cast<std::uint64_t>(std::lround(v * 8191.0F) + 8192) & 0x7FFF; };
  return part(n[0]) << 32 | part(n[1]) << 16 | part(n[2]);
}

// The vertices of one submesh so far, numbered in order of appearance; open addressing, seeded at random so that no
// file can be made to collide on purpose.
class VertexTable {
 public:
  VertexTable() { slots_.assign(1024, kNoIndex); }

  // Number of the vertex; out_new when it has to be appended.
  std::uint32_t number_of(const VertexKey& key, bool& out_new) {
    if (2 * keys_.size() >= slots_.size()) grow();
    std::size_t slot = find(key);
    out_new = slots_[slot] == kNoIndex;
    if (out_new) {
      slots_[slot] = static_cast<std::uint32_t>(keys_.size());
      keys_.push_back(key);
    }
    return slots_[slot];
  }

 private:
  std::size_t find(const VertexKey& key) const {
    std::uint64_t h = seed_ ^ (std::uint64_t{key.position} << 32 | key.texcoord);
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL + key.normal;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
    std::size_t slot = static_cast<std::size_t>(h ^ (h >> 31)) & (slots_.size() - 1);
    while (slots_[slot] != kNoIndex && !(keys_[slots_[slot]] == key)) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    slots_.assign(4 * slots_.size(), kNoIndex);
    for (std::size_t i = 0; i < keys_.size(); ++i) slots_[find(keys_[i])] = static_cast<std::uint32_t>(i);
  }

  const std::uint64_t seed_ = hash_seed();
  std::vector<std::uint32_t> slots_;
  std::vector<VertexKey> keys_;
};

// Submeshes by material, in order of first use.
class Assembler {
 public:
  Assembler(const RawMesh& raw, Mesh& out) : raw_(raw), out_(out) {}

  void add_triangles(const Triangles& triangles, const std::vector<float>& corner_normals) {
    for (std::size_t c = 0; c < triangles.corners.size(); ++c) {
      const RawCorner& corner = triangles.corners[c];
      const float* normal = corner.normal != kNoIndex ? raw_.normals.data() + std::size_t{3} * corner.normal
                                                      : corner_normals.data() + 3 * c;
      Part& part = part_of(triangles.material[c / 3]);
      out_.submeshes[part.index].triangles.push_back(vertex(part, corner.position, corner.texcoord, normal));
    }
  }

  void add_lines() {
    static constexpr float kNoNormal[3] = {0.0F, 0.0F, 1.0F};
    for (const RawLine& line : raw_.lines) {
      if (line.a == line.b) continue;
      Part& part = part_of(line.material);
      const std::uint32_t a = vertex(part, line.a, kNoIndex, kNoNormal), b = vertex(part, line.b, kNoIndex, kNoNormal);
      out_.submeshes[part.index].lines.push_back({a, b});
    }
  }

  // A submesh has texture coordinates for all vertices or for none.
  void finish() {
    for (auto& [material, part] : parts_) {
      if (!part.textured) out_.submeshes[part.index].texcoords.clear();
    }
  }

 private:
  struct Part {
    std::size_t index = 0;
    VertexTable table;
    bool textured = false;
  };

  Part& part_of(std::int32_t material) {
    if (last_ != nullptr && last_material_ == material) return *last_;
    const auto [it, added] = parts_.try_emplace(material);
    if (added) {
      it->second.index = out_.submeshes.size();
      out_.submeshes.emplace_back();
      out_.submeshes.back().material = material;
    }
    last_ = &it->second;
    last_material_ = material;
    return *last_;
  }

  std::uint32_t vertex(Part& part, std::uint32_t position, std::uint32_t texcoord, const float normal[3]) {
    bool added = false;
    const std::uint32_t number = part.table.number_of({position, texcoord, quantised(normal)}, added);
    if (!added) return number;
    Submesh& s = out_.submeshes[part.index];
    const float* p = raw_.positions.data() + std::size_t{3} * position;
    s.positions.insert(s.positions.end(), p, p + 3);
    s.normals.insert(s.normals.end(), normal, normal + 3);
    const float* uv = texcoord == kNoIndex ? nullptr : raw_.texcoords.data() + std::size_t{2} * texcoord;
    const bool usable = uv != nullptr && std::isfinite(uv[0]) && std::isfinite(uv[1]);
    s.texcoords.push_back(usable ? uv[0] : 0.0F);
    s.texcoords.push_back(usable ? uv[1] : 0.0F);
    part.textured = part.textured || usable;
    return number;
  }

  const RawMesh& raw_;
  Mesh& out_;
  std::unordered_map<std::int32_t, Part> parts_;
  Part* last_ = nullptr;
  std::int32_t last_material_ = 0;
};

}  // namespace

bool build_mesh(RawMesh&& raw, ReadContext& context, Mesh& out) {
  Triangles triangles;
  bool file_has_normals = !raw.normals.empty();
  for (const RawCorner& corner : raw.corners) file_has_normals = file_has_normals && corner.normal != kNoIndex;
  if (!file_has_normals) weld_positions(raw, context.options().weld_epsilon_relative);
  const std::size_t dropped = split_faces(raw, triangles);
  raw.corners = {};
  raw.faces = {};
  if (dropped > 0) {
    context.inform(std::to_string(dropped) + " triangles without area (two corners in one place) were left out");
  }
  if (triangles.count() == 0 && raw.lines.empty()) {
    return context.fail("the mesh has no triangles and no lines", "check that the exported selection is not empty");
  }

  std::vector<float> computed;
  if (!take_file_normals(raw, triangles)) {
    std::vector<std::uint32_t> indices;
    indices.reserve(triangles.corners.size());
    for (const RawCorner& corner : triangles.corners) indices.push_back(corner.position);
    computed =
        compute_corner_normals({&raw.positions, &indices, &triangles.smoothing, context.options().crease_angle_rad});
  }

  out.materials = std::move(raw.materials);
  out.pictures = std::move(raw.pictures);
  Assembler assembler(raw, out);
  assembler.add_triangles(triangles, computed);
  assembler.add_lines();
  assembler.finish();
  for (Submesh& s : out.submeshes) {
    const bool mapped = s.material >= 0 && !out.materials[static_cast<std::size_t>(s.material)].normal_map_file.empty();
    if (mapped && !s.texcoords.empty()) compute_tangents(s);
  }
  out.bounds = bounds_of(out.submeshes);
  return true;
}

}  // namespace ambf::mesh
