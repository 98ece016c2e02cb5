// The windows of a simulation: draws published frames, turns mouse and keys into commands and requests. Reads frames
// and writes through abilities (state/abilities/); never sees model or physics. Main thread.
#pragma once

#include <memory>
#include <string>

#include "base/log.h"
#include "base/log_tail.h"
#include "exchange/broadcast.h"
#include "state/abilities/abilities.h"
#include "state/window_input.h"

namespace ambf::render {

class DataRecording;

struct ViewerOptions {
  bool check_graphics = false;              // the driver checks every call and its errors are logged
  bool frame_loaded = false;                // views begin with all of what was loaded in them
  bool only_watches = false;                // the world is a program's: keys for gravity and dragging say so
  const base::LogTail* messages = nullptr;  // of the log, for the panel to show
  std::string scene;                        // the scene's files, one a line: the panel keeps a layout for them
  exchange::Broadcast<state::WindowInput>* hand = nullptr;  // of the driver keyboard_mouse; null: none is in use
  DataRecording* recording = nullptr;                       // of published data, for the panel; null: not available
};

class Viewer {
 public:
  virtual ~Viewer() = default;

  // Opens the windows. Null when there cannot be any (no display, no OpenGL 3.3), with the reason in `why`. Lowers the
  // calling thread's priority. `simulation` and `log` must outlive it; requested loads may still be in progress
  // when it ends.
  static std::unique_ptr<Viewer> open(const state::Abilities& simulation, base::Log& log, const ViewerOptions& options,
                                      std::string& why);

  // Handles events, draws one picture of the newest frame in every window and waits for the display. False when the
  // last window was closed, the user quit or the display server died (logged).
  virtual bool draw() = 0;
  virtual bool display_lost() const = 0;
};

}  // namespace ambf::render
