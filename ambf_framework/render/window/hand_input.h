// Keyboard and mouse as an input device: G switches the hand on, then keys and the pointer's motion are published for
// the driver keyboard_mouse. Mouse buttons keep their gestures, so that the view still moves. Main thread.
#pragma once

#include <memory>

#include "exchange/broadcast.h"
#include "render/window/messages.h"
#include "render/window/window_part.h"
#include "state/window_input.h"

namespace ambf::render {

class HandInput final : public WindowPart {
 public:
  HandInput(exchange::Broadcast<state::WindowInput>& slot, std::shared_ptr<Messages> messages)
      : slot_(slot), messages_(std::move(messages)) {}
  ~HandInput() override;  // publishes that there is no window

  bool on_input(const WindowMoment& moment, const Input& input) override;
  void on_consumed(const WindowMoment& moment, const Input& input) override;
  void on_close(unsigned window) override;
  // Once a picture, after its inputs.
  void publish(std::int64_t now_ns);

 private:
  bool on_key(unsigned window, const KeyInput& key);
  void on_motion(const WindowMoment& moment, const MotionInput& motion);
  void release();  // of all keys; the hand stays where it is

  exchange::Broadcast<state::WindowInput>& slot_;
  const std::shared_ptr<Messages> messages_;
  state::WindowInput input_;
  unsigned window_ = 0;       // in which it was switched on
  unsigned pressed_ = 0;      // mouse buttons, as bits
  bool placed_ = false;       // x_ and y_ are of that window
  double x_ = 0.0, y_ = 0.0;  // of the pointer
};

}  // namespace ambf::render
