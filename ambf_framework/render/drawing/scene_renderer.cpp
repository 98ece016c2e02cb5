#include "render/drawing/scene_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/shaders/shaders.h"

namespace ambf::render {

namespace {

constexpr GLenum kAnisotropy = 0x84FE;  // as in gpu_store.cpp; needed only where Mesa draws, which has it
constexpr GLint kSharp = 4;             // texels along the slant; more is not seen but costs
constexpr int kFine = 128;          // texels: Mesa blurs smaller textures, seen from near, by its anisotropic filter
constexpr double kFadeBegin = 0.6;  // of the far plane's distance: things behind it fade into the background
constexpr double kConeBlur = 0.35;  // of a cone of light, in cosines from its edge to its axis: brightens inwards
constexpr int kPeels = 4;           // layers of transparent surfaces that are distinguished

float f(double x) { return static_cast<float>(x); }
std::string element(const char* array, std::size_t i) { return std::string(array) + "[" + std::to_string(i) + "]"; }

}  // namespace

SceneRenderer::SceneRenderer(const Gl& gl, SharedStore& shared)
    : gl_(gl),
      shared_(shared),
      meshes_(gl),
      screen_(gl),
      sky_cube_(gl),
      occlusion_(gl),
      peel_a_(gl),
      peel_b_(gl),
      peeled_(gl),
      depth_reader_(gl),
      sharp_(gl) {
  gl_.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_.SamplerParameteri(depth_reader_.name(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
  gl_.SamplerParameteri(depth_reader_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_.SamplerParameteri(depth_reader_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl_.SamplerParameteri(sharp_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_.SamplerParameteri(sharp_.name(), kAnisotropy, kSharp);
}

void SceneRenderer::set_picture(const Picture& picture, Program& p) {
  const Camera& camera = picture.camera;
  const math::Vec3& eye = camera.T_world_camera.position;
  p.set("world_to_clip", world_to_clip_);
  p.set("eye", f(eye.x), f(eye.y), f(eye.z));
  const bool parallel = camera.orthographic_width_m > 0.0;
  const math::Vec3 back = parallel ? backward(camera.T_world_camera) : math::Vec3{};
  p.set("view_back", f(back.x), f(back.y), f(back.z));
  p.set("fade_begin_m", f(kFadeBegin * camera.far_m));
  p.set("fade_end_m", f(parallel ? 10.0 * camera.far_m : camera.far_m));
  const std::vector<Light>& lights = *picture.lights;
  for (std::size_t i = 0; i < std::min<std::size_t>(lights.size(), kMaxLights); ++i) {
    const Light& light = lights[i];
    const math::Vec3 &at = light.point_world, &d = light.direction_world;
    const double constant = is_attenuated(light) ? 1.0 : std::max(light.attenuation_constant, 1e-3);
    p.set(element("light_point", i).c_str(), f(at.x), f(at.y), f(at.z), f(light.intensity / constant));
    p.set(element("light_direction", i).c_str(), f(d.x), f(d.y), f(d.z), f(light.spot_exponent));
    p.set(element("light_attenuation", i).c_str(), f(light.attenuation_constant), f(light.attenuation_linear),
          f(light.attenuation_quadratic));
    const double edge = std::cos(light.cutoff_angle_rad), per_cosine = 1.0 / std::max(kConeBlur * (1.0 - edge), 1e-6);
    p.set(element("light_cone", i).c_str(), f(per_cosine), f(-per_cosine * edge));
  }
  const Surroundings& around = shared_.sky().surroundings();
  p.set("around_up", around.up[0], around.up[1], around.up[2]);
  p.set("around_down", around.down[0], around.down[1], around.down[2]);
  p.set("surface_texture", kSurfaceUnit);
  p.set("normal_map", kNormalUnit);
  p.set("sky_texture", kSkyUnit);
  p.set("nearer_depth", kNearerUnit);
  p.set("opaque_depth", kOpaqueUnit);
  p.set("shadow_map", kShadowUnit);
  p.set("shadow_depth", kShadowDepthUnit);
  const std::vector<ShadowView>& views = shared_.shadows().views();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ShadowView& view = views[i];
    p.set(element("world_to_shadow", i).c_str(), view.world_to_texture);
    p.set(element("shadow_tile", i).c_str(), view.tile[0], view.tile[1], view.tile[2], view.tile[3]);
    p.set(element("shadow_lens", i).c_str(), view.lens[0], view.lens[1], view.lens[2], view.lens[3]);
    p.set(element("shadow_texel", i).c_str(), view.texel[0], view.texel[1], view.texel[2]);
  }
}

void SceneRenderer::use_variant(const Picture& picture, const MeshVariant& variant) {
  Program& program = shared_.programs().mesh(variant);
  if (variant_ == &program) return;
  variant_ = &program;
  program.use();
  if (prepared_.insert(&program).second) set_picture(picture, program);
}

void SceneRenderer::bind(int unit, GLuint texture) {
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(GL_TEXTURE_2D, texture);
}

void SceneRenderer::set_surface(const DrawBatch& batch, float opacity) {
  const Surface& surface = batch.surface;
  Program& p = *variant_;
  p.set("diffuse", surface.diffuse[0], surface.diffuse[1], surface.diffuse[2]);
  p.set("specular", surface.specular[0], surface.specular[1], surface.specular[2]);
  p.set("emission", surface.emission[0], surface.emission[1], surface.emission[2]);
  p.set("ambient", surface.ambient);
  p.set("alpha", surface.alpha * opacity);
  p.set("shininess", surface.shininess);
  p.set("metallic", surface.metallic);
}

void SceneRenderer::draw_batches(const Picture& picture, const std::vector<DrawCommand>& commands) {
  ours_.clear();
  for (const DrawCommand& command : commands) {
    const ShaderPair& files = picture.all_bodies_shader != nullptr ? *picture.all_bodies_shader
                                                                   : shared_.scene().batches[command.batch].shader;
    UserProgram* user = files.empty() ? nullptr : shared_.user_shaders().program(files);
    if (user == nullptr) {
      ours_.push_back(command);
    } else {
      draw_theirs(picture, command, *user);
    }
  }
  if (!ours_.empty()) draw_ours(picture, ours_);
}

void SceneRenderer::draw_ours(const Picture& picture, const std::vector<DrawCommand>& commands) {
  const GpuStore& gpu = shared_.gpu();
  MeshVariant variant = base_;
  // On a graphics card textures are always sharp; here that takes more than twice the time, so only pictures of the
  // best quality are.
  const bool sharp = picture.sharp_textures && gpu.in_software();
  GLenum culled = GL_NONE;
  // What lies on the far side of a closed surface would be shaded wherever it is drawn before the near side.
  const auto cull = [&](GLenum face) {
    if (face == culled) return;
    face == GL_NONE ? gl_.Disable(GL_CULL_FACE) : gl_.Enable(GL_CULL_FACE);
    if (face != GL_NONE) gl_.CullFace(face);
    culled = face;
  };
  meshes_.draw(gpu, shared_.scene(), commands, true,
               [&](const DrawBatch& batch, const GpuStore::Part& part, const DrawCommand& command) {
                 const GpuStore::Texture* color = gpu.texture(batch.surface.texture_file, TextureUse::color);
                 const GpuStore::Texture* normals =
                     picture.normal_maps ? gpu.texture(batch.surface.normal_map_file, TextureUse::normal) : nullptr;
                 variant.textured = color != nullptr;
                 variant.cut_out =
                     color != nullptr && color->has_alpha && !batch.surface.transparent() && command.opacity >= 1.0F;
                 variant.normal_mapped = normals != nullptr;
                 variant.metallic = batch.surface.metallic > 0.0F;
                 variant.fades = command.reach_m > kFadeBegin * picture.camera.far_m;
                 const bool one_side =
                     command.seen_from_outside && part.facing != mesh::Facing::mixed && !variant.cut_out;
                 cull(!one_side ? GL_NONE : part.facing == mesh::Facing::outwards ? GL_BACK : GL_FRONT);
                 if (color != nullptr) bind(kSurfaceUnit, color->name.name());
                 if (normals != nullptr) bind(kNormalUnit, normals->name.name());
                 if (sharp) gl_.BindSampler(kSurfaceUnit, color != nullptr && color->side >= kFine ? sharp_.name() : 0);
                 use_variant(picture, variant);
                 set_surface(batch, command.opacity);
               });
  cull(GL_NONE);
  if (sharp) gl_.BindSampler(kSurfaceUnit, 0);
}

void SceneRenderer::prepare() {
  base_ = {};
  base_.lights = shared_.shadows().lights();
  base_.sky = shared_.sky().shown();
  prepared_.clear();
  variant_ = nullptr;
  bind(kShadowUnit, shared_.shadows().texture());
  bind(kShadowDepthUnit, shared_.shadows().texture());
  bind(kWhiteUnit, shared_.gpu().white());
  gl_.BindSampler(kShadowDepthUnit, depth_reader_.name());
  gl_.ActiveTexture(GL_TEXTURE0 + kSkyUnit);
  gl_.BindTexture(GL_TEXTURE_CUBE_MAP, shared_.sky().texture());
}

void SceneRenderer::draw(const Picture& picture, Canvas& canvas) {
  const Camera& camera = picture.camera;
  const double aspect = static_cast<double>(canvas.width()) / canvas.height();
  world_to_eye_ = view_matrix(camera.T_world_camera);
  eye_to_clip_ = projection_matrix(camera, aspect);
  world_to_clip_ = eye_to_clip_ * world_to_eye_;
  const Frustum frustum(world_to_clip_);
  prepare();
  fill_draw_list(shared_.scene(), *picture.T_world_body, &frustum, camera.T_world_camera.position, *picture.looks,
                 list_);

  canvas.bind();
  gl_.DepthMask(GL_TRUE);
  gl_.ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Disable(GL_BLEND);

  const bool masked = picture.all_bodies_shader != nullptr, users_sky = !masked && draw_users_sky(picture);
  meshes_.upload(list_);
  draw_batches(picture, list_.opaque);
  if (picture.occlusion && !masked) occlusion_.apply(shared_.programs(), screen_, camera, canvas);
  if (!masked && !users_sky) draw_background(camera, aspect);
  if (!list_.transparent.empty()) {
    variant_ = nullptr;
    if (picture.multipass) {
      draw_peeled(picture, canvas);
    } else {
      draw_transparent(picture);
    }
  }
  gl_.BindSampler(kShadowDepthUnit, 0);
}

// Far things first, and of each its far side first.
void SceneRenderer::draw_transparent(const Picture& picture) {
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.DepthMask(GL_FALSE);
  gl_.Enable(GL_CULL_FACE);
  one_.resize(1);
  for (const DrawCommand& command : list_.transparent) {
    const DrawBatch& batch = shared_.scene().batches[command.batch];
    const bool inside_out = shared_.gpu().mesh(batch.mesh.get()).parts[batch.submesh].inside_out;
    one_[0] = command;
    for (const bool front : {false, true}) {
      gl_.CullFace(front != inside_out ? GL_BACK : GL_FRONT);
      draw_batches(picture, one_);
    }
  }
  gl_.Disable(GL_CULL_FACE);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_BLEND);
}

// The nearest transparent surface of each pixel, then the next behind it, and so on (Everitt, Interactive
// Order-Independent Transparency): right for things that cross each other or lie inside one another.
void SceneRenderer::draw_peeled(const Picture& picture, Canvas& canvas) {
  const GLuint opaque_depth = canvas.depth_texture();
  for (Layer* layer : {&peel_a_, &peel_b_, &peeled_}) {
    layer->resize(canvas.width(), canvas.height(), layer != &peeled_);
  }
  gl_.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  peeled_.bind();
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  peel_b_.bind();
  gl_.ClearDepth(0.0);  // nothing lies before the first layer
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.ClearDepth(1.0);
  base_.peeled = true;
  Layer *current = &peel_a_, *nearer = &peel_b_;
  for (int peel = 0; peel < kPeels; ++peel) {
    current->bind();
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    bind(kNearerUnit, nearer->depth());
    bind(kOpaqueUnit, opaque_depth);
    variant_ = nullptr;
    draw_batches(picture, list_.transparent);

    // Under what is there already.
    peeled_.bind();
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Enable(GL_BLEND);
    gl_.BlendFuncSeparate(GL_ONE_MINUS_DST_ALPHA, GL_ONE, GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    bind(kSurfaceUnit, current->color());
    shared_.programs().layer().use();
    shared_.programs().layer().set("layer", kSurfaceUnit);
    shared_.programs().layer().set("weighted", 1.0F);
    screen_.draw();
    gl_.Disable(GL_BLEND);
    gl_.Enable(GL_DEPTH_TEST);
    std::swap(current, nearer);
  }
  base_.peeled = false;
  canvas.bind();
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bind(kSurfaceUnit, peeled_.color());
  shared_.programs().layer().use();
  shared_.programs().layer().set("weighted", 0.0F);
  screen_.draw();
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_DEPTH_TEST);
}

// Where nothing was drawn, at the far plane: one triangle over the whole picture.
void SceneRenderer::draw_background(const Camera& camera, double aspect) {
  const math::Pose& T = camera.T_world_camera;
  const PicturePlane seen = picture_plane(camera, aspect);
  const math::Vec3 ahead = seen.middle_right * right(T) + seen.middle_up * up(T) - backward(T);
  const math::Vec3 aside = seen.half_width * right(T), above = seen.slant * right(T) + seen.half_height * up(T);
  Program& program = shared_.programs().background(shared_.sky().shown());
  program.use();
  program.set("sky_texture", kSkyUnit);
  program.set("ahead", f(ahead.x), f(ahead.y), f(ahead.z));
  program.set("aside", f(aside.x), f(aside.y), f(aside.z));
  program.set("above", f(above.x), f(above.y), f(above.z));
  gl_.DepthMask(GL_FALSE);
  screen_.draw();
  gl_.DepthMask(GL_TRUE);
}

}  // namespace ambf::render
