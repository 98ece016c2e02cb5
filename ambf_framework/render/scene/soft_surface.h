// The drawn surface of a soft body: where its skin puts the vertices of its mesh on the nodes of a frame, with normals
// that are smooth where the file's are. No OpenGL. Main thread (or whichever thread draws).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/appearance.h"
#include "mesh/mesh.h"
#include "render/camera/camera.h"

namespace ambf::state {
struct Frame;
struct SoftBodyInfo;
struct SoftShape;
}  // namespace ambf::state

namespace ambf::render {

// World positions of the nodes of all soft bodies, in the order of the frame's column; fewer where it has none (a
// diverged world).
void node_positions(const state::Frame& frame, std::vector<math::Vec3>& out);

// One part of a soft body's appearance. Vertices are in the world.
class SoftSurface {
 public:
  // `first_skin`: the skin's vertex that is the part's first.
  SoftSurface(const state::SoftBodyInfo& body, const mesh::AppearancePart& part, std::size_t first_skin);

  // False: these nodes are not those of this body.
  bool pose(const std::vector<math::Vec3>& nodes);

  std::uint32_t object() const { return object_; }  // into Structure::objects
  // A copy of the part's mesh that is this surface's alone, as loaded.
  const std::shared_ptr<const mesh::Mesh>& mesh() const { return mesh_; }
  const std::vector<mesh::Submesh>& submeshes() const { return now_; }
  const Sphere& bounds_world() const { return bounds_; }  // radius below 0: never posed

 private:
  void find_smooth_places();
  bool pose_tube(const math::Vec3* nodes);
  void shade();

  std::uint32_t object_ = 0, first_node_ = 0, nodes_ = 0;
  std::size_t first_skin_ = 0;
  std::shared_ptr<const state::SoftShape> shape_;
  std::shared_ptr<const mesh::Mesh> mesh_;
  std::vector<mesh::Submesh> now_;
  std::vector<std::uint32_t> smooth_;  // of each vertex: those at one place with one normal share a number
  std::vector<math::Vec3> normals_;    // by that number
  Sphere bounds_{{}, -1.0};
};

}  // namespace ambf::render
