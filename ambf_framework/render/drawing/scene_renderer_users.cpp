// SceneRenderer: what users' shaders draw, bodies and skies.
#include "render/drawing/fixed_function.h"
#include "render/drawing/scene_renderer.h"

namespace ambf::render {

namespace {

constexpr GLuint kColorAttribute = 9;  // beyond those of meshes (gpu_store.h)

int unit_of(SamplerUse use) {
  switch (use) {
    case SamplerUse::color: return kSurfaceUnit;
    case SamplerUse::normal_map: return kNormalUnit;
    case SamplerUse::shadow_compare: return kShadowUnit;
    case SamplerUse::shadow_depth: return kShadowDepthUnit;
    case SamplerUse::sky: return kSkyUnit;
    case SamplerUse::nearer_depth: return kNearerUnit;
    case SamplerUse::opaque_depth: return kOpaqueUnit;
    case SamplerUse::white: return kWhiteUnit;
    case SamplerUse::black: return kBlackUnit;
    case SamplerUse::volume: return kVolumeUnit;
  }
  return kSurfaceUnit;
}

}  // namespace

void SceneRenderer::bind_samplers(const Picture& picture, const DrawBatch& batch, UserProgram& user) {
  const GpuStore& gpu = shared_.gpu();
  const GpuStore::Texture* color = gpu.texture(batch.surface.texture_file, TextureUse::raw);
  const GpuStore::Texture* normals =
      picture.normal_maps ? gpu.texture(batch.surface.normal_map_file, TextureUse::normal) : nullptr;
  bind(kSurfaceUnit, color != nullptr ? color->name.name() : gpu.white());
  bind(kNormalUnit, normals != nullptr ? normals->name.name() : gpu.white());
  user.program.set("vEnableNormalMapping", normals != nullptr ? 1 : 0);
  user.program.set("uTextureEnabled", color != nullptr ? 1 : 0);
  for (const auto& [name, use] : user.samplers) user.program.set(name.c_str(), unit_of(use));
  user.program.set("ambf_Peeled", base_.peeled ? 1 : 0);
}

// Theirs take the place of one body at a time.
void SceneRenderer::draw_theirs(const Picture& picture, const DrawCommand& command, UserProgram& user) {
  const DrawBatch& batch = shared_.scene().batches[command.batch];
  variant_ = nullptr;
  user.program.use();
  if (prepared_.insert(&user.program).second) {
    set_fixed_function_picture(user.program, world_to_eye_, eye_to_clip_, *picture.lights);
    set_fixed_function_shadow(user.program, world_to_eye_, shared_.shadows());
  }
  Surface surface = batch.surface;
  surface.alpha *= command.opacity;
  set_fixed_function_material(user.program, surface);
  user.program.set("ambf_AlphaIsShadow", surface.transparent() ? 0 : 1);
  bind_samplers(picture, batch, user);
  gl_.VertexAttrib4f(kColorAttribute, 1.0F, 1.0F, 1.0F, 1.0F);  // files of ours bring no colours of vertices
  std::vector<DrawCommand> one(1, command);
  for (std::uint32_t i = command.first; i < command.first + command.count; ++i) {
    one[0].first = i;
    one[0].count = 1;
    set_fixed_function_place(user.program, world_to_eye_, eye_to_clip_, list_.instances[i]);
    meshes_.draw(shared_.gpu(), shared_.scene(), one, true, nullptr);
  }
}

// Behind everything. False when there is none, or none that compiles.
bool SceneRenderer::draw_users_sky(const Picture& picture) {
  if (shared_.sky_shader().empty() || !shared_.sky().shown()) return false;
  UserProgram* user = shared_.user_shaders().program(shared_.sky_shader());
  if (user == nullptr) return false;
  const Camera& camera = picture.camera;
  const Mat4 place = to_matrix({camera.T_world_camera.position, {}}, 0.5 * camera.far_m);
  InstanceData instance;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) instance.rows[4 * row + column] = place.m[4 * column + row];
  }
  user->program.use();
  set_fixed_function_picture(user->program, world_to_eye_, eye_to_clip_, *picture.lights);
  Mat4 turned = world_to_eye_;  // a sky is around the camera wherever that is
  for (const std::size_t i : {12, 13, 14}) turned.m[i] = 0.0F;
  user->program.set("viewMat", turned);
  set_fixed_function_place(user->program, world_to_eye_, eye_to_clip_, instance);
  for (const auto& [name, use] : user->samplers) user->program.set(name.c_str(), unit_of(use));
  user->program.set("ambf_Peeled", 0);
  gl_.ActiveTexture(GL_TEXTURE0 + kSkyUnit);
  gl_.BindTexture(GL_TEXTURE_CUBE_MAP, shared_.sky().texture_for_users());
  gl_.Disable(GL_DEPTH_TEST);
  gl_.DepthMask(GL_FALSE);
  sky_cube_.draw();
  gl_.DepthMask(GL_TRUE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.BindTexture(GL_TEXTURE_CUBE_MAP, shared_.sky().texture());
  return true;
}

}  // namespace ambf::render
