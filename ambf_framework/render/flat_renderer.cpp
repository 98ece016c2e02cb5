#include "render/flat_renderer.h"

#include <string_view>
#include <vector>

#include "render/font.h"
#include "render/shaders.h"

namespace ambf::render {

bool FlatRenderer::build(std::string& why) {
  make_font();
  return program_.build(gl_, flat_vertex_shader(), flat_fragment_shader(), {"position", "tone", "texcoord"}, why);
}

void FlatRenderer::make_font() {
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

void FlatRenderer::draw(const FlatDrawing& drawing) {
  const std::vector<FlatVertex>& triangles = drawing.triangles();
  if (triangles.empty()) return;
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  program_.use();
  program_.set("font", 0);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, font_.name());
  gl_.BindVertexArray(array_.name());
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_.name());
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
