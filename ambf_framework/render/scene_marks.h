// What is drawn in every window about the simulation itself: frames of bodies, the points that pointers pull at. Main thread.
#pragma once

#include "render/window_part.h"

namespace ambf::render {

class SceneMarks final : public WindowPart {
 public:
  void draw_marks(const WindowMoment& moment, FlatDrawing& marks) override;
};

}  // namespace ambf::render
