#include "render/text/text_renderer.h"

#include <imgui/imgui.h>

namespace ambf::render {

void TextRenderer::draw(const TextDrawing& drawing) {
  if (drawing.lists().empty()) return;
  if (letters_ != drawing.letters()) {
    letters_ = drawing.letters();
    const auto [texels, width, height] = letters_->texels();
    renderer_.set_font(texels, width, height);
  }
  renderer_.begin(array_.name(), static_cast<float>(drawing.width()), static_cast<float>(drawing.height()));
  for (const auto& list : drawing.lists()) renderer_.draw(*list);
  renderer_.end();
}

}  // namespace ambf::render
