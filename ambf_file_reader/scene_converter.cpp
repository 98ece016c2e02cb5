#include "scene_converter.h"

#include <algorithm>
#include <cmath>

namespace ambf::file_reader {

using mesh::RawMesh;

namespace {

constexpr int kMaxDepth = 500;
constexpr std::size_t kMaxPainted = 256;

aiMatrix4x4t<double> to_double(const aiMatrix4x4& m) {
  return {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4};
}

double determinant(const aiMatrix4x4t<double>& m) { return aiMatrix3x3t<double>(m).Determinant(); }

// How normals turn: the cofactors of the upper left 3x3 (the inverse transpose but for its length).
aiVector3t<double> turn_normal(const aiMatrix4x4t<double>& m, const aiVector3D& n) {
  return {(m.b2 * m.c3 - m.b3 * m.c2) * n.x + (m.b3 * m.c1 - m.b1 * m.c3) * n.y + (m.b1 * m.c2 - m.b2 * m.c1) * n.z,
          (m.a3 * m.c2 - m.a2 * m.c3) * n.x + (m.a1 * m.c3 - m.a3 * m.c1) * n.y + (m.a2 * m.c1 - m.a1 * m.c2) * n.z,
          (m.a2 * m.b3 - m.a3 * m.b2) * n.x + (m.a3 * m.b1 - m.a1 * m.b3) * n.y + (m.a1 * m.b2 - m.a2 * m.b1) * n.z};
}

void append(std::vector<float>& out, const aiVector3t<double>& v) {
  out.insert(out.end(), {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
}

}  // namespace

bool SceneConverter::refuse(const std::string& why) {
  answer_.error = why;
  answer_.raw = RawMesh{};
  return false;
}

void SceneConverter::convert(double metres, bool skip_root) {
  convert_materials(scene_, question_.ending == "gltf" || question_.ending == "glb", answer_);
  if (scene_.mRootNode == nullptr) {
    refuse("the file holds no scene");
    return;
  }
  Matrix T_scene_root;
  aiMatrix4x4t<double>::Scaling({metres, metres, metres}, T_scene_root);
  if (skip_root) T_scene_root = T_scene_root * to_double(scene_.mRootNode->mTransformation).Inverse();
  // Where all nodes are is known before meshes are placed: bones may come later than what they carry.
  std::vector<std::pair<const aiNode*, Matrix>> open{{scene_.mRootNode, T_scene_root}};
  while (!open.empty() && T_scene_node_.size() < 100000) {
    const auto [node, T_scene_parent] = open.back();
    open.pop_back();
    const Matrix T_scene_node = T_scene_parent * to_double(node->mTransformation);
    T_scene_node_[node] = T_scene_node;
    for (unsigned i = 0; i < node->mNumChildren; ++i) open.emplace_back(node->mChildren[i], T_scene_node);
  }
  if (!walk(*scene_.mRootNode, T_scene_root, 0)) return;
  if (scene_.HasAnimations()) answer_.information.push_back("animations are not read");
}

bool SceneConverter::walk(const aiNode& node, const Matrix& T_scene_parent, int depth) {
  if (depth > kMaxDepth) return refuse("its nodes are nested more than " + std::to_string(kMaxDepth) + " deep");
  const Matrix T_scene_node = T_scene_parent * to_double(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    if (node.mMeshes[i] >= scene_.mNumMeshes) return refuse("a node names a mesh that does not exist");
    if (!add_mesh(*scene_.mMeshes[node.mMeshes[i]], T_scene_node)) return false;
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    if (!walk(*node.mChildren[i], T_scene_node, depth + 1)) return false;
  }
  return true;
}

std::vector<SceneConverter::Matrix> SceneConverter::bone_transforms(const aiMesh& mesh) const {
  std::vector<Matrix> placed;
  if (!mesh.HasBones()) return placed;
  const Matrix none = Matrix() * 0.0;
  std::vector<double> weights(mesh.mNumVertices, 0.0);
  placed.assign(mesh.mNumVertices, none);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    const auto node = T_scene_node_.find(scene_.mRootNode->FindNode(bone.mName));
    if (node == T_scene_node_.end()) return {};
    const Matrix T_scene_mesh = node->second * to_double(bone.mOffsetMatrix);
    for (unsigned k = 0; k < bone.mNumWeights; ++k) {
      const aiVertexWeight& w = bone.mWeights[k];
      if (w.mVertexId >= mesh.mNumVertices) return {};
      placed[w.mVertexId] = placed[w.mVertexId] + T_scene_mesh * static_cast<double>(w.mWeight);
      weights[w.mVertexId] += static_cast<double>(w.mWeight);
    }
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] < 1e-6) return {};  // a vertex that no bone carries: the node places them all
    placed[i] = placed[i] * (1.0 / weights[i]);
  }
  return placed;
}

