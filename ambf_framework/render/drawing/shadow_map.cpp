#include "render/drawing/shadow_map.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/hash.h"
#include "render/shaders/shaders.h"

namespace ambf::render {

namespace {

constexpr int kLargestSide = 4096;       // texels, of all tiles together
constexpr double kLightShare = 0.035;    // radius of a lamp, of its distance to the scene: ADF has no sizes
constexpr double kSunRadius_rad = 0.02;  // larger than the sun's 0.005: a softer day

// Equal for equal structures, lights' properties and quality; never 0.
std::uint64_t setting_of(const SceneBatches& scene, const std::vector<BodyLook>& looks,
                         const std::vector<Light>& lights, const Quality& quality) {
  base::Fnv1a hash;
  hash.add_word(static_cast<double>(scene.version));
  hash.add_word(static_cast<double>(quality.shadow_side));
  hash.add_word(static_cast<double>(quality.shadow_filter));
  for (std::size_t slot = 0; slot < looks.size(); ++slot) {
    if (!looks[slot].has_faces() || looks[slot].opacity < 1.0F) hash.add_word(static_cast<double>(slot));
  }
  for (const Light& light : lights) {
    hash.add_word(static_cast<double>(light.kind));
    hash.add_word(static_cast<double>(light.shadow_quality));
    hash.add_word(light.cutoff_angle_rad);
    hash.add_word(is_focused(light) ? 1.0 : 0.0);
    hash.add_word(is_attenuated(light) ? 1.0 : 0.0);
  }
  return hash.value() | 1U;
}

// Equal for equal places of bodies and lights, but for the trembling of what is held in place; never 0.
std::uint64_t moment_of(const SceneBatches& scene, const std::vector<math::Pose>& T_world_body,
                        const std::vector<Light>& lights) {
  constexpr double kUnseen = 2e-5;  // m, and of a unit quaternion
  base::Fnv1a hash;
  hash.add_word(scene.soft_moment);
  const auto mix = [&](std::initializer_list<double> values) {
    for (const double x : values) hash.add_word(std::round(x / kUnseen));
  };
  for (const math::Pose& T : T_world_body) {
    mix({T.position.x, T.position.y, T.position.z});
    mix({T.orientation.x, T.orientation.y, T.orientation.z, T.orientation.w});
  }
  for (const Light& light : lights) {
    mix({light.point_world.x, light.point_world.y, light.point_world.z});
    mix({light.direction_world.x, light.direction_world.y, light.direction_world.z});
  }
  return hash.value() | 1U;
}

float f(double x) { return static_cast<float>(x); }

}  // namespace

bool ShadowMap::build(std::string& why) {
  resize(1, 1);  // a sampler must have something to read
  return program_.build(gl_, shadow_vertex_shader(), shadow_fragment_shader(), AMBF_MESH_ATTRIBUTES, why);
}

void ShadowMap::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  depth_ = GlTexture(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, depth_.name());
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, width, height, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                 nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
}

void ShadowMap::update(const Context& context, const SceneBatches& scene, const std::vector<math::Pose>& T_world_body,
                       const std::vector<BodyLook>& looks, const std::vector<Light>& lights, const Quality& quality) {
  if (quality.shadow_interval == 0) {
    lights_.clear();
    for (const Light& light : lights)
      lights_.push_back({light.kind, ShadowFilter::none, 0, is_focused(light), is_attenuated(light)});
    views_.clear();
    setting_ = 0;
    return;
  }
  const std::uint64_t setting = setting_of(scene, looks, lights, quality);
  const std::uint64_t moment = moment_of(scene, T_world_body, lights);
  if (moment != seen_) ++missed_;
  seen_ = moment;
  if (setting == setting_ && (moment == shown_ || missed_ < quality.shadow_interval)) return;
  setting_ = setting;
  shown_ = moment;
  missed_ = 0;
  plan(lights, bounds_of(scene, T_world_body), quality);
  if (!tiles_.empty()) render(context, scene, T_world_body, looks);
}

