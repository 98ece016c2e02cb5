// assimp's scene as one RawMesh. One thread.
#pragma once

#include <assimp/scene.h>

#include <map>
#include <vector>

#include "mesh/formats/reader_answer.h"

namespace ambf::file_reader {

class SceneConverter {
 public:
  SceneConverter(const aiScene& scene, const mesh::ReaderQuestion& question, mesh::ReaderAnswer& answer)
      : scene_(scene), question_(question), answer_(answer) {}

  // `metres`: one unit of the coordinates; `skip_root`: the root node's transform is assimp's own.
  void convert(double metres, bool skip_root);

 private:
  using Matrix = aiMatrix4x4t<double>;

  bool walk(const aiNode& node, const Matrix& T_scene_parent, int depth);
  bool add_mesh(const aiMesh& mesh, const Matrix& T_scene_mesh);
  void add_faces(const aiMesh& mesh, const std::vector<std::uint32_t>& first, bool mirrored);
  // For each vertex where its mesh is in the scene: as placed by its bones, if it has any.
  std::vector<Matrix> bone_transforms(const aiMesh& mesh) const;
  std::int32_t material_of(const aiMesh& mesh, const aiFace& face);
  bool refuse(const std::string& why);  // always false

  const aiScene& scene_;
  const mesh::ReaderQuestion& question_;
  mesh::ReaderAnswer& answer_;
  std::map<const aiNode*, Matrix> T_scene_node_;
  std::map<std::uint64_t, std::int32_t> painted_;  // material and vertex colour -> material
  std::uint64_t triangles_ = 0;
};

// Appends the scene's materials, and the pictures within the file, in order.
void convert_materials(const aiScene& scene, bool names_are_uris, mesh::ReaderAnswer& answer);

}  // namespace ambf::file_reader
