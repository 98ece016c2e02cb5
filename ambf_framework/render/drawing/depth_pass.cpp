#include "render/drawing/depth_pass.h"

namespace ambf::render {

namespace {

constexpr float kUnseenAlpha = 0.02F;  // surfaces below this do not count

constexpr const char* kVertex = R"(#version 330 core
in vec3 position, normal;
in vec2 texcoord;
in vec4 row0, row1, row2;
in float body;
uniform mat4 world_to_clip;
uniform vec4 view_axis;  // distance along the view = dot(xyz, point) + w
out float distance_m;
flat out float whose;
void main() {
  vec4 p = vec4(position, 1.0);
  vec4 point = vec4(dot(row0, p), dot(row1, p), dot(row2, p), 1.0);
  distance_m = dot(view_axis, point);
  whose = body;
  gl_Position = world_to_clip * point;
}
)";

constexpr const char* kFragment = R"(#version 330 core
in float distance_m;
flat in float whose;
out vec2 measured;
void main() { measured = vec2(distance_m, whose); }
)";

}  // namespace

bool DepthPass::build(std::string& why) { return program_.build(gl_, kVertex, kFragment, AMBF_MESH_ATTRIBUTES, why); }

bool DepthPass::resize(int width, int height, std::string& why) {
  if (width == width_ && height == height_) return true;
  framebuffer_ = GlFramebuffer(gl_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  measured_ = GlRenderbuffer(gl_);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, measured_.name());
  gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_RG32F, width, height);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, measured_.name());
  depth_ = GlTexture(gl_);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, depth_.name());
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width, height, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    gl_.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  }
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  gl_.BindTexture(GL_TEXTURE_2D, 0);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    width_ = height_ = 0;
    why = "depth of " + std::to_string(width) + " x " + std::to_string(height) + " cannot be drawn";
    return false;
  }
  width_ = width;
  height_ = height;
  return true;
}

bool DepthPass::draw(const GpuStore& store, const SceneBatches& scene, const std::vector<math::Pose>& T_world_body,
                     const Camera& camera, int width, int height, std::string& why) {
  if (!resize(width, height, why)) return false;
  const Mat4 world_to_clip =
      projection_matrix(camera, static_cast<double>(width) / height) * view_matrix(camera.T_world_camera);
  const math::Vec3& eye = camera.T_world_camera.position;
  const Frustum frustum(world_to_clip);
  fill_draw_list(scene, T_world_body, &frustum, eye, {}, list_);
  std::vector<DrawCommand> seen = list_.opaque;
  for (const DrawCommand& command : list_.transparent) {
    if (scene.batches[command.batch].surface.alpha >= kUnseenAlpha) seen.push_back(command);
  }

  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl_.Viewport(0, 0, width, height);
  gl_.DepthMask(GL_TRUE);
  gl_.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_BLEND);
  const math::Vec3 ahead = -backward(camera.T_world_camera);
  const auto f = [](double x) { return static_cast<float>(x); };
  program_.use();
  program_.set("world_to_clip", world_to_clip);
  program_.set("view_axis", f(ahead.x), f(ahead.y), f(ahead.z), f(-math::dot(ahead, eye)));
  meshes_.upload(list_);
  meshes_.draw(store, scene, seen, true, nullptr);
  return true;
}

}  // namespace ambf::render
