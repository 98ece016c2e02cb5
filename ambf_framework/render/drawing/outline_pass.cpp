#include "render/drawing/outline_pass.h"

#include <algorithm>
#include <cmath>

#include "render/gl/mesh_attributes.h"

namespace ambf::render {

namespace {

constexpr const char* kMaskVertex = R"(#version 330 core
in vec3 position;
in vec4 row0, row1, row2;
uniform mat4 world_to_clip;
void main() {
  vec4 p = vec4(position, 1.0);
  gl_Position = world_to_clip * vec4(dot(row0, p), dot(row1, p), dot(row2, p), 1.0);
}
)";

constexpr const char* kMaskFragment = R"(#version 330 core
out vec4 color;
void main() { color = vec4(1.0); }
)";

constexpr const char* kEdgeVertex = R"(#version 330 core
in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }
)";

// Outside the mask, and no further from it than the line is wide: two rings of samples.
constexpr const char* kEdgeFragment = R"(#version 330 core
uniform sampler2D mask;
uniform vec2 texel;
uniform float width_px;
uniform vec3 line_color;
out vec4 color;
void main() {
  vec2 at = gl_FragCoord.xy * texel;
  float inside = texture(mask, at).r, near = 0.0;
  for (int i = 0; i < 8; ++i) {
    float angle = 0.785398 * float(i);
    vec2 way = width_px * texel * vec2(cos(angle), sin(angle));
    near = max(near, max(texture(mask, at + way).r, texture(mask, at + 0.5 * way).r));
  }
  color = vec4(line_color, near * (1.0 - inside));
}
)";

constexpr float kLineColor[3] = {1.0F, 0.55F, 0.08F};  // orange, seen on bright and on dark

float f(double x) { return static_cast<float>(x); }

}  // namespace

bool OutlinePass::build(std::string& why) {
  built_ = built_ || (mask_program_.build(gl_, kMaskVertex, kMaskFragment, AMBF_MESH_ATTRIBUTES, why) &&
                      edge_program_.build(gl_, kEdgeVertex, kEdgeFragment, {"position"}, why));
  return built_;
}

void OutlinePass::choose(const SceneBatches& scene, const Bodies& bodies, const Camera& camera,
                         const Mat4& world_to_clip) {
  const Frustum frustum(world_to_clip);
  fill_draw_list(scene, bodies.T_world_body, &frustum, camera.T_world_camera.position, bodies.looks, list_);
  chosen_.clear();
  bounds_world_.clear();
  const auto is_outlined = [&](std::uint32_t body) {
    return std::find(bodies.outlined.begin(), bodies.outlined.end(), body) != bodies.outlined.end();
  };
  for (const std::vector<DrawCommand>* commands : {&list_.opaque, &list_.transparent}) {
    for (const DrawCommand& command : *commands) {
      for (std::uint32_t i = command.first; i < command.first + command.count; ++i) {
        if (is_outlined(list_.bodies[i])) chosen_.push_back({command.batch, i, 1});
      }
    }
  }
  for (const DrawBatch& batch : scene.batches) {
    for (const DrawInstance& instance : batch.instances) {
      if (!is_outlined(instance.body)) continue;
      const Sphere bounds = bounds_in_world(scene, instance, bodies.T_world_body);
      if (bounds.radius >= 0.0) bounds_world_.push_back(bounds);
    }
  }
}

// The corners of the cubes around all bounds, on the picture; all of it where one of them lies behind the eye.
OutlinePass::Rectangle OutlinePass::covered(const Mat4& world_to_clip, double margin_px, int width, int height) const {
  double left = width, right = 0.0, bottom = height, top = 0.0;
  for (const Sphere& bounds : bounds_world_) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto side = [&](int bit) { return (corner & bit) != 0 ? bounds.radius : -bounds.radius; };
      const math::Vec3 point = bounds.centre + math::Vec3{side(1), side(2), side(4)};
      const std::array<double, 4> clip = transform(world_to_clip, point);
      if (clip[3] <= 0.0) return {0, 0, width, height};
      const double x = (0.5 + 0.5 * clip[0] / clip[3]) * width, y = (0.5 + 0.5 * clip[1] / clip[3]) * height;
      left = std::min(left, x);
      right = std::max(right, x);
      bottom = std::min(bottom, y);
      top = std::max(top, y);
    }
  }
  const auto within = [](double at, int most) { return static_cast<int>(std::clamp(at, 0.0, 1.0 * most)); };
  const int from_x = within(std::floor(left - margin_px), width),
            from_y = within(std::floor(bottom - margin_px), height);
  return {from_x, from_y, within(std::ceil(right + margin_px), width) - from_x,
          within(std::ceil(top + margin_px), height) - from_y};
}

bool OutlinePass::draw(SharedStore& shared, const Bodies& bodies, const Camera& camera, double width_px, Canvas& canvas,
                       std::string& why) {
  if (!build(why)) return false;
  const int width = canvas.width(), height = canvas.height();
  const Mat4 world_to_clip =
      projection_matrix(camera, static_cast<double>(width) / height) * view_matrix(camera.T_world_camera);
  choose(shared.scene(), bodies, camera, world_to_clip);
  if (chosen_.empty()) return true;
  const Rectangle part = covered(world_to_clip, width_px + 1.0, width, height);
  if (part.width <= 0 || part.height <= 0) return true;

  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(part.left, part.bottom, part.width, part.height);
  mask_.resize(width, height, false);
  mask_.bind();
  gl_.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  mask_program_.use();
  mask_program_.set("world_to_clip", world_to_clip);
  meshes_.upload(list_);
  meshes_.draw(shared.gpu(), shared.scene(), chosen_, true, nullptr);

  canvas.bind();
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, mask_.color());
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  edge_program_.use();
  edge_program_.set("mask", 0);
  edge_program_.set("texel", f(1.0 / width), f(1.0 / height));
  edge_program_.set("width_px", f(width_px));
  edge_program_.set("line_color", kLineColor[0], kLineColor[1], kLineColor[2]);
  screen_.draw();
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Enable(GL_DEPTH_TEST);
  return true;
}

}  // namespace ambf::render
