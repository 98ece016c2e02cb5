#include "render/drawing/depth_compute.h"

namespace ambf::render {

namespace {

// Places of attributes as in gpu_store.h.
constexpr GLuint kPosition = 0, kTexcoord = 2;

float f(double x) { return static_cast<float>(x); }

}  // namespace

DepthCompute::DepthCompute(const Gl& gl) : gl_(gl), vertex_array_(gl), corners_(gl) {
  // x, y, z, u, v of two triangles over the whole picture.
  const float corners[] = {-1, -1, 0, 0, 0, 1, -1, 0, 1, 0, 1,  1, 0, 1, 1,
                           -1, -1, 0, 0, 0, 1, 1,  0, 1, 1, -1, 1, 0, 0, 1};
  constexpr GLsizei kStride = 5 * sizeof(float);
  gl_.BindVertexArray(vertex_array_.name());
  gl_.BindBuffer(GL_ARRAY_BUFFER, corners_.name());
  gl_.BufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
  gl_.EnableVertexAttribArray(kPosition);
  gl_.VertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, kStride, nullptr);
  gl_.EnableVertexAttribArray(kTexcoord);
  gl_.VertexAttribPointer(kTexcoord, 2, GL_FLOAT, GL_FALSE, kStride, reinterpret_cast<const void*>(3 * sizeof(float)));
  gl_.BindVertexArray(0);
}

bool DepthCompute::resize(int width, int height, std::string& why) {
  if (width == width_ && height == height_) return true;
  framebuffer_ = GlFramebuffer(gl_);
  points_ = GlRenderbuffer(gl_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl_.BindRenderbuffer(GL_RENDERBUFFER, points_.name());
  gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_RGBA32F, width, height);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, points_.name());
  const bool good = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  width_ = good ? width : 0;
  height_ = good ? height : 0;
  if (!good) why = "points of " + std::to_string(width) + " x " + std::to_string(height) + " cannot be computed";
  return good;
}

bool DepthCompute::draw(UserProgram& user, GLuint depth_texture, const Camera& camera, int width, int height,
                        std::string& why) {
  if (!resize(width, height, why)) return false;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl_.Viewport(0, 0, width, height);
  gl_.ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, depth_texture);
  Program& p = user.program;
  p.use();
  for (const auto& [name, use] : user.samplers) p.set(name.c_str(), 0);
  const Mat4 identity = to_matrix({});
  p.set("ambf_ModelViewMatrix", identity);
  p.set("ambf_ModelViewProjectionMatrix", identity);
  const Mat4 projection = projection_matrix(camera, static_cast<double>(width) / height);
  p.set("ambf_ProjectionMatrix", projection);
  p.set("invProjection", inverse(projection));
  p.set("nearPlane", f(camera.near_m));
  p.set("farPlane", f(camera.far_m));
  p.set("fieldOfView", f(camera.field_of_view_rad));
  p.set("orthographicWidth", f(camera.orthographic_width_m));
  p.set("imageSize", static_cast<float>(width), static_cast<float>(height));
  gl_.BindVertexArray(vertex_array_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 6);
  gl_.BindVertexArray(0);
  gl_.BindTexture(GL_TEXTURE_2D, 0);
  gl_.Enable(GL_DEPTH_TEST);
  return true;
}

}  // namespace ambf::render
