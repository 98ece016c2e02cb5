// What there is to draw of a Structure: batches of instances with equal geometry and surface, so that 300 equal cubes
// are one draw; and the list of what one camera sees of it. No OpenGL here. Made and used on the main thread.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "render/camera/camera.h"
#include "render/scene/body_looks.h"
#include "render/scene/soft_surface.h"
#include "render/scene/surface.h"
#include "render/shaders/shader_pair.h"
#include "state/structure.h"

namespace ambf::render {

// One mesh for all of equal geometry: bodies with equal primitives each have a mesh of their own.
class MeshIdentity {
 public:
  std::shared_ptr<const mesh::Mesh> representative(const std::shared_ptr<const mesh::Mesh>& mesh);
  // Lets go of every mesh that was not asked for since the last call.
  void forget_unused();

 private:
  struct Known {
    std::shared_ptr<const mesh::Mesh> mesh;  // kept alive, so that its address stays its own
    std::shared_ptr<const mesh::Mesh> representative;
    bool used = false;
  };
  std::unordered_map<const mesh::Mesh*, Known> known_;
  std::multimap<std::uint64_t, const mesh::Mesh*> by_content_;
};

struct DrawInstance {
  // Slot of a body; of soft bodies their slot behind all bodies: body_count + slot.
  std::uint32_t body = 0;
  math::Pose T_body_part;
  double scale = 1.0;
  Sphere bounds_body;                 // body frame
  std::uint32_t soft = state::kNone;  // of soft bodies: index of SceneBatches::soft, whose vertices are in the world
};

struct DrawBatch {
  std::shared_ptr<const mesh::Mesh> mesh;
  std::size_t submesh = 0;
  Surface surface;
  ShaderPair shader;
  std::vector<DrawInstance> instances;
};

struct SceneBatches {
  mesh::Pictures pictures;    // within the files of all meshes that are drawn, equal ones of others too
  std::uint64_t version = 0;  // of the structure
  std::vector<DrawBatch> batches;
  std::uint32_t body_count = 0;   // of the structure
  std::vector<SoftSurface> soft;  // parts of soft bodies
  // The nodes that `soft` shows, and a number that grows when they move by more than can be seen.
  std::vector<math::Vec3> nodes, nodes_seen;
  std::uint64_t soft_moment = 0;
};

SceneBatches make_scene_batches(const state::Structure& structure, MeshIdentity& meshes);

// Brings the surfaces of soft bodies to `nodes`, those of node_positions(). False: they are there already.
bool pose_soft_surfaces(const std::vector<math::Vec3>& nodes, SceneBatches& scene);

// Around an instance; radius below 0: it is not anywhere (yet).
Sphere bounds_in_world(const SceneBatches& scene, const DrawInstance& instance,
                       const std::vector<math::Pose>& T_world_body);

// What the graphics card gets for each instance: three rows of the 3x4 matrix part -> world, and whose part it is.
struct InstanceData {
  std::array<float, 12> rows{};
  float body = 0.0F;  // DrawInstance::body + 1
};

struct DrawCommand {
  std::uint32_t batch = 0;
  std::uint32_t first = 0, count = 0;  // into DrawList::instances
  float opacity = 1.0F;                // times the surface's own
  double reach_m = 0.0;                // from the eye to the far end of its bounds
  bool seen_from_outside = false;      // the near plane cuts none of it open
};

struct DrawList {
  std::vector<InstanceData> instances;
  std::vector<std::uint32_t> bodies;  // DrawInstance::body of each instance
  std::vector<DrawCommand> opaque;
  std::vector<DrawCommand> transparent;  // far to near
  void clear();
};

// What `frustum` sees; all of it when that is null. `eye_world` orders what is transparent. `looks` by slot; empty:
// all as loaded.
void fill_draw_list(const SceneBatches& scene, const std::vector<math::Pose>& T_world_body, const Frustum* frustum,
                    const math::Vec3& eye_world, const std::vector<BodyLook>& looks, DrawList& list);

// Around everything but what is so large that it must be ground or sky (wider than 4 m); around that too when there
// is nothing else.
Sphere bounds_of(const SceneBatches& scene, const std::vector<math::Pose>& T_world_body);

}  // namespace ambf::render
