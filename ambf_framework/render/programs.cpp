#include "render/programs.h"

#include "render/gpu_store.h"

namespace ambf::render {

bool Programs::build(std::string& why) {
  // The largest variant, so that a driver that cannot compile ours says so now.
  const MeshVariant all{kMaxLights, 4, true};
  return meshes_[all].build(gl_, mesh_vertex_shader(all), mesh_fragment_shader(all), AMBF_MESH_ATTRIBUTES, why) &&
         background_.build(gl_, background_vertex_shader(), background_fragment_shader(), {"position"}, why);
}

Program& Programs::mesh(const MeshVariant& variant) {
  const auto known = meshes_.find(variant);
  if (known != meshes_.end()) return known->second;
  Program& program = meshes_[variant];
  std::string why;  // the largest variant compiled, so this one does
  program.build(gl_, mesh_vertex_shader(variant), mesh_fragment_shader(variant), AMBF_MESH_ATTRIBUTES, why);
  return program;
}

}  // namespace ambf::render
