// From a body's description to its physics body, controller and appearance: meshes, collision shape, centre of mass,
// inertia, gains. Loader thread only. Shapes and meshes are shared between equal bodies.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/appearance.h"
#include "mesh/cache.h"
#include "model/detail/findings.h"
#include "model/detail/live_objects.h"
#include "physics/shape.h"
#include "scene/description.h"

namespace ambf::model {

// What a body takes from its model.
struct BodySurroundings {
  math::Pose T_world_model;
  std::optional<math::Vec3> gravity;   // of the model, for bodies without their own
  std::uint32_t no_collision_set = 0;  // not 0: bodies of this model do not collide with each other
  double step_s = 0.001;               // gains are judged by it
  state::ShaderFiles shaders;          // of the model, for bodies without their own
};

struct BuiltBody {
  std::unique_ptr<LiveBody> live;  // without slots
  std::shared_ptr<const mesh::Appearance> appearance, collision_appearance;
};

class BodyBuilder {
 public:
  explicit BodyBuilder(mesh::MeshCache& meshes) : meshes_(meshes) {}

  // Decodes all mesh files of these bodies at once, on several threads; build() then finds them in the cache.
  void prefetch(const std::vector<scene::Body>& bodies);
  BuiltBody build(const scene::Body& body, const BodySurroundings& surroundings, Findings& findings);
  // Lets go of meshes and shape sources that nobody uses.
  void trim();

 private:
  std::shared_ptr<const mesh::Mesh> load(const std::string& file, const std::vector<std::string>& candidates,
                                         const scene::Identity& body, const char* key, Findings& findings);
  // Each placed mesh that could be read, at its own scale times `body_scale`.
  std::vector<mesh::AppearancePart> placed_meshes(const std::vector<scene::PlacedMesh>& meshes, double body_scale,
                                                  const scene::Identity& body, const char* key, Findings& findings);
  std::shared_ptr<const mesh::Mesh> stretched(const std::shared_ptr<const mesh::Mesh>& mesh, const math::Vec3& factors);
  std::shared_ptr<const physics::MeshSource> source_of(const std::shared_ptr<const mesh::Mesh>& mesh);
  std::shared_ptr<const mesh::Mesh> primitive(const scene::Geometry& geometry);
  // Null where there is nothing.
  std::shared_ptr<mesh::Appearance> drawn_shapes(const std::vector<scene::PlacedGeometry>& shapes, double scale,
                                                 const std::vector<mesh::AppearancePart>& meshes);

  struct Stretched {
    std::weak_ptr<const mesh::Mesh> original, mesh;
  };

  mesh::MeshCache& meshes_;
  std::map<std::shared_ptr<const mesh::CollisionMesh>, std::shared_ptr<const physics::MeshSource>> sources_;
  std::map<std::pair<const mesh::Mesh*, std::array<double, 3>>, Stretched> stretched_;
  std::map<std::vector<double>, std::weak_ptr<const mesh::Mesh>> primitives_;
};

}  // namespace ambf::model
