#include "render/marks/flat_renderer.h"

#include <cstdint>
#include <vector>

#include "render/marks/detail/font.h"
#include "render/pictures/image_file.h"
#include "render/shaders/shaders.h"

namespace ambf::render {

bool FlatRenderer::build(std::string& why) {
  return make_font(why) &&
         program_.build(gl_, flat_vertex_shader(), flat_fragment_shader(), {"position", "tone", "texcoord"}, why);
}

bool FlatRenderer::make_font(std::string& why) {
  Image atlas;
  if (!read_png({reinterpret_cast<const char*>(kFontAtlasPng), kFontAtlasBytes}, atlas, why)) return false;
  std::vector<std::uint8_t> texels(atlas.rgba.size() / 4);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = atlas.rgba[4 * i];
  font_ = GlTexture(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, font_.name());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width, atlas.height, 0, GL_RED, GL_UNSIGNED_BYTE, texels.data());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return true;
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