// Which light gets which pictures, and where they lie in the texture.
void ShadowMap::plan(const std::vector<Light>& lights, const Sphere& bounds, const Quality& quality) {
  lights_.clear();
  tiles_.clear();
  views_.clear();
  std::vector<double> radii_m;
  for (const Light& light : lights) {
    LightVariant variant{light.kind, ShadowFilter::none, 0, is_focused(light), is_attenuated(light)};
    if (light.shadow_quality > 0) {
      const std::vector<Camera> cameras = shadow_cameras(light, bounds);
      if (!cameras.empty()) variant.filter = std::min(shadow_filter(light.shadow_quality), quality.shadow_filter);
      variant.shadow_views = static_cast<int>(cameras.size());
      const double distance_m = std::max(math::norm(bounds.centre - light.point_world), 0.5 * bounds.radius);
      for (const Camera& camera : cameras) {
        int side = std::min(shadow_map_side(light.shadow_quality), quality.shadow_side);
        if (cameras.size() > 1) side /= 2;
        tiles_.push_back({camera, 0, 0, side, distance_m});
        radii_m.push_back(light.kind == state::LightType::directional ? kSunRadius_rad : kLightShare * distance_m);
      }
    }
    lights_.push_back(variant);
  }
  if (tiles_.empty()) return;
  place_tiles();
  for (std::size_t i = 0; i < tiles_.size(); ++i) views_.push_back(view_of(tiles_[i], radii_m[i]));
}

// Rows of tiles from the left, halved until all fit.
void ShadowMap::place_tiles() {
  for (;;) {
    int widest = 0;
    for (const Tile& tile : tiles_) widest = std::max(widest, tile.side);
    const int row_width = tiles_.size() > 1 ? std::max(2 * widest, kLargestSide / 2) : widest;
    int x = 0, y = 0, row_height = 0, width = 0;
    for (Tile& tile : tiles_) {
      if (x + tile.side > row_width) {
        x = 0;
        y += row_height;
        row_height = 0;
      }
      tile.x = x;
      tile.y = y;
      x += tile.side;
      width = std::max(width, x);
      row_height = std::max(row_height, tile.side);
    }
    if (y + row_height <= kLargestSide && width <= kLargestSide) {
      resize(width, y + row_height);
      return;
    }
    for (Tile& tile : tiles_) tile.side = std::max(tile.side / 2, 16);
  }
}

ShadowView ShadowMap::view_of(const Tile& tile, double light_radius_m) const {
  const Camera& camera = tile.camera;
  const double u = static_cast<double>(tile.side) / width_, v = static_cast<double>(tile.side) / height_;
  const double left = static_cast<double>(tile.x) / width_, low = static_cast<double>(tile.y) / height_;
  Mat4 to_tile;
  to_tile.m = {f(0.5 * u),       0,    0,   0, 0, f(0.5 * v), 0, 0, 0, 0, 0.5F, 0, f(left + 0.5 * u),
               f(low + 0.5 * v), 0.5F, 1.0F};
  const bool parallel = camera.orthographic_width_m > 0.0;
  const double width_at_1_m = parallel ? camera.orthographic_width_m : 2.0 * std::tan(camera.field_of_view_rad / 2.0);
  const double width_m = parallel ? width_at_1_m : width_at_1_m * tile.distance_m;
  const double edge = 0.5 / tile.side;  // half a texel, so that the neighbour tile is not blended in
  ShadowView view;
  view.world_to_texture = to_tile * (projection_matrix(camera, 1.0) * view_matrix(camera.T_world_camera));
  view.tile = {f(left + edge * u), f(low + edge * v), f(left + (1.0 - edge) * u), f(low + (1.0 - edge) * v)};
  view.lens = {f(camera.near_m), f(camera.far_m), f(light_radius_m / width_at_1_m * tile.side), parallel ? 1.0F : 0.0F};
  view.texel = {f(1.0 / width_), f(1.0 / height_), f(width_m / tile.side)};
  return view;
}

void ShadowMap::render(const Context& context, const SceneBatches& scene, const std::vector<math::Pose>& T_world_body,
                       const std::vector<BodyLook>& looks) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, context.framebuffer);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  gl_.DrawBuffer(GL_NONE);
  gl_.ReadBuffer(GL_NONE);
  gl_.DepthMask(GL_TRUE);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(1.5F, 2.0F);
  program_.use();
  for (const Tile& tile : tiles_) {
    const Mat4 world_to_clip = projection_matrix(tile.camera, 1.0) * view_matrix(tile.camera.T_world_camera);
    const Frustum frustum(world_to_clip);
    fill_draw_list(scene, T_world_body, &frustum, tile.camera.T_world_camera.position, looks, list_);
    gl_.Viewport(tile.x, tile.y, tile.side, tile.side);
    program_.set("world_to_clip", world_to_clip);
    context.meshes.upload(list_);
    context.meshes.draw(context.store, scene, list_.opaque, false, nullptr);  // what is transparent throws no shadow
  }
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  ++drawn_;
}

}  // namespace ambf::render
