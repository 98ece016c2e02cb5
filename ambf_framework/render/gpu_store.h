// Meshes and textures on the graphics card: each uploaded once whatever the number of bodies and windows, deleted when the scene no
// longer names it. Shared by all windows of one share group. Main thread, context current. Private to render/.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "render/draw_scene.h"
#include "render/gl/handle.h"

namespace ambf::render {

// Vertex attributes, as all programs that draw meshes bind them. 3..5 and 6 are InstanceData.
enum class Attribute : GLuint { position, normal, texcoord, row0, row1, row2, tint };
#define AMBF_MESH_ATTRIBUTES \
  { "position", "normal", "texcoord", "row0", "row1", "row2", "tint" }

class GpuStore {
 public:
  explicit GpuStore(const Gl& gl);

  // Brings the card in line with `scene`. Findings (textures that cannot be read) are returned once.
  base::Diagnostics prepare(const DrawScene& scene);

  struct Part {
    std::size_t first_index = 0, triangle_indices = 0, line_indices = 0;  // lines follow the triangles
  };
  struct MeshBuffers {
    std::shared_ptr<const mesh::Mesh> mesh;
    GlBuffer vertices, indices;
    std::vector<Part> parts;  // one a submesh
  };
  const MeshBuffers& mesh(const mesh::Mesh* mesh) const { return meshes_.at(mesh); }
  // A white texel when there is none.
  GLuint texture(const std::string& file) const;

  std::size_t mesh_count() const { return meshes_.size(); }
  std::size_t texture_count() const { return textures_.size(); }

 private:
  void upload_mesh(const std::shared_ptr<const mesh::Mesh>& mesh);
  GlTexture upload_texture(const std::string& file, base::Diagnostics& diagnostics) const;

  const Gl& gl_;
  const GLint min_filter_;
  std::unordered_map<const mesh::Mesh*, MeshBuffers> meshes_;
  std::map<std::string, GlTexture> textures_;
  GlTexture white_;
};

}  // namespace ambf::render
