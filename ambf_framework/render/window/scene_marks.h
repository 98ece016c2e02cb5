// What is drawn in every window about the simulation itself: the layers it shows, what pointers hold, what is
// measured. Main thread.
#pragma once

#include "render/window/window_part.h"

namespace ambf::render {

class SceneMarks final : public WindowPart {
 public:
  bool on_input(const WindowMoment& moment, const Input& input) override;
  void draw_debug(const WindowMoment& moment, WorldShapes& debug) override;
};

}  // namespace ambf::render