bool SceneConverter::add_mesh(const aiMesh& mesh, const Matrix& T_scene_mesh) {
  RawMesh& raw = answer_.raw;
  if (raw.position_count() + mesh.mNumVertices > 4 * question_.max_vertices) return refuse("it has too many vertices");
  // assimp splits vertices: equal ones are joined here, so that limits and welding count what the file has.
  const std::vector<Matrix> bones = bone_transforms(mesh);
  std::vector<std::uint32_t> position_of(mesh.mNumVertices);
  std::map<std::array<float, 3>, std::uint32_t> known;
  const bool mirrored = determinant(bones.empty() ? T_scene_mesh : bones.front()) < 0.0;
  const auto first_normal = static_cast<std::uint32_t>(raw.normals.size() / 3);
  const auto first_texcoord = static_cast<std::uint32_t>(raw.texcoords.size() / 2);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const Matrix& T = bones.empty() ? T_scene_mesh : bones[i];
    const aiVector3D& v = mesh.mVertices[i];
    const aiVector3t<double> p = T * aiVector3t<double>(v.x, v.y, v.z);
    const std::array<float, 3> place{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    if (!std::all_of(place.begin(), place.end(), [](float f) { return std::isfinite(f); })) {
      return refuse("a coordinate is not a finite number");
    }
    const auto [it, added] = known.emplace(place, static_cast<std::uint32_t>(raw.position_count()));
    if (added) raw.positions.insert(raw.positions.end(), place.begin(), place.end());
    position_of[i] = it->second;
    if (mesh.HasNormals()) {
      const aiVector3t<double> n = turn_normal(T, mesh.mNormals[i]);
      const double length = std::sqrt(n * n);
      const bool usable = std::isfinite(length) && length > 0.0;
      append(raw.normals, usable ? n * ((mirrored ? -1.0 : 1.0) / length) : aiVector3t<double>());
    }
    if (mesh.HasTextureCoords(0)) {
      for (const float f : {mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y}) {
        raw.texcoords.push_back(std::isfinite(f) ? f : 0.0F);
      }
    }
  }
  if (raw.position_count() > question_.max_vertices) {
    return refuse("it has more than " + std::to_string(question_.max_vertices) + " vertices");
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) return refuse("a face names a vertex that does not exist");
    }
    if (face.mNumIndices < 2) continue;  // points are not drawn
    const std::int32_t material = material_of(mesh, face);
    if (face.mNumIndices == 2) {
      raw.lines.push_back({position_of[face.mIndices[0]], position_of[face.mIndices[1]], material});
      continue;
    }
    triangles_ += face.mNumIndices - 2;
    if (triangles_ > question_.max_triangles) {
      return refuse("it has more than " + std::to_string(question_.max_triangles) + " triangles");
    }
    mesh::RawFace out;
    out.first = static_cast<std::uint32_t>(raw.corners.size());
    out.count = face.mNumIndices;
    out.material = material;
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const unsigned i = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
      raw.corners.push_back({position_of[i], mesh.HasTextureCoords(0) ? first_texcoord + i : mesh::kNoIndex,
                             mesh.HasNormals() ? first_normal + i : mesh::kNoIndex});
    }
    raw.faces.push_back(out);
  }
  return true;
}

// A mesh has colours for its materials alone: faces with colours at their corners get a material of the mean.
std::int32_t SceneConverter::material_of(const aiMesh& mesh, const aiFace& face) {
  const std::size_t materials = scene_.mNumMaterials;
  const std::int32_t own = mesh.mMaterialIndex < materials ? static_cast<std::int32_t>(mesh.mMaterialIndex) : -1;
  if (!mesh.HasVertexColors(0)) return own;
  aiColor4D mean;
  for (unsigned k = 0; k < face.mNumIndices; ++k) mean = mean + mesh.mColors[0][face.mIndices[k]];
  mean = mean * (1.0F / static_cast<float>(face.mNumIndices));
  std::uint64_t key = static_cast<std::uint32_t>(own);
  for (const float part : {mean.r, mean.g, mean.b, mean.a}) {
    key = key << 8 | static_cast<std::uint64_t>(std::lround(255.0F * (part > 0.0F ? std::min(part, 1.0F) : 0.0F)));
  }
  const auto known = painted_.find(key);
  if (known != painted_.end()) return known->second;
  if (painted_.size() >= kMaxPainted) return own;
  mesh::Material material = own >= 0 ? answer_.raw.materials[mesh.mMaterialIndex] : mesh::Material{};
  const auto part = [key](int shift) { return static_cast<float>(key >> shift & 0xFF) / 255.0F; };
  material.diffuse = {part(24), part(16), part(8), part(0)};
  const auto index = static_cast<std::int32_t>(answer_.raw.materials.size());
  answer_.raw.materials.push_back(std::move(material));
  painted_.emplace(key, index);
  return index;
}

}  // namespace ambf::file_reader
