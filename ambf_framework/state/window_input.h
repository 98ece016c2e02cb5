// What a person does in the simulator's windows to move a hand by keyboard and mouse: the windows publish it once a
// picture (exchange::Broadcast), the driver keyboard_mouse reads it. Plain data, C++17.
#pragma once

#include <cstdint>

namespace ambf::state {

// Keys that act while they are held, by their bits in WindowInput::held. Directions as the person sees them.
enum class HandKey : std::uint8_t {
  away,
  towards,
  left,
  right,
  up,
  down,
  roll_left,  // counterclockwise
  roll_right,
  pitch_up,
  pitch_down,
  yaw_left,
  yaw_right,
  clutch,
  camera_clutch,
  slow,
  count,
};

struct WindowInput {
  bool open = false;      // there is a window
  bool controls = false;  // the person has switched the hand on, and the window has kept the focus since
  bool jaw_closed = false;
  std::uint32_t held = 0;  // bit n: HandKey n
  // Sums since the first window: differences count. The pointer's only while `controls`, without a mouse button.
  double pointer_right_px = 0.0, pointer_up_px = 0.0, wheel_away_notches = 0.0;
  std::int64_t stamp_ns = 0;  // steady clock: when the window's events were read
};

constexpr bool is_held(const WindowInput& input, HandKey key) {
  return (input.held >> static_cast<unsigned>(key) & 1) != 0;
}

}  // namespace ambf::state
