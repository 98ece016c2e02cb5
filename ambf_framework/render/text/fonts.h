// The fonts of panel and labels, part of the program so that they look the same everywhere: Roboto where the build
// found it, else DejaVu Sans, else Dear ImGui's own. Any thread, one atlas at a time.
#pragma once

#include <imgui/imgui.h>

namespace ambf::render {

enum class FontWeight { regular, strong };

// Adds a font to the atlas, which must be built afterwards. Null when there is no strong one.
ImFont* add_font(ImFontAtlas& fonts, FontWeight weight, float size_px);

}  // namespace ambf::render
