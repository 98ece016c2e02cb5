// What is drawn in every window about the simulation itself: the layers it shows, and what pointers hold. Main thread.
#pragma once

#include "render/window_part.h"

namespace ambf::render {

class SceneMarks final : public WindowPart {
 public:
  void draw_debug(const WindowMoment& moment, DebugDraw& debug) override;
};

}  // namespace ambf::render
