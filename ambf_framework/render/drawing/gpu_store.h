// Meshes and textures on the graphics card: each uploaded once whatever the number of bodies and windows, deleted
// when the scene no longer names it. Shared by all windows of one share group. Main thread, context current. Private
// to render/.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "mesh/facing.h"
#include "render/gl/handle.h"
#include "render/gl/mesh_attributes.h"
#include "render/images/texture_loader.h"
#include "render/scene/scene_batches.h"

namespace ambf::render {

class GpuStore {
 public:
  explicit GpuStore(const Gl& gl);

  // What users' shaders need besides: which meshes have tangents, and whether textures are wanted as the file gives
  // them.
  struct Wishes {
    std::set<const mesh::Mesh*> tangents;
    std::set<std::string> raw_textures;
  };
  // Brings the card in line with `scene`; textures come later (collect).
  void prepare(const SceneBatches& scene, const Wishes& wishes);
  // Vertices, normals and tangents of a mesh of `scene` that changes its shape: as many as it was prepared with.
  void reshape(const mesh::Mesh* mesh, const std::vector<mesh::Submesh>& now);
  // Takes over the textures that were decoded since; until then surfaces have their plain colour. Findings (textures
  // that cannot be read) are returned once.
  base::Diagnostics collect();
  // Waits until none is missing.
  base::Diagnostics finish();

  struct Part {
    std::size_t first_index = 0, triangle_indices = 0, line_indices = 0;  // lines follow the triangles
    bool inside_out = false;                                              // triangles are wound against their normals
    mesh::Facing facing = mesh::Facing::mixed;
  };
  struct MeshBuffers {
    std::shared_ptr<const mesh::Mesh> mesh;
    GlBuffer vertices, indices;
    GlBuffer tangents;        // tangent (w: handedness) and bitangent; none where nobody asked
    std::vector<Part> parts;  // one a submesh
  };
  const MeshBuffers& mesh(const mesh::Mesh* mesh) const { return meshes_.at(mesh); }

  struct Texture {
    GlTexture name;          // none: not there yet, or never
    bool has_alpha = false;  // some of it is not opaque
    int side = 0;            // texels, the longer one
  };
  // Null when there is none (yet).
  const Texture* texture(const std::string& file, TextureUse use) const;
  GLuint white() const { return white_.name(); }

  std::size_t mesh_count() const { return meshes_.size(); }
  std::size_t texture_count() const { return textures_.size(); }

  std::uint64_t textures_taken() const { return textures_taken_; }  // so far

  bool in_software() const { return software_; }

 private:
  void upload_mesh(const std::shared_ptr<const mesh::Mesh>& mesh);
  void upload_tangents(MeshBuffers& buffers, const std::vector<mesh::Submesh>& submeshes, GLenum usage);
  void upload_texture(const Decoded& decoded);

  const Gl& gl_;
  const bool software_;
  std::unordered_map<const mesh::Mesh*, MeshBuffers> meshes_;
  std::map<TextureKey, Texture> textures_;
  std::uint64_t textures_taken_ = 0;
  GlTexture white_;
  float anisotropy_ = 1.0F;
  TextureLoader loader_;
};

}  // namespace ambf::render
