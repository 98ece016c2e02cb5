#include "render/text/imgui_renderer.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cstddef>

namespace ambf::render {

namespace {

constexpr const char* kVertex = R"(#version 330 core
in vec2 position;
in vec2 texcoord;
in vec4 tone;
uniform vec2 size;
out vec2 at;
out vec4 color;
void main() {
  at = texcoord;
  color = tone;
  gl_Position = vec4(position.x / size.x * 2.0 - 1.0, 1.0 - position.y / size.y * 2.0, 0.0, 1.0);
}
)";
constexpr const char* kFragment = R"(#version 330 core
in vec2 at;
in vec4 color;
uniform sampler2D font;
out vec4 shown;
void main() { shown = vec4(color.rgb, color.a * texture(font, at).r); }
)";

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

bool ImGuiRenderer::build(std::string& why) {
  if (!program_.build(gl_, kVertex, kFragment, {"position", "texcoord", "tone"}, why)) return false;
  vertices_ = GlBuffer(gl_);
  indices_ = GlBuffer(gl_);
  return true;
}

void ImGuiRenderer::set_font(const unsigned char* texels, int width, int height) {
  font_ = GlTexture(gl_);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, font_.name());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, texels);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void ImGuiRenderer::begin(GLuint vertex_array, float width_px, float height_px) {
  height_px_ = height_px;
  gl_.BindVertexArray(vertex_array);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  constexpr GLsizei kStride = sizeof(ImDrawVert);
  for (const GLuint index : {0U, 1U, 2U}) gl_.EnableVertexAttribArray(index);
  gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(ImDrawVert, pos)));
  gl_.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(ImDrawVert, uv)));
  gl_.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, offset(offsetof(ImDrawVert, col)));
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.Enable(GL_SCISSOR_TEST);
  program_.use();
  program_.set("font", 0);
  program_.set("size", width_px, height_px);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, font_.name());
}

void ImGuiRenderer::draw(const ImDrawList& list) {
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.VtxBuffer.size_in_bytes()), list.VtxBuffer.Data,
                 GL_STREAM_DRAW);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.IdxBuffer.size_in_bytes()), list.IdxBuffer.Data,
                 GL_STREAM_DRAW);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const ImVec4& clip = command.ClipRect;
    const auto left = static_cast<GLint>(std::max(0.0F, clip.x));
    const auto bottom = static_cast<GLint>(std::max(0.0F, height_px_ - clip.w));
    const auto width = static_cast<GLint>(clip.z) - left;
    const auto height = static_cast<GLint>(height_px_ - clip.y) - bottom;
    if (command.UserCallback != nullptr || width <= 0 || height <= 0 || command.ElemCount == 0) continue;
    gl_.Scissor(left, bottom, width, height);
    gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                              sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                              offset(command.IdxOffset * sizeof(ImDrawIdx)), 1);
  }
}

void ImGuiRenderer::end() {
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.BindVertexArray(0);
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_DEPTH_TEST);
}

}  // namespace ambf::render
