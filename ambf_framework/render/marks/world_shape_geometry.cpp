#include "render/marks/detail/world_shape_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "base/hash.h"
#include "math/rotation.h"

namespace ambf::render {

namespace {

using Key = std::array<std::uint32_t, 3>;  // the bits of a position

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    base::Fnv1a hash;
    for (const std::uint32_t word : key) hash.add_word(std::uint64_t{word});
    return hash.value();
  }
};

// An edge and the first face beside it, by its normal.
struct Edge {
  std::uint32_t a = 0, b = 0;
  math::Vec3 normal;
  int faces = 0;
  bool sharp = false;
};

class Builder {
 public:
  std::uint32_t vertex(const float* xyz) {
    Key key{};
    for (std::size_t i = 0; i < 3; ++i) {
      const float value = xyz[i] + 0.0F;  // -0 is 0
      std::memcpy(&key[i], &value, sizeof value);
    }
    const auto [at, is_new] = index_.emplace(key, static_cast<std::uint32_t>(out_.vertices.size() / 3));
    if (is_new) out_.vertices.insert(out_.vertices.end(), xyz, xyz + 3);
    return at->second;
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == b || b == c || c == a) return;
    out_.triangles.insert(out_.triangles.end(), {a, b, c});
    const math::Vec3 across = math::cross(point(b) - point(a), point(c) - point(a));
    const double area = math::norm(across);
    if (!(area > 0.0)) return;
    const math::Vec3 normal = across / area;
    edge(a, b, normal);
    edge(b, c, normal);
    edge(c, a, normal);
  }

  void polyline(std::uint32_t a, std::uint32_t b) {
    if (a != b) edge(a, b, {});
  }

  DebugGeometry finish() {
    for (Edge& edge : edges_) edge.sharp = edge.sharp || edge.faces != 2;
    for (const bool sharp : {true, false}) {
      for (const Edge& edge : edges_) {
        if (edge.sharp != sharp) continue;
        out_.edges.insert(out_.edges.end(), {edge.a, edge.b});
        out_.sharp += sharp ? 1 : 0;
      }
    }
    return std::move(out_);
  }

 private:
  math::Vec3 point(std::uint32_t i) const {
    return {out_.vertices[3 * i], out_.vertices[3 * i + 1], out_.vertices[3 * i + 2]};
  }
  // Faces may be wound either way, so only how much their planes differ counts.
  void edge(std::uint32_t a, std::uint32_t b, const math::Vec3& normal) {
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
    const auto [at, is_new] = edge_of_.emplace(key, edges_.size());
    if (is_new) edges_.push_back({a, b, normal, 0, false});
    Edge& edge = edges_[at->second];
    ++edge.faces;
    if (!is_new && std::abs(math::dot(edge.normal, normal)) < std::cos(kSharp_rad)) edge.sharp = true;
  }

  DebugGeometry out_;
  std::unordered_map<Key, std::uint32_t, KeyHash> index_;
  std::unordered_map<std::uint64_t, std::size_t> edge_of_;
  std::vector<Edge> edges_;
};

}  // namespace

DebugGeometry debug_geometry(const mesh::Mesh& mesh) {
  Builder builder;
  std::vector<std::uint32_t> joined;
  for (const mesh::Submesh& part : mesh.submeshes) {
    joined.clear();
    for (std::size_t i = 0; i < part.vertex_count(); ++i) joined.push_back(builder.vertex(&part.positions[3 * i]));
    for (std::size_t i = 0; i + 2 < part.triangles.size(); i += 3) {
      builder.triangle(joined[part.triangles[i]], joined[part.triangles[i + 1]], joined[part.triangles[i + 2]]);
    }
    for (const auto& line : part.lines) builder.polyline(joined[line[0]], joined[line[1]]);
  }
  return builder.finish();
}

}  // namespace ambf::render
