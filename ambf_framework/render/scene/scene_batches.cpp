#include "render/scene/scene_batches.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/hash.h"
#include "math/rotation.h"
#include "mesh/appearance.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

// By whole words: quick, and equality is checked afterwards.
template <class T>
void mix(base::Fnv1a& hash, const std::vector<T>& values) {
  std::size_t bytes = values.size() * sizeof(T);
  hash.add_word(std::uint64_t{values.size()});
  const auto* at = reinterpret_cast<const unsigned char*>(values.data());
  for (; bytes >= 8; bytes -= 8, at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, 8);
    hash.add_word(word);
  }
  hash.add_bytes(at, bytes);
}

std::uint64_t geometry_hash(const mesh::Mesh& mesh) {
  base::Fnv1a hash;
  for (const mesh::Submesh& part : mesh.submeshes) {
    mix(hash, part.positions);
    mix(hash, part.normals);
    mix(hash, part.texcoords);
    mix(hash, part.triangles);
    mix(hash, part.lines);
  }
  return hash.value();
}

bool same_geometry(const mesh::Mesh& a, const mesh::Mesh& b) {
  return std::equal(a.submeshes.begin(), a.submeshes.end(), b.submeshes.begin(), b.submeshes.end(),
                    [](const mesh::Submesh& x, const mesh::Submesh& y) {
                      return x.positions == y.positions && x.normals == y.normals && x.texcoords == y.texcoords &&
                             x.triangles == y.triangles && x.lines == y.lines;
                    });
}

Sphere bounds_in_body(const mesh::Mesh& mesh, const mesh::AppearancePart& part) {
  const math::Vec3 centre = 0.5 * (mesh.bounds.min + mesh.bounds.max);
  return {part.T_body_part * (part.scale * centre), 0.5 * mesh.bounds.diagonal() * part.scale};
}

InstanceData instance_data(const math::Pose& T_world_part, double scale) {
  const Mat4 m = to_matrix(T_world_part, scale);
  InstanceData data;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) data.rows[4 * row + column] = m.m[4 * column + row];
  }
  return data;
}

constexpr double kGroundRadius = 2.0;  // m
constexpr double kUnseen_m = 2e-5;     // a move that nobody sees
constexpr double kBehindAll = 1e6;     // m, added to the distance of what is larger

}  // namespace

std::shared_ptr<const mesh::Mesh> MeshIdentity::representative(const std::shared_ptr<const mesh::Mesh>& mesh) {
  if (const auto known = known_.find(mesh.get()); known != known_.end()) {
    known->second.used = true;
    return known->second.representative;
  }
  const std::uint64_t hash = geometry_hash(*mesh);
  const auto [begin, end] = by_content_.equal_range(hash);
  for (auto it = begin; it != end; ++it) {
    if (!same_geometry(*it->second, *mesh)) continue;
    Known& first = known_.at(it->second);
    first.used = true;
    const std::shared_ptr<const mesh::Mesh> representative = first.mesh;
    known_.emplace(mesh.get(), Known{mesh, representative, true});
    return representative;
  }
  known_.emplace(mesh.get(), Known{mesh, mesh, true});
  by_content_.emplace(hash, mesh.get());
  return mesh;
}

void MeshIdentity::forget_unused() {
  // A representative stays as long as one of its equals is asked for.
  for (auto& [mesh, known] : known_) {
    if (known.used) known_.at(known.representative.get()).used = true;
  }
  std::erase_if(by_content_, [&](const auto& entry) { return !known_.at(entry.second).used; });
  std::erase_if(known_, [](const auto& entry) { return !entry.second.used; });
  for (auto& [mesh, known] : known_) known.used = false;
}

namespace {

// Fills batches, one instance after the other.
class BatchMaker {
 public:
  BatchMaker(const state::Structure& structure, SceneBatches& scene) : structure_(structure), scene_(scene) {}

