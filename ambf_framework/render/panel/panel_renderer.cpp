#include "render/panel/detail/panel_renderer.h"

#include <imgui/imgui.h>

namespace ambf::render {

void PanelRenderer::upload_fonts(ImFontAtlas& fonts) {
  unsigned char* texels = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsAlpha8(&texels, &width, &height);
  renderer_.set_font(texels, width, height);
}

bool PanelRenderer::draw(const ImDrawData& drawing, ImFontAtlas& fonts, unsigned fonts_version, unsigned context,
                         const PanelPaper& paper, std::string& why) {
  if (!built_ && !renderer_.build(why)) return false;
  built_ = true;
  if (fonts_version != fonts_version_) {
    upload_fonts(fonts);
    fonts_version_ = fonts_version;
  }
  auto array = arrays_.find(context);
  if (array == arrays_.end()) array = arrays_.emplace(context, GlVertexArray(gl_)).first;
  renderer_.begin(array->second.name(), drawing.DisplaySize.x, drawing.DisplaySize.y);
  const auto width_px = static_cast<GLsizei>(drawing.DisplaySize.x),
             height_px = static_cast<GLsizei>(drawing.DisplaySize.y);
  gl_.Scissor(static_cast<GLint>(paper.left), 0, width_px - static_cast<GLint>(paper.left), height_px);
  gl_.ClearColor(paper.red, paper.green, paper.blue, 1.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  for (int n = 0; n < drawing.CmdListsCount; ++n) renderer_.draw(*drawing.CmdLists[n]);
  renderer_.end();
  return true;
}

void PanelRenderer::forget(unsigned context) { arrays_.erase(context); }

}  // namespace ambf::render
