#include "render/shadow_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/shaders.h"

namespace ambf::render {

namespace {

// Equal for equal places of bodies and lights (FNV-1a over words); never 0.
std::uint64_t moment_of(const DrawScene& scene, const std::vector<math::Pose>& T_world_body,
                        const std::vector<Light>& lights, int largest_side) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  const auto mix = [&](double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3ULL;
    hash ^= hash >> 29;
  };
  mix(static_cast<double>(scene.version));
  mix(largest_side);
  for (const math::Pose& T : T_world_body) {
    for (const double x : {T.position.x, T.position.y, T.position.z, T.orientation.x, T.orientation.y, T.orientation.z,
                           T.orientation.w}) {
      mix(x);
    }
  }
  for (const Light& light : lights) {
    const math::Vec3 &p = light.point_world, &d = light.direction_world;
    for (const double x : {p.x, p.y, p.z, d.x, d.y, d.z, light.cutoff_angle_rad}) mix(x);
    mix(light.shadow_quality);
  }
  return hash | 1U;
}

}  // namespace

bool ShadowMap::build(std::string& why) {
  resize(1);  // a sampler must have something to read
  return program_.build(gl_, shadow_vertex_shader(), shadow_fragment_shader(), AMBF_MESH_ATTRIBUTES, why);
}

void ShadowMap::resize(int side) {
  if (side == side_) return;
  side_ = side;
  depth_ = GlTexture(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, depth_.name());
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, side, side, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
}

void ShadowMap::update(const Context& context, const DrawScene& scene, const std::vector<math::Pose>& T_world_body,
                       const std::vector<Light>& lights, const Quality& quality) {
  if (quality.shadow_interval == 0) {
    light_ = -1;
    shown_ = 0;
    return;
  }
  const std::uint64_t moment = moment_of(scene, T_world_body, lights, quality.shadow_side);
  if (moment != seen_) ++missed_;
  seen_ = moment;
  if (moment == shown_ || (shown_ != 0 && missed_ < quality.shadow_interval)) return;
  missed_ = 0;
  shown_ = moment;
  render(context, scene, T_world_body, lights, quality.shadow_side);
}

void ShadowMap::render(const Context& context, const DrawScene& scene, const std::vector<math::Pose>& T_world_body,
                       const std::vector<Light>& lights, int largest_side) {
  light_ = -1;
  int first = 0;
  while (first < static_cast<int>(lights.size()) && lights[static_cast<std::size_t>(first)].shadow_quality <= 0)
    ++first;
  if (first == static_cast<int>(lights.size())) return;
  const Light& light = lights[static_cast<std::size_t>(first)];
  const Sphere bounds = bounds_of(scene, T_world_body);
  Camera camera;
  if (!shadow_camera(light, bounds, camera)) return;
  light_ = first;
  resize(std::min(shadow_map_side(light.shadow_quality), largest_side));
  const Mat4 world_to_clip = projection_matrix(camera, 1.0) * view_matrix(camera.T_world_camera);
  Mat4 half;
  half.m = {0.5F, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0, 0.5F, 0, 0.5F, 0.5F, 0.5F, 1.0F};
  world_to_texture_ = half * world_to_clip;
  texel_m_ = 2.0 * std::tan(camera.field_of_view_rad / 2.0) *
             math::norm(bounds.centre - camera.T_world_camera.position) / side_;

  const Frustum frustum(world_to_clip);
  fill_draw_list(scene, T_world_body, &frustum, light.point_world, {}, list_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, context.framebuffer);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  gl_.DrawBuffer(GL_NONE);
  gl_.ReadBuffer(GL_NONE);
  gl_.Viewport(0, 0, side_, side_);
  gl_.DepthMask(GL_TRUE);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(1.5F, 2.0F);
  program_.use();
  program_.set("world_to_clip", world_to_clip);
  context.meshes.upload(list_);
  context.meshes.draw(context.store, scene, list_.opaque, false, nullptr);  // what is transparent throws no shadow
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace ambf::render