  // `shared`: what is drawn, `part.mesh` or one of equal geometry.
  void add(const mesh::Appearance& appearance, const mesh::AppearancePart& part,
           const std::shared_ptr<const mesh::Mesh>& shared, const DrawInstance& instance) {
    const bool of_body = appearance.shaders.given() || structure_.look == nullptr;
    const ShaderPair shader = shader_pair(of_body ? appearance.shaders : structure_.look->shaders);
    const mesh::SurfaceMaterial* over = appearance.has_material ? &appearance.material : nullptr;
    if (part.material) over = &*part.material;
    scene_.pictures.insert(part.mesh->pictures.begin(), part.mesh->pictures.end());
    for (std::size_t i = 0; i < part.mesh->submeshes.size(); ++i) {
      const int index = part.mesh->submeshes[i].material;
      const mesh::Material* own = index < 0 ? nullptr : &part.mesh->materials[static_cast<std::size_t>(index)];
      const Surface surface = surface_of(own, over);
      const auto [begin, end] = batches_of_.equal_range({shared.get(), i});
      auto found = std::find_if(begin, end, [&](const auto& e) {
        const DrawBatch& batch = scene_.batches[e.second];
        return batch.surface == surface && batch.shader == shader;
      });
      if (found == end) {
        found = batches_of_.emplace(std::pair{shared.get(), i}, scene_.batches.size());
        scene_.batches.push_back({shared, i, surface, shader, {}});
      }
      scene_.batches[found->second].instances.push_back(instance);
    }
  }

 private:
  const state::Structure& structure_;
  SceneBatches& scene_;
  std::multimap<std::pair<const mesh::Mesh*, std::size_t>, std::size_t> batches_of_;
};

void add_soft_bodies(const state::Structure& structure, BatchMaker& maker, SceneBatches& scene) {
  const std::vector<state::SoftBodyInfo>& bodies = state::soft_bodies(structure);
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    const mesh::Appearance* appearance = bodies[slot].appearance.get();
    if (appearance == nullptr || !appearance->visible) continue;
    std::size_t first_skin = 0;
    for (const mesh::AppearancePart& part : appearance->parts) {
      if (part.mesh == nullptr) continue;
      const auto number = static_cast<std::uint32_t>(scene.soft.size());
      scene.soft.emplace_back(bodies[slot], part, first_skin);
      first_skin += part.mesh->vertex_count();
      maker.add(*appearance, part, scene.soft.back().mesh(), {scene.body_count + slot, {}, 1.0, {}, number});
    }
  }
}

}  // namespace

SceneBatches make_scene_batches(const state::Structure& structure, MeshIdentity& meshes) {
  SceneBatches scene;
  scene.version = structure.version;
  scene.body_count = static_cast<std::uint32_t>(structure.bodies.size());
  BatchMaker maker(structure, scene);
  for (std::uint32_t slot = 0; slot < structure.bodies.size(); ++slot) {
    const mesh::Appearance* appearance = structure.bodies[slot].appearance.get();
    if (appearance == nullptr || !appearance->visible) continue;
    for (const mesh::AppearancePart& part : appearance->parts) {
      if (part.mesh == nullptr) continue;
      maker.add(*appearance, part, meshes.representative(part.mesh),
                {slot, part.T_body_part, part.scale, bounds_in_body(*part.mesh, part)});
    }
  }
  add_soft_bodies(structure, maker, scene);
  meshes.forget_unused();
  return scene;
}

bool pose_soft_surfaces(const std::vector<math::Vec3>& nodes, SceneBatches& scene) {
  if (scene.soft.empty() || nodes == scene.nodes) return false;
  scene.nodes = nodes;
  for (SoftSurface& surface : scene.soft) surface.pose(nodes);
  const bool seen = !std::equal(nodes.begin(), nodes.end(), scene.nodes_seen.begin(), scene.nodes_seen.end(),
                                [](const auto& a, const auto& b) { return math::norm(a - b) < kUnseen_m; });
  if (seen) {
    scene.nodes_seen = nodes;
    ++scene.soft_moment;
  }
  return true;
}

Sphere bounds_in_world(const SceneBatches& scene, const DrawInstance& instance,
                       const std::vector<math::Pose>& T_world_body) {
  if (instance.soft != state::kNone) return scene.soft[instance.soft].bounds_world();
  if (instance.body >= T_world_body.size()) return {{}, -1.0};
  return {T_world_body[instance.body] * instance.bounds_body.centre, instance.bounds_body.radius};
}

