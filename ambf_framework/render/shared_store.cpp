#include "render/shared_store.h"

namespace ambf::render {

bool SharedStore::build(std::string& why) { return programs_.build(why) && shadows_.build(why); }

base::Diagnostics SharedStore::take(const state::Structure& structure) {
  if (!scene_made_ || scene_.version != structure.version) {
    scene_made_ = true;
    scene_ = make_draw_scene(structure, meshes_);
    gpu_.prepare(scene_, wishes_of_user_shaders());
  }
  base::Diagnostics findings = gpu_.collect();
  for (base::Diagnostic& finding : user_shaders_.take_findings()) findings.push_back(std::move(finding));
  return findings;
}

GpuStore::Wishes SharedStore::wishes_of_user_shaders() {
  GpuStore::Wishes wishes;
  for (const DrawBatch& batch : scene_.batches) {
    if (batch.shader.empty()) continue;
    const UserProgram* user = user_shaders_.program(batch.shader);
    if (user == nullptr) continue;
    if (user->wants_tangents) wishes.tangents.insert(batch.mesh.get());
    if (!batch.surface.texture_file.empty()) wishes.raw_textures.insert(batch.surface.texture_file);
  }
  user_shaders_.forget_unused();
  return wishes;
}

}  // namespace ambf::render
