// The windows of a simulation: draws published frames, turns mouse and keys into commands and requests. Reads frames and writes through
// state::Control; never sees model or physics. Main thread only.
#pragma once

#include <memory>
#include <string>

#include "state/control.h"

namespace ambf::render {

class Viewer {
 public:
  virtual ~Viewer() = default;

  // Opens the windows. Null when there cannot be any (no display, no OpenGL 3.3), with the reason in `why`. `control` must outlive it.
  static std::unique_ptr<Viewer> open(state::Control& control, std::string& why);

  // Handles events, draws one picture of the newest frame in every window and waits for the display. False when the last window was
  // closed or the user quit.
  virtual bool draw() = 0;
};

}  // namespace ambf::render
