#include "render/shaders/programs.h"

#include "render/gl/mesh_attributes.h"

namespace ambf::render {

bool Programs::build(std::string& why) {
  // The richest variant, so that a driver that cannot compile ours says so now.
  MeshVariant all;
  all.lights.assign(2, {state::LightType::spot, ShadowFilter::contact, 1, true, true});
  all.textured = all.normal_mapped = all.metallic = all.sky = all.fades = all.peeled = true;
  const auto screen = [&](Program& program, const std::string& fragment) {
    return program.build(gl_, screen_vertex_shader(), fragment, {"position"}, why);
  };
  const auto background = [&](Program& program, bool sky) {
    return program.build(gl_, background_vertex_shader(), background_fragment_shader(sky), {"position"}, why);
  };
  return meshes_[all].build(gl_, mesh_vertex_shader(all), mesh_fragment_shader(all), AMBF_MESH_ATTRIBUTES, why) &&
         background(gradient_, false) && background(skybox_, true) && screen(occlusion_, occlusion_fragment_shader()) &&
         screen(occlusion_blur_, occlusion_blur_fragment_shader()) && screen(layer_, layer_fragment_shader());
}

Program& Programs::mesh(const MeshVariant& variant) {
  const auto known = meshes_.find(variant);
  if (known != meshes_.end()) return known->second;
  Program& program = meshes_[variant];
  std::string why;  // the richest variant compiled, so this one does
  program.build(gl_, mesh_vertex_shader(variant), mesh_fragment_shader(variant), AMBF_MESH_ATTRIBUTES, why);
  return program;
}

}  // namespace ambf::render
