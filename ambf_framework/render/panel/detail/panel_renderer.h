// Draws the panel over the bound framebuffer of any window. Main thread, context current.
#pragma once

#include <map>
#include <string>

#include "render/gl/handle.h"
#include "render/text/imgui_renderer.h"

struct ImDrawData;
struct ImFontAtlas;

namespace ambf::render {

// What lies behind the panel: everything to the right of `left`, in one colour. Cleared, not blended: where the
// processor draws, that is most of what the panel costs.
struct PanelPaper {
  float left = 0.0F;  // px
  float red = 0.0F, green = 0.0F, blue = 0.0F;
};

class PanelRenderer {
 public:
  explicit PanelRenderer(const Gl& gl) : gl_(gl), renderer_(gl) {}

  // `context`: number of the current one; vertex arrays belong to one each. False with the reason in `why`.
  bool draw(const ImDrawData& drawing, ImFontAtlas& fonts, unsigned fonts_version, unsigned context,
            const PanelPaper& paper, std::string& why);
  void forget(unsigned context);  // which is current, and about to end

 private:
  void upload_fonts(ImFontAtlas& fonts);

  const Gl& gl_;
  bool built_ = false;
  unsigned fonts_version_ = 0;
  ImGuiRenderer renderer_;
  std::map<unsigned, GlVertexArray> arrays_;
};

}  // namespace ambf::render
