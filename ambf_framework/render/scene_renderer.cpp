#include "render/scene_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "render/font.h"
#include "render/shaders.h"

namespace ambf::render {

namespace {

constexpr GLint kSurfaceUnit = 0, kShadowUnit = 1;

float f(double x) { return static_cast<float>(x); }
std::string element(const char* array, std::size_t i) { return std::string(array) + "[" + std::to_string(i) + "]"; }

}  // namespace

bool SceneRenderer::build(std::string& why) {
  make_font();
  return flat_program_.build(gl_, flat_vertex_shader(), flat_fragment_shader(), {"position", "tone", "texcoord"}, why);
}

void SceneRenderer::make_font() {
  constexpr std::string_view kLevels = " .:-=+*%#@";
  std::vector<std::uint8_t> texels;
  for (const char* row : kFontRows) {
    for (const char c : std::string_view(row)) texels.push_back(static_cast<std::uint8_t>(kLevels.find(c) * 255 / 9));
  }
  font_ = GlTexture(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, font_.name());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, kFontAtlasWidth, kFontAtlasHeight, 0, GL_RED, GL_UNSIGNED_BYTE,
                 texels.data());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void SceneRenderer::set_picture(const Picture& picture, Program& p) {
  const Camera& camera = picture.camera;
  const math::Vec3& eye = camera.T_world_camera.position;
  p.set("world_to_clip", world_to_clip_);
  p.set("eye", f(eye.x), f(eye.y), f(eye.z));
  const bool parallel = camera.orthographic_width_m > 0.0;
  const math::Vec3 back = parallel ? backward(camera.T_world_camera) : math::Vec3{};
  p.set("view_back", f(back.x), f(back.y), f(back.z));
  p.set("fade_begin_m", f(0.6 * camera.far_m));
  p.set("fade_end_m", f(parallel ? 10.0 * camera.far_m : camera.far_m));
  const std::vector<Light>& lights = *picture.lights;
  for (std::size_t i = 0; i < std::min<std::size_t>(lights.size(), kMaxLights); ++i) {
    const Light& light = lights[i];
    const math::Vec3 &at = light.point_world, &d = light.direction_world;
    p.set(element("light_point", i).c_str(), f(at.x), f(at.y), f(at.z), f(std::cos(light.cutoff_angle_rad)));
    p.set(element("light_direction", i).c_str(), f(d.x), f(d.y), f(d.z), f(light.spot_exponent));
    p.set(element("light_attenuation", i).c_str(), f(light.attenuation_constant), f(light.attenuation_linear),
          f(light.attenuation_quadratic), f(light.intensity));
  }
  p.set("surface_texture", kSurfaceUnit);
  const ShadowMap& shadows = shared_.shadows();
  if (shadows.light() < 0) return;
  p.set("shadow_map", kShadowUnit);
  p.set("shadow_light", shadows.light());
  p.set("world_to_shadow", shadows.world_to_texture());
  p.set("shadow_texel", f(1.0 / shadows.side()));
  p.set("shadow_offset_m", f(shadows.texel_m()));
}

void SceneRenderer::use_variant(const Picture& picture, const MeshVariant& variant) {
  Program& program = shared_.programs().mesh(variant);
  if (variant_ == &program) return;
  variant_ = &program;
  program.use();
  if (prepared_.insert(&program).second) set_picture(picture, program);
}

void SceneRenderer::set_surface(const Surface& surface) {
  Program& p = *variant_;
  p.set("diffuse", surface.diffuse[0], surface.diffuse[1], surface.diffuse[2]);
  p.set("specular", surface.specular[0], surface.specular[1], surface.specular[2]);
  p.set("emission", surface.emission[0], surface.emission[1], surface.emission[2]);
  p.set("ambient", surface.ambient);
  p.set("alpha", surface.alpha);
  p.set("shininess", surface.shininess);
  gl_.ActiveTexture(GL_TEXTURE0 + kSurfaceUnit);
  gl_.BindTexture(GL_TEXTURE_2D, shared_.gpu().texture(surface.texture_file));
}

void SceneRenderer::draw(const Picture& picture) {
  const Camera& camera = picture.camera;
  const double aspect = static_cast<double>(picture.width) / picture.height;
  world_to_clip_ = projection_matrix(camera, aspect) * view_matrix(camera.T_world_camera);
  const Frustum frustum(world_to_clip_);
  const math::Vec3& eye = camera.T_world_camera.position;
  const DrawScene& scene = shared_.scene();
  fill_draw_list(scene, *picture.T_world_body, &frustum, eye, picture.tint, list_);

  gl_.DepthMask(GL_TRUE);
  gl_.ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Disable(GL_BLEND);

  MeshVariant variant;
  variant.lights = std::clamp(static_cast<int>(picture.lights->size()), 1, kMaxLights);
  if (shared_.shadows().light() >= 0) {
    variant.shadow_taps = picture.soft_shadows ? 4 : 1;
    gl_.ActiveTexture(GL_TEXTURE0 + kShadowUnit);
    gl_.BindTexture(GL_TEXTURE_2D, shared_.shadows().texture());
  }
  prepared_.clear();
  variant_ = nullptr;
  const auto surface = [&](const DrawBatch& batch) {
    variant.textured = !batch.surface.texture_file.empty();
    use_variant(picture, variant);
    set_surface(batch.surface);
  };
  meshes_.upload(list_);
  meshes_.draw(shared_.gpu(), scene, list_.opaque, true, surface);

  draw_background(camera, aspect);

  if (!list_.transparent.empty()) {
    variant_ = nullptr;
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl_.DepthMask(GL_FALSE);
    meshes_.draw(shared_.gpu(), scene, list_.transparent, true, surface);
    gl_.DepthMask(GL_TRUE);
  }
  if (picture.marks != nullptr && !picture.marks->empty()) draw_flat(*picture.marks);
}

// Where nothing was drawn, at the far plane: one triangle over the whole picture.
void SceneRenderer::draw_background(const Camera& camera, double aspect) {
  const float corners[] = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
  const math::Pose& T = camera.T_world_camera;
  const double t = std::tan(camera.field_of_view_rad / 2.0);
  const math::Vec3 ahead = -backward(T), aside = t * aspect * right(T), above = t * up(T);
  Program& program = shared_.programs().background();
  program.use();
  program.set("ahead", f(ahead.x), f(ahead.y), f(ahead.z));
  program.set("aside", f(aside.x), f(aside.y), f(aside.z));
  program.set("above", f(above.x), f(above.y), f(above.z));
  gl_.BindVertexArray(flat_array_.name());
  gl_.BindBuffer(GL_ARRAY_BUFFER, flat_.name());
  gl_.BufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STREAM_DRAW);
  gl_.EnableVertexAttribArray(0);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 3 * sizeof(float), nullptr);
  gl_.DepthMask(GL_FALSE);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.DepthMask(GL_TRUE);
  gl_.BindVertexArray(0);
}

void SceneRenderer::draw_flat(const FlatDrawing& drawing) {
  const std::vector<FlatVertex>& triangles = drawing.triangles();
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  flat_program_.use();
  flat_program_.set("font", kSurfaceUnit);
  gl_.ActiveTexture(GL_TEXTURE0 + kSurfaceUnit);
  gl_.BindTexture(GL_TEXTURE_2D, font_.name());
  gl_.BindVertexArray(flat_array_.name());
  gl_.BindBuffer(GL_ARRAY_BUFFER, flat_.name());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(FlatVertex)), triangles.data(),
                 GL_STREAM_DRAW);
  std::size_t at = 0;
  GLuint index = 0;
  for (const GLint size : {4, 4, 2}) {
    gl_.EnableVertexAttribArray(index);
    gl_.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(FlatVertex), reinterpret_cast<const void*>(at));
    at += static_cast<std::size_t>(size) * sizeof(float);
    ++index;
  }
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
  gl_.BindVertexArray(0);
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_DEPTH_TEST);
}

}  // namespace ambf::render