void DrawList::clear() {
  instances.clear();
  bodies.clear();
  opaque.clear();
  transparent.clear();
}

void fill_draw_list(const SceneBatches& scene, const std::vector<math::Pose>& T_world_body, const Frustum* frustum,
                    const math::Vec3& eye_world, const std::vector<BodyLook>& looks, DrawList& list) {
  list.clear();
  struct Seen {
    double distance;  // from the eye to the centre
    InstanceData data;
    double radius;  // m, around the centre
    std::uint32_t body, batch;
    float opacity;
  };
  const auto add = [&list](const Seen& one) {
    list.instances.push_back(one.data);
    list.bodies.push_back(one.body);
  };
  // What opaque things hide is not shaded where they were drawn before it: near ones come first, and last the ground
  // and walls, behind everything else.
  std::vector<std::pair<double, DrawCommand>> opaque;
  std::vector<Seen> solid, see_through;
  for (std::uint32_t b = 0; b < scene.batches.size(); ++b) {
    const DrawBatch& batch = scene.batches[b];
    solid.clear();
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    bool outside = frustum != nullptr;
    for (const DrawInstance& instance : batch.instances) {
      const Sphere bounds = bounds_in_world(scene, instance, T_world_body);
      if (bounds.radius < 0.0) continue;
      const BodyLook look = look_of(looks, instance.body);
      if (!look.has_faces()) continue;
      const bool soft = instance.soft != state::kNone;
      const math::Pose T_world = soft ? math::Pose{} : T_world_body[instance.body];
      if (frustum != nullptr && !frustum->may_see(bounds)) continue;
      InstanceData data = instance_data(T_world * instance.T_body_part, instance.scale);
      data.body = static_cast<float>(instance.body + 1);
      const Seen seen{math::norm(bounds.centre - eye_world), data, bounds.radius, instance.body, b, look.opacity};
      if (batch.surface.transparent() || look.opacity < 1.0F) {
        see_through.push_back(seen);
        continue;
      }
      solid.push_back(seen);
      nearest = std::min(nearest, bounds.radius > kGroundRadius ? kBehindAll + seen.distance
                                                                : std::max(0.0, seen.distance - bounds.radius));
      farthest = std::max(farthest, seen.distance + bounds.radius);
      outside = outside && !soft && instance.scale > 0.0 && !frustum->near_plane_cuts(bounds);
    }
    if (solid.empty()) continue;
    std::stable_sort(solid.begin(), solid.end(), [](const Seen& x, const Seen& y) { return x.distance < y.distance; });
    const auto first = static_cast<std::uint32_t>(list.instances.size());
    opaque.emplace_back(nearest,
                        DrawCommand{b, first, static_cast<std::uint32_t>(solid.size()), 1.0F, farthest, outside});
    std::for_each(solid.begin(), solid.end(), add);
  }
  std::stable_sort(opaque.begin(), opaque.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  for (const auto& [distance, command] : opaque) list.opaque.push_back(command);
  std::stable_sort(see_through.begin(), see_through.end(),
                   [](const Seen& x, const Seen& y) { return x.distance > y.distance; });
  for (const Seen& one : see_through) {
    list.transparent.push_back({one.batch, static_cast<std::uint32_t>(list.instances.size()), 1, one.opacity,
                                one.distance + one.radius, false});
    add(one);
  }
}

Sphere bounds_of(const SceneBatches& scene, const std::vector<math::Pose>& T_world_body) {
  Sphere things{{}, -1.0}, all{{}, -1.0};
  for (const DrawBatch& batch : scene.batches) {
    for (const DrawInstance& instance : batch.instances) {
      const Sphere sphere = bounds_in_world(scene, instance, T_world_body);
      if (sphere.radius < 0.0) continue;
      all = around(all, sphere);
      if (sphere.radius <= kGroundRadius) things = around(things, sphere);
    }
  }
  return things.radius >= 0.0 ? things : all;
}

}  // namespace ambf::render
