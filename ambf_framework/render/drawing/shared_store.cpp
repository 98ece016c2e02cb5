#include "render/drawing/shared_store.h"

namespace ambf::render {

bool SharedStore::build(std::string& why) { return programs_.build(why) && shadows_.build(why); }

base::Diagnostics SharedStore::take(const state::Structure& structure) {
  if (!scene_made_ || scene_.version != structure.version) {
    scene_made_ = true;
    scene_ = make_scene_batches(structure, meshes_);
    sky_shader_ = structure.look == nullptr ? ShaderPair() : shader_pair(structure.look->skybox.shaders);
    gpu_.prepare(scene_, wishes_of_user_shaders(structure));
  }
  base::Diagnostics findings = gpu_.collect();
  if (structure.look != nullptr) {
    for (base::Diagnostic& finding : sky_.take(structure.look->skybox)) findings.push_back(std::move(finding));
  }
  for (base::Diagnostic& finding : user_shaders_.take_findings()) findings.push_back(std::move(finding));
  return findings;
}

void SharedStore::pose(const std::vector<math::Vec3>& nodes) {
  if (!pose_soft_surfaces(nodes, scene_)) return;
  for (const SoftSurface& surface : scene_.soft) gpu_.reshape(surface.mesh().get(), surface.submeshes());
}

base::Diagnostics SharedStore::finish_textures() {
  base::Diagnostics findings = gpu_.finish();
  for (base::Diagnostic& finding : sky_.finish()) findings.push_back(std::move(finding));
  return findings;
}

GpuStore::Wishes SharedStore::wishes_of_user_shaders(const state::Structure& structure) {
  GpuStore::Wishes wishes;
  // Those of cameras draw every body.
  std::vector<ShaderPair> of_all;
  for (const state::CameraInfo& camera : structure.cameras) {
    if (camera.preprocessing_shaders.given()) of_all.push_back(shader_pair(camera.preprocessing_shaders));
  }
  for (const DrawBatch& batch : scene_.batches) {
    std::vector<ShaderPair> shaders = of_all;
    if (!batch.shader.empty()) shaders.push_back(batch.shader);
    for (const ShaderPair& shader : shaders) {
      const UserProgram* user = user_shaders_.program(shader);
      if (user == nullptr) continue;
      if (user->wants_tangents) wishes.tangents.insert(batch.mesh.get());
      if (!batch.surface.texture_file.empty()) wishes.raw_textures.insert(batch.surface.texture_file);
    }
  }
  if (!sky_shader_.empty()) user_shaders_.program(sky_shader_);
  user_shaders_.forget_unused();
  return wishes;
}

}  // namespace ambf::render
