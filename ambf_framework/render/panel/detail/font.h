// The panel's font, part of the program so that it looks the same everywhere: Roboto where the build found it, else DejaVu Sans, else Dear
// ImGui's own. Private to render/panel/. Main thread.
#pragma once

#include "render/panel/ui.h"

namespace ambf::render {

// Replaces what the atlas holds, for the current context; sets ui.strong.
void load_fonts(ImFontAtlas& fonts, float size_px, float strong_size_px, Ui& ui);

}  // namespace ambf::render
