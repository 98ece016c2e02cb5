// Draws a WorldShapes list over a finished scene, with the scene's depth still there. One a context; costs nothing
// while lists are empty (its shaders are compiled when the first one is not). Words are not drawn here but laid out
// as marks (label_layout.h). Main thread, context current. Private to render/.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "render/camera/camera.h"
#include "render/gl/handle.h"
#include "render/gl/program.h"
#include "render/marks/world_shapes.h"
#include "render/scene/scene_batches.h"

namespace ambf::render {

class WorldShapesRenderer {
 public:
  explicit WorldShapesRenderer(const Gl& gl) : gl_(gl) {}

  // Into the framebuffer that is bound. False with the compiler's words when the shaders do not compile here.
  bool draw(const WorldShapes& list, const Camera& camera, int width_px, int height_px, std::string& why);

 private:
  struct MeshBuffers {
    std::shared_ptr<const mesh::Mesh> mesh;
    GlBuffer vertices, indices;  // triangles, then edges, sharp ones first
    GLsizei triangle_indices = 0, sharp_indices = 0, edge_indices = 0;
    bool used = false;
  };
  struct Instance {
    std::array<float, 12> rows{};  // three rows of mesh -> world
    DebugColor faces{}, edges{};
  };
  struct Group {
    const MeshBuffers* buffers = nullptr;
    bool all_edges = false;
    std::vector<Instance> instances;
  };

  bool build(std::string& why);
  void stream(const void* data, std::size_t bytes);
  void draw_meshes(const WorldShapes& list);
  void draw_group(const Group& group, bool edges);
  void draw_triangles(const WorldShapes& list);
  void draw_lines(const WorldShapes& list, int width_px, int height_px);
  const MeshBuffers& buffers_of(const std::shared_ptr<const mesh::Mesh>& mesh);
  // Once for what is seen, once, fainter, for what is hidden but shows through.
  template <class Draw>
  void draw_seen(Program& program, bool in_front, bool through, bool always, Draw&& draw);

  const Gl& gl_;
  bool built_ = false;
  Mat4 world_to_clip_;
  math::Vec3 eye_;
  Program line_program_, fill_program_, mesh_program_;
  GlVertexArray vertex_array_;
  GlBuffer stream_;
  MeshIdentity identity_;
  std::unordered_map<const mesh::Mesh*, MeshBuffers> meshes_;
};

}  // namespace ambf::render
