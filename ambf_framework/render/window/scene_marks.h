// What is drawn in every window about the simulation itself: the layers it shows, what pointers hold, what is
// measured; which tools input devices move. Main thread.
#pragma once

#include "render/window/window_part.h"
#include "state/abilities/devices.h"

namespace ambf::render {

class SceneMarks final : public WindowPart {
 public:
  // `devices`: null where there are none.
  explicit SceneMarks(const state::DeviceAbility* devices) : devices_(devices) {}

  bool on_input(const WindowMoment& moment, const Input& input) override;
  void draw_debug(const WindowMoment& moment, WorldShapes& debug) override;

 private:
  const state::DeviceAbility* const devices_;
};

}  // namespace ambf::render
